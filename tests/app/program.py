"""Starts the real program for the tests of this folder. Python's standard library only.

CTest sets FASCICLE_PROGRAM (the program), FASCICLE_SOURCE_DIR (the repository) and FASCICLE_SANITIZE (empty in plain
builds).
"""
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["FASCICLE_PROGRAM"]
SOURCE_DIR = Path(os.environ["FASCICLE_SOURCE_DIR"])
SANITIZED = bool(os.environ.get("FASCICLE_SANITIZE"))
TIMEOUT = 240


def _say_skip(result, test, reason, add=unittest.TextTestResult.addSkip):
    print(f"fascicle-skip: {test.id()}: {reason}", file=sys.stderr)  # tools/skipped_tests.py looks for it in CTest's log
    add(result, test, reason)


unittest.TextTestResult.addSkip = _say_skip


class ProgramTest(unittest.TestCase):
    """Every test gets an empty folder, self.folder, that is removed afterwards."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="fascicle test "))  # a path with a space, on purpose
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=TIMEOUT,
                              **{"cwd": self.folder, **options})

    def check_done(self, *arguments, **options):
        """The command must succeed; returns what it printed on standard output."""
        result = self.run_program(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stderr}")
        return result.stdout

    def check_error(self, code, words, *arguments, **options):
        """The command must end with `code` and exactly one line on standard error that holds all `words`."""
        result = self.run_program(*arguments, **options)
        self.check_error_result(result, code, words, arguments)
        return result

    def check_error_result(self, result, code, words, arguments=()):
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stderr}")
        self.assertEqual(result.stderr.count("\n"), 1, f"{arguments}: {result.stderr!r} is not one line")
        self.assertTrue(result.stderr.startswith("fascicle: "), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr, f"{arguments}")


def file_hashes(folder):
    """Path (relative) -> hash of the content, of every file below a folder."""
    return {str(f.relative_to(folder)): hashlib.sha256(f.read_bytes()).hexdigest()
            for f in sorted(Path(folder).rglob("*")) if f.is_file()}
