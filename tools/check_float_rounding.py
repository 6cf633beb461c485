#!/usr/bin/env python3
"""Checks that no expression converts double -> float -> double: g++ 12 leaves the rounding out where it vectorises.

rounded_to_float() and round_to_floats() (geometry/float_rounding.hpp) are for that. Exit 0 when all is well, 1 with one line per offence.
"""
import re
import sys
from pathlib import Path

from check_child_programs import without_comments

TO_FLOAT = r"(?:static_cast\s*<\s*float\s*>|float|\(\s*float\s*\))\s*[({]"
TO_DOUBLE = r"(?:static_cast\s*<\s*double\s*>|\bdouble|\(\s*double\s*\))\s*[({]"
PATTERNS = [re.compile(r"cast\s*<\s*float\s*>\s*\(\s*\)\s*(?:\.\s*eval\s*\(\s*\)\s*)?\.\s*(?:template\s+)?cast\s*<\s*double\s*>"),
            re.compile(TO_DOUBLE + r"\s*" + TO_FLOAT)]


def offences(name, text):
    plain = without_comments(text)
    lines = sorted({plain.count("\n", 0, found.end()) + 1 for pattern in PATTERNS for found in pattern.finditer(plain)})
    return [f"{name}:{line}: double -> float -> double in one expression: rounded_to_float()" for line in lines]


def main():
    # The check itself: what it must find, and what it must not.
    for bad in ("p.cast<float>().cast<double>()", "a = p.cast<float>()\n    .cast<double>();", "p.cast<float>().eval().cast<double>()",
                "double(float(x))", "double(static_cast<float>(x))", "static_cast<double>(static_cast<float>(x))",
                "double{float{x}}", "static_cast<double>(float(x))"):
        if not offences("src/x.cpp", bad):
            print(f"this check no longer finds {bad}")
            return 1
    for good in ("// p.cast<float>().cast<double>()", "p.cast<float>()", "q.cast<double>()", "double(floats[0])", "static_cast<float>(x)",
                 "static_cast<float>(static_cast<double>(f))", "double(std::bit_cast<float>(word))"):
        if offences("src/x.cpp", good):
            print(f"this check takes offence at {good}")
            return 1
    root = Path(__file__).resolve().parent.parent
    found = []
    for folder in ("src", "include"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp", ".h"):
                found += offences(str(path.relative_to(root)), path.read_text(encoding="utf-8"))
    print("\n".join(found) if found else "every rounding to floats is made by float_rounding.hpp")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
