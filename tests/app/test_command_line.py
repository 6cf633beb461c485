"""The command line itself: help, version, the parameter page, and every way to get it wrong."""
import re
import subprocess
import unittest

from program import PROGRAM, SOURCE_DIR, ProgramTest


class HelpTest(ProgramTest):
    def test_version_is_that_of_the_build_files(self):
        text = (SOURCE_DIR / "CMakeLists.txt").read_text()
        version = text.split("project(fascicle VERSION ")[1].split()[0]
        self.assertEqual(self.check_done("--version"), f"fascicle {version}\n")

    def test_help_lists_commands_with_examples(self):
        text = self.check_done("--help")
        for word in ("parameters", "Exit code", "Examples"):
            self.assertIn(word, text)
        self.assertIn("--markdown", self.check_done("parameters", "--help"))

    def test_parameter_page_is_up_to_date(self):
        page = (SOURCE_DIR / "docs" / "parameters.md").read_text()
        self.assertEqual(self.check_done("parameters", "--markdown"), page,
                         "run: fascicle parameters --markdown > docs/parameters.md")

    def test_every_command_and_option_is_in_the_manual(self):
        manual = (SOURCE_DIR / "docs" / "cli.md").read_text()
        commands = re.findall(r"^  ([a-z]+)  ", self.check_done("--help").split("Subcommands:")[1], re.MULTILINE)
        self.assertIn("simulate", commands)
        for command in commands:
            self.assertIn(f"fascicle {command}", manual)
            for option in re.findall(r"^  (?:-h,)?(--[a-z-]+)", self.check_done(command, "--help"), re.MULTILINE):
                self.assertIn(option, manual, command)

    def test_plain_table_has_a_line_for_every_row_of_the_page(self):
        lines = self.check_done("parameters").splitlines()
        page = [line for line in self.check_done("parameters", "--markdown").splitlines() if line.startswith("| `")]
        self.assertEqual(len(lines), len(page) + 1)
        self.assertTrue(any(line.startswith("solver.stiffness ") for line in lines))


class UsageErrorTest(ProgramTest):
    def test_command_is_missing_or_unknown(self):
        self.check_error(2, ["no command", "parameters"])
        self.check_error(2, ["unknown command 'paramters'", "did you mean 'parameters'?"], "paramters")
        self.check_error(2, ["unknown command 'xyzzy'"], "xyzzy")
        self.check_error(2, ["unknown option '--versoin'", "did you mean '--version'?"], "--versoin")
        self.check_error(2, ["unknown command"], "line\nbreak")

    def test_option_is_unknown(self):
        self.check_error(2, ["unknown option '--markdwon'", "did you mean '--markdown'?"], "parameters", "--markdwon")
        self.check_error(2, ["unexpected argument 'banana'"], "parameters", "banana")

    def test_output_that_cannot_be_written(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "parameters"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.check_error_result(result, 1, ["standard output", "cannot write"])


class PackageListTest(unittest.TestCase):
    def test_list_and_readme_name_the_same_packages(self):
        lines = (SOURCE_DIR / "scripts" / "packages").read_text().splitlines()
        listed = {line.split("#")[0].strip() for line in lines} - {""}
        tables = [line.split("|") for line in (SOURCE_DIR / "third_party" / "README.md").read_text().splitlines()
                  if line.startswith("|")]
        named = {name.strip(" `") for row in tables for name in row[2].split(",") if "`" in name}
        self.assertEqual(listed, named)


if __name__ == "__main__":
    unittest.main()
