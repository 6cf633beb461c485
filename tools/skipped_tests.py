#!/usr/bin/env python3
"""Says which tests were skipped: skipped_tests.py FOLDER_OF_A_BUILD; the number first, then one line a reason. .ci/run prints them.

Reads CTest's log of the last run, since CTest's summary counts skipped tests as passed, and one CTest test of Python or of a module is
many tests. A test that is skipped prints "fascicle-skip: reason".
"""
import re
import sys
from pathlib import Path

MARK = "fascicle-skip: "


def skipped(log):
    """[(test, reason)], each once."""
    found, name = [], ""
    for line in log.splitlines():
        begin = re.match(r"\d+/\d+ Testing: (.*)", line)
        if begin:
            name = begin.group(1)
        elif MARK in line:
            entry = (name, line.split(MARK, 1)[1].strip())
            if entry not in found or name.startswith("module_"):
                found.append(entry)
    return found


def lines(found):
    by_reason = {}
    for name, reason in found:
        by_reason.setdefault(reason, []).append(name)
    return [f"{reason} ({len(names)}: {', '.join(dict.fromkeys(names[:3]))}{', ...' if len(names) > 3 else ''})"
            for reason, names in sorted(by_reason.items(), key=lambda item: -len(item[1]))]


def main():
    # The check itself: what it must find, and what it must not.
    log = ('1/5 Testing: A\n1/5 Test: A\nOutput:\n---\nA is fine, nothing was skipped\n<end>\n'
           '2/5 Testing: B\n  fascicle-skip: no data\n  fascicle-skip: no data\n'
           '3/5 Testing: C\n  fascicle-skip: no data\n4/5 Testing: module_io\nfascicle-skip: x\nfascicle-skip: x\n'
           '5/5 Testing: D\n')
    wanted = [("B", "no data"), ("C", "no data"), ("module_io", "x"), ("module_io", "x")]
    if skipped(log) != wanted or len(lines(wanted)) != 2 or lines(wanted)[0] != "no data (2: B, C)":
        print(f"this check no longer finds what is skipped: {skipped(log)}, {lines(wanted)}")
        return 1
    if len(sys.argv) < 2:
        print("skipped tests are found")
        return 0
    path = Path(sys.argv[1]) / "Testing" / "Temporary" / "LastTest.log"
    if not path.is_file():
        print(f"0\nno log of CTest: {path}")
        return 1
    found = skipped(path.read_text(encoding="utf-8", errors="replace"))
    print("\n".join([str(len(found)), *lines(found)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
