"""Hostile names and places: what is no file, what cannot be read, what leads elsewhere. One line, no crash, nothing touched
that was not named."""
import json
import os
import resource
import shutil
import socket
import subprocess
import unittest
from pathlib import Path

import small_scene
from program import PROGRAM, SANITIZED, ProgramTest
from test_lines import MODEL, MOTION

ODD_NAMES = ("two words", "it's", 'say "so"', "line\nbreak", "back\\slash", "-dash", "--help", "größe λ 骨", "a;b|c&d$(e)`f`", "*?[x]",
             "%s%n", "comma,and=sign", "\x1b[31mred", "n" * 245, b"no utf-8 \xff\xfe".decode(errors="surrogateescape"))
BRACKETS = 100_000


def bounded():
    """A program that asks for much more than its inputs are worth fails."""
    if not SANITIZED: # which reserves terabytes for itself
        resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))


def state_of(folder):
    """Everything below a folder: kind, size, time of change and target of links."""
    found = {}
    for place, folders, files in os.walk(folder):
        for name in folders + files:
            path = os.path.join(place, name)
            facts = os.lstat(path)
            found[path] = (facts.st_mode, facts.st_size, facts.st_mtime_ns,
                           os.readlink(path) if os.path.islink(path) else "")
    return found


class PlacesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.input = self.folder / "input"
        self.source, _ = small_scene.write_scene(self.input)
        self.source[self.source.index("--phases") + 1] = "1,0,0"
        (self.input / "model.osim").write_text(MODEL)
        (self.input / "trial.mot").write_text(MOTION)
        self.out = self.folder / "out"

    def run_program(self, *arguments, **options):
        arguments = [os.fsencode(str(word)) for word in arguments]
        result = subprocess.run([PROGRAM, *arguments], capture_output=True, timeout=100, preexec_fn=bounded,
                                stdin=subprocess.DEVNULL, **{"cwd": self.folder, **options})
        result.stdout = result.stdout.decode(errors="surrogateescape")
        result.stderr = result.stderr.decode(errors="surrogateescape")
        return result

    def refuses(self, words, *arguments, code=1, besides=()):
        """An error of one line, and nothing anywhere changed (besides the named)."""
        before = state_of(self.folder)
        result = self.run_program(*arguments)
        self.assertGreaterEqual(result.returncode, 0, f"{arguments}: killed by a signal: {result.stderr}")
        if code is None:
            self.assertIn(result.returncode, (1, 2), result.stderr)
        self.check_error_result(result, result.returncode if code is None else code, words, arguments)
        self.assertFalse(any(ord(c) < 32 for c in result.stderr[:-1]), f"{result.stderr!r} steers the terminal")
        self.assertLess(len(result.stderr), 5000 + 2 * max(len(str(word)) for word in arguments), "too long to be read")
        after = state_of(self.folder)
        self.assertEqual({k: v for k, v in after.items() if k not in besides},
                         {k: v for k, v in before.items() if k not in besides})

    def readers(self, path):
        """Every command line that reads `path` as some kind of file, by a name of it."""
        some = self.input
        meshes = ["--muscle", some / "strap.obj", "--bone", some / "fixed.obj"]
        simulate = ["simulate", "--out", self.out, "--quiet"]
        yield "info", ["info", "--", path]
        yield "muscle", [*simulate, "--muscle", path, "--bone", some / "fixed.obj"]
        yield "bone", [*simulate, "--muscle", some / "strap.obj", "--bone", path]
        yield "project", [*simulate, "--project", path]
        yield "attachments", [*simulate, *meshes, "--attachments", f"strap={path}"]
        yield "fibres", [*simulate, *meshes, "--surface-fibres", f"strap={path}"]
        yield "template", [*simulate, *meshes, "--fibre-template", f"strap={path}"]
        yield "motion", [*simulate, *meshes, "--motion", path]
        yield "lines", [*simulate, *meshes, "--lines", path]
        yield "preset", [*simulate, *meshes, "--preset", path]
        yield "model", ["lines", "--osim", path, "--motion", some / "trial.mot", "--out", self.out]
        yield "storage", ["lines", "--osim", some / "model.osim", "--motion", path, "--out", self.out]
        yield "body", ["lines", "--osim", some / "model.osim", "--motion", some / "trial.mot", "--out", self.out, "--bone",
                       f"arm={path}"]
        yield "templates", ["templates", "--", path]
        yield "run", ["render", path, "--out", self.folder / "x.png"]
        yield "report", ["report", path, "--out", self.folder / "x.html"]
        yield "compared", ["compare", path, path, "--out", self.out]
        yield "converted", ["convert", path, self.folder / "x.vtp"]
        yield "repaired", ["repair", path, self.folder / "x.vtp"]
        yield "exported", ["export", path, "--as", "usda", "--out", self.folder / "x.usda"]
        yield "driving model", [*simulate, "--muscle", some / "strap.obj", "--osim", path, "--motion", some / "trial.mot"]

    def each_reader_refuses(self, path, words=(), skip=(), code=None):
        for name, arguments in self.readers(path):
            if name not in skip:
                with self.subTest(reader=name, path=str(path)[-60:]):
                    self.refuses(list(words), *arguments, code=code)

    # What is no file.

    def test_pipes_devices_sockets_and_folders_are_refused_at_once(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        self.each_reader_refuses(pipe, ["pipe"])
        self.each_reader_refuses("/dev/zero", ["/dev/zero"])
        self.each_reader_refuses("/dev/full", ["/dev/full"])
        self.each_reader_refuses(self.input, ["input"])
        address = self.folder / "socket"
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(str(address))
            self.refuses(["socket"], "info", address)

    def test_pipes_inside_a_run_do_not_hang(self):
        run = self.folder / "run"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        for name in ("summary.json", "motion.csv", "metrics.csv", "frames/strap.0000.vtp", "bones/fixed.vtp"):
            whole = (run / name).read_bytes()
            (run / name).unlink()
            os.mkfifo(run / name)
            with self.subTest(name):
                self.refuses(["pipe"], "compare", run, run, "--out", self.out)
            (run / name).unlink()
            (run / name).write_bytes(whole)
        os.mkfifo(run / "lines.csv") # looked at by a run into the same folder
        self.check_done("simulate", *self.source, "--quiet", "--out", run)

    def test_empty_files_links_in_a_circle_and_files_nobody_may_read(self):
        empty = self.folder / "empty"
        empty.touch()
        self.each_reader_refuses(empty, ["empty"])
        circle = self.folder / "circle"
        circle.symlink_to(circle)
        self.each_reader_refuses(circle, ["circle"])
        self.each_reader_refuses(self.folder / "dangling" / "x", ["dangling"])
        self.each_reader_refuses("/" + "x" * 300, ["xxx"])
        self.each_reader_refuses("y/" * 3000, ["y/"])

    def test_a_file_that_nobody_may_read(self):
        shutil.copy(PROGRAM, self.folder / "program") # as nobody it may not see the build folder
        self.folder.chmod(0o755)
        self.input.chmod(0o755)
        secret = self.input / "secret.obj"
        shutil.copy(self.input / "strap.obj", secret)
        secret.chmod(0)
        as_nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        result = subprocess.run([self.folder / "program", "info", secret], capture_output=True, text=True, timeout=100,
                                cwd=self.folder, **as_nobody)
        self.check_error_result(result, 1, ["secret.obj", "Permission denied"])

    # What is in files.

    def test_deep_nesting_long_lines_and_long_numbers(self):
        digits = "9" * 10_000
        for name, content in (
                ("brackets", "[" * BRACKETS), ("closed brackets", "[" * BRACKETS + "]" * BRACKETS),
                ("objects", '{"fascicle_project":' + '{"a":' * BRACKETS), ("tags", "<a>" * BRACKETS),
                ("model tags", '<OpenSimDocument Version="40000"><Model>' + "<a>" * BRACKETS + "</a>" * BRACKETS +
                 "</Model></OpenSimDocument>"),
                ("entities", '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]><VTKFile>&b;</VTKFile>'),
                ("a long line", "v 0 0 0 " * 200_000), ("blanks", " " * 2_000_000), ("one word", "x" * 2_000_000),
                ("digits", digits), ("digits in JSON", '{"fascicle_project": ' + digits + "}"),
                ("digits in a mesh", f"v 0 0 {digits}\nv 1 0 {digits}\nv 0 1 0\nf 1 2 {digits}\n"),
                ("a tiny number", "v 0.%s1 0 0\n" % ("0" * 10_000) * 3 + "f 1 2 3\n"),
                ("no UTF-8", '{"fascicle_project": 2, "name": "\udcff\udcfe"}'),
                ("zeros", "\0" * 100_000)):
            bad = self.folder / "bad"
            bad.write_bytes(content.encode(errors="surrogateescape"))
            with self.subTest(name):
                # One vertex or a triangle of no size is a mesh, if a poor one.
                self.each_reader_refuses(bad, ["bad"], skip=("body", "info", "converted") if name in ("a tiny number", "a long line") else ())

    def test_storage_and_tables_with_long_numbers(self):
        digits = "1" * 10_000
        for reader, content in (("storage", f"t\nendheader\ntime\tangle\n{digits}\t{digits}\n"),
                                ("attachments", f"attachment,bone,x,y,z\norigin,fixed,{digits},0,0\n"),
                                ("motion", f"frame,bone,m00\n{digits},fixed,1\n"),
                                ("model", MODEL.replace("0.04", digits))):
            bad = self.folder / "bad"
            bad.write_text(content)
            with self.subTest(reader):
                self.refuses(["bad"], *dict(self.readers(bad))[reader], code=None)

    # Names that are odd, but good.

    def test_odd_names_work_everywhere(self):
        for name in ODD_NAMES:
            with self.subTest(name):
                place = self.folder / "odd" / name
                place.mkdir(parents=True)
                short = name if len(name) < 200 else name[:-40] # with its extension 255 bytes at most
                muscle = place / f"{short}.obj"
                shutil.copy(self.input / "strap.obj", muscle)
                source = list(self.source)
                source[source.index("--muscle") + 1] = muscle
                out = place / f"out {short}"
                before = state_of(self.input)
                result = self.run_program("simulate", *source, "--export", "vtp", "--out", out)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertFalse(any(ord(c) < 32 and c != "\n" for c in result.stdout), result.stdout)
                summary = json.loads((out / "summary.json").read_bytes().decode("utf-8"))
                self.assertEqual(len(summary["vtp_frames"]), 2)
                self.assertEqual(len(list((out / "frames").iterdir())), 2)
                self.assertEqual(sorted(file.name for file in out.iterdir() if file.suffix != ".pvd"),
                                 ["bones", "frames", "metrics.csv", "motion.csv", "summary.json"])
                self.assertEqual(state_of(self.input), before)
                # Written by one command, read by the next.
                result = self.run_program("compare", "--out", place / "difference", "--", out, out)
                self.assertEqual(result.returncode, 0, result.stderr)
                json.loads((place / "difference" / "comparison.json").read_bytes().decode("utf-8"))
                result = self.run_program("info", "--", muscle)
                self.assertEqual((result.returncode, result.stderr), (0, ""))

    # Names that come out of files.

    def project(self, muscle, **more):
        """A project beside the meshes whose muscle has that name."""
        file = self.input / "my.fascicle"
        file.write_text(json.dumps({"fascicle_project": 2, "bones": [{"name": "fixed", "path": "fixed.obj"}],
                                    "muscles": [{"name": muscle, "path": "strap.obj", **more}]}))
        return file

    def test_names_from_a_project_never_lead_out_of_the_folder(self):
        for name in ("../../escaped", "/tmp/fascicle escaped", "..", ".", "a/b", "a\nb", "~/x", "nul\0nul", "x" * 5000):
            with self.subTest(name[:20]):
                project = self.project(name)
                before = state_of(self.folder)
                for command in ("simulate", "fibres"):
                    arguments = ["--export", "vtp"] if command == "simulate" else ["--set", "fibres.count=4"]
                    result = self.run_program(command, "--project", project, *arguments, "--quiet", "--out", self.out)
                    if command == "fibres" and result.returncode == 1: # one attachment alone has no fibres
                        self.check_error_result(result, 1, [])
                        continue
                    self.assertEqual(result.returncode, 0, result.stderr)
                    after = state_of(self.folder)
                    new = {path for path in after if path not in before}
                    self.assertTrue(all(path.startswith(str(self.out)) for path in new), new)
                    self.assertEqual({path: facts for path, facts in after.items() if path in before}, before)
                    self.assertEqual(json.loads((self.out / "summary.json").read_text())["muscles"][0]["name"], name)
                self.assertFalse(Path("/tmp/fascicle escaped.0000.vtp").exists())
                shutil.rmtree(self.out)

    def test_names_that_would_call_one_file_are_refused(self):
        project = self.project("a/b")
        content = json.loads(project.read_text())
        content["muscles"].append({"name": "a_b", "path": "strap.obj"})
        project.write_text(json.dumps(content))
        self.refuses(["'a/b'", "'a_b'"], "simulate", "--project", project, "--out", self.out)

    def test_files_that_a_project_names_are_only_read(self):
        (self.input / "link.obj").symlink_to("/etc/passwd")
        (self.input / "loop").symlink_to(".")
        for path in ("../../../../../../etc/passwd", "/etc/passwd", "link.obj", "/dev/zero", "..", "", "strap.obj\0.vtk",
                     "loop/" * 100 + "strap.obj"):
            project = self.input / "my.fascicle"
            project.write_text(json.dumps({"fascicle_project": 2, "bones": [{"name": "fixed", "path": "fixed.obj"}],
                                           "muscles": [{"name": "strap", "path": path}]}))
            with self.subTest(path):
                before = state_of(self.folder)
                result = self.run_program("simulate", "--project", project, "--out", self.out)
                self.check_error_result(result, 1, [])
                self.assertNotIn("root:x", result.stderr, "no error shows what is in files that are no meshes")
                self.assertEqual(state_of(self.folder), before)
        # Relative to the project, upwards too: that is what projects beside a folder of meshes need.
        self.project("strap")
        (self.folder / "beside").mkdir()
        text = (self.input / "my.fascicle").read_text()
        (self.folder / "beside" / "my.fascicle").write_text(text.replace('"path": "', '"path": "../input/'))
        self.check_done("simulate", "--project", self.folder / "beside" / "my.fascicle", "--quiet", "--out", self.out,
                        "--set", "solver.iterations=1", cwd="/")

    # Places that are written to.

    def writers(self, out):
        """Every command that writes one file, and every one that writes a folder."""
        yield ["simulate", *self.source, "--out", out]
        yield ["fibres", *self.source, "--set", "fibres.count=4", "--out", out]
        yield ["lines", "--osim", self.input / "model.osim", "--motion", self.input / "trial.mot", "--out", out]
        yield ["templates", "--thumbnails", out, "--size", "16"]
        yield ["bench", "--short", "--part", "paint", "--json", out]
        yield ["repair", self.input / "strap.obj", self.folder / "x.obj", "--report", out]
        if self.run_program("render", "--help").returncode == 0:
            yield ["render", *self.source, "--size", "32x32", "--out", out]
            yield ["render", *self.source, "--frames", "0:1", "--size", "32x32", "--out", f"{out}.gif"]
            yield ["report", *self.source, "--out", out]

    def test_devices_pipes_and_circles_are_not_replaced(self):
        pipe = self.folder / "pipe"
        for path in (pipe, f"{pipe}.gif"):
            os.mkfifo(path)
        (self.folder / "null").symlink_to("/dev/null") # never the real one: a test that fails would replace it
        (self.folder / "null.gif").symlink_to("/dev/null")
        for path in (pipe, self.folder / "null"):
            for arguments in self.writers(path):
                with self.subTest(path=path.name, command=arguments[0]):
                    self.refuses([path.name], *arguments)
        self.assertTrue(Path("/dev/null").is_char_device())

    def test_links_below_the_output_are_not_followed(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        self.out.mkdir()
        (self.out / "frames").symlink_to(elsewhere)
        self.refuses(["frames", "link"], "simulate", *self.source, "--export", "vtp", "--quiet", "--out", self.out,
                     besides=(str(self.out),))
        self.assertEqual(list(elsewhere.iterdir()), [])
        (self.out / "frames").unlink()
        # A link in the place of a file is replaced; what it points to stays.
        (elsewhere / "mine.json").write_text("mine")
        (self.out / "summary.json").symlink_to(elsewhere / "mine.json")
        self.check_done("simulate", *self.source, "--quiet", "--out", self.out)
        self.assertEqual((elsewhere / "mine.json").read_text(), "mine")

    def test_no_input_is_replaced(self):
        project = self.project("strap")
        run = self.folder / "run"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        if self.run_program("render", "--help").returncode == 0:
            for name in ("strap.obj", "fixed.obj"):
                self.refuses([name], "render", *self.source, "--out", self.input / name, code=2)
            self.refuses(["my.fascicle"], "render", "--project", project, "--out", project, code=2)
            self.refuses(["strap.obj"], "render", "--project", project, "--out", self.input / "strap.obj", code=2)
            self.refuses(["my.fascicle"], "report", "--project", project, "--out", project, code=2)
            self.refuses(["summary.json"], "render", run, "--out", run / "summary.json", code=2)
            self.refuses(["summary.json"], "export", run, "--as", "json", "--out", run / "summary", code=2)
            self.refuses(["metrics.csv"], "export", run, "--as", "metrics", "--out", run / "metrics", code=2)
            self.refuses(["strap.0000.vtp"], "report", run, "--out", run / "frames" / "strap.0000.vtp", code=2)
        for command in ("convert", "repair"):
            self.refuses(["strap.obj"], command, self.input / "strap.obj", self.input / "strap.obj", code=2)
        renamed = self.folder / "summary.json"
        shutil.copy(project, renamed)
        renamed.write_text(renamed.read_text().replace('"path": "', '"path": "input/'))
        self.refuses(["summary.json"], "simulate", "--project", renamed, "--out", self.folder, code=2)
        shutil.copy(self.input / "trial.mot", self.folder / "lines.csv")
        self.refuses(["lines.csv"], "lines", "--osim", self.input / "model.osim", "--motion", self.folder / "lines.csv",
                     "--out", self.folder, code=2)

    def test_long_names_of_outputs(self):
        for name in ("n" * 251 + ".png", "n" * 255):
            with self.subTest(name[-6:]):
                self.check_done("bench", "--short", "--part", "paint", "--quiet", "--json", self.folder / name)
                self.assertTrue((self.folder / name).is_file())
        self.refuses(["nnn"], "bench", "--short", "--part", "paint", "--quiet", "--json", self.folder / ("n" * 256))
        self.refuses(["nnn"], "simulate", *self.source, "--out", self.folder / ("n" * 256))

    # Streams that are not there.

    def test_output_that_nobody_reads(self):
        for command in (["info", self.input / "strap.obj"], ["scenes"], ["parameters"],
                        ["simulate", *self.source, "--out", self.out]):
            with self.subTest(command[0]):
                pipe = subprocess.Popen([PROGRAM, *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                pipe.stdout.close() # before anything is written: as `| true`
                errors = pipe.stderr.read()
                pipe.stderr.close()
                self.assertEqual((pipe.wait(timeout=100), errors), (0, b""))
        self.assertTrue((self.out / "summary.json").exists())

    def test_closed_and_full_streams(self):
        for streams in (">&-", "2>&-", "<&-", ">&- 2>&- <&-"):
            with self.subTest(streams):
                shutil.rmtree(self.out, ignore_errors=True)
                result = subprocess.run(["bash", "-c", f'"$0" "$@" {streams}', PROGRAM, "simulate", *map(str, self.source),
                                         "--out", str(self.out)], capture_output=True, text=True, timeout=100)
                self.assertEqual(result.returncode, 1 if ">&-" in streams.replace("2>&-", "") else 0, result.stderr)
                for file in self.out.rglob("*"): # nothing that was meant for the screen went into a file
                    if file.is_file():
                        self.assertNotIn("written to", file.read_text())
                json.loads((self.out / "summary.json").read_text())
        result = subprocess.run(["bash", "-c", '"$0" scenes > /dev/full', PROGRAM], capture_output=True, text=True, timeout=100)
        self.check_error_result(result, 1, ["standard output"])

    def test_a_working_folder_that_is_gone(self):
        gone = self.folder / "gone"
        gone.mkdir()
        result = subprocess.run(["bash", "-c", 'cd "$1" && rmdir "$1" && "$0" simulate --scene squish-box --out out', PROGRAM,
                                 str(gone)], capture_output=True, text=True, timeout=100)
        self.check_error_result(result, 1, ["out"])


if __name__ == "__main__":
    unittest.main()
