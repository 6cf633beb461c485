#!/usr/bin/env python3
"""Checks that CMake can list every Catch2 test by its name. Exit 0, or 1 with one line per offence.

CMake lists break on brackets, semicolons and backslashes: after a name with a lone ']' all later tests become one
entry that matches nothing and passes.
"""
import re
import sys
from pathlib import Path

NAME = re.compile(r'TEMPLATE_TEST_CASE\s*\(\s*"((?:[^"\\]|\\.)*)"|TEST_CASE\s*\(\s*"((?:[^"\\]|\\.)*)"')


def main():
    root = Path(__file__).resolve().parent.parent
    offences, count = [], 0
    for path in sorted((root / "tests").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        for match in NAME.finditer(text):
            name = match.group(1) or match.group(2) or ""
            count += 1
            if re.search(r"[\[\];\\]", name):
                line = text.count("\n", 0, match.start()) + 1
                offences.append(f"{path.relative_to(root)}:{line}: test name has one of [ ] ; \\: {name}")
    print("\n".join(offences) if offences else f"test names ok: {count}")
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
