"""Every command and option of the program, as its own help lists them: exit codes, and one line on standard error."""
import re
import unittest

from program import SANITIZED, ProgramTest

# Commands that do something without any option or operand.
READY = {"scenes", "bench", "parameters", "templates"}
VALUES = ("", " ", "-1", "nan", "1e999", "x" * 5000, "a=b=c", "line\nbreak", "\x1b[2J", ",,,", ";;;", "größe", "%n%s", "../../etc", "0x10",
          "99999999999999999999")


class ExitCodeTest(ProgramTest):
    def commands(self):
        return re.findall(r"^  ([a-z]+)  ", self.check_done("--help").split("Subcommands:")[1], re.MULTILINE)

    def options(self, command):
        """(name, whether it takes a value) of every option."""
        found = []
        for line in self.check_done(command, "--help").splitlines():
            match = re.match(r"^  (?:-h,)?(--[a-z-]+)(?: (\S+))?(?:\s|$)", line)
            if match and match[1] != "--help":
                found.append((match[1], bool(re.match(r"^  \S+ \S", line))))
        self.assertTrue(found or command in ("scenes", "info"), command)
        return found

    def one_line(self, code, *arguments):
        result = self.run_program(*arguments)
        self.check_error_result(result, result.returncode, [], arguments)
        self.assertIn(result.returncode, code, f"{arguments}: {result.stderr}")
        self.assertEqual(result.stdout, "", f"{arguments}: an error belongs on standard error alone")
        self.assertFalse(any(ord(c) < 32 for c in result.stderr[:-1]), f"{result.stderr!r} steers the terminal")

    def test_help_of_every_command(self):
        for command in self.commands():
            for words in ((command, "--help"), (command, "-h")):
                result = self.run_program(*words)
                self.assertEqual((result.returncode, result.stderr), (0, ""), words)
                self.assertIn("Examples:", result.stdout)

    def test_nothing_wrong_and_too_much(self):
        for command in self.commands():
            with self.subTest(command):
                if command not in READY:
                    self.one_line((2,), command)
                self.one_line((2,), command, "--no-such-option")
                self.one_line((2,), command, "--no-such-option=3")
                self.one_line((2,), command, "-x")
        for command in ("scenes", "simulate", "fibres", "lines", "bench", "parameters"):
            self.one_line((2,), command, "one", "too", "many")

    def test_values_that_are_missing(self):
        for command in self.commands():
            for option, takes in self.options(command):
                if takes:
                    with self.subTest(command=command, option=option):
                        self.one_line((2,), command, option)

    def test_values_that_mean_nothing(self):
        """Alone with a value no command of these has all that it needs, so that each ends with an error; but for a folder, which is
        all that reproduce needs."""
        for command in self.commands():
            if command in READY:
                continue
            options = [option for option, takes in self.options(command) if takes and (command, option) != ("reproduce", "--out")]
            for i, option in enumerate(options):
                for k, value in enumerate(VALUES):
                    if (i + k) % (12 if SANITIZED else 4) == 0:
                        with self.subTest(command=command, option=option, value=value[:20]):
                            self.one_line((1, 2), command, f"{option}={value}")
                            self.one_line((1, 2), command, option, value)
        self.assertEqual(list(self.folder.iterdir()), [], "a command that failed left something")

    def test_operands_that_are_not_there(self):
        for command in ("info", "render", "report", "compare", "convert", "repair", "templates"):
            if command not in self.commands():
                continue
            for words in (("nowhere.obj",), ("nowhere.obj", "out.vtp"), ("nowhere.obj", "out.vtp", "--quiet"), ("",), ("", "")):
                with self.subTest(command=command, words=words):
                    self.one_line((1, 2), command, *words)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
