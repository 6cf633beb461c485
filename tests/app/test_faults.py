"""Every write, fsync, rename, open, mkdir and close of every command fails once: one line, no half file, nothing else lost.

The failing file layer is fault_shim.c; the kinds of failure are said there.
"""
import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

import small_scene
from program import PROGRAM, SANITIZED, ProgramTest, file_hashes
from test_lines import MODEL, MOTION

SHIM = os.environ["FASCICLE_FAULT_SHIM"]
WRITER = os.environ["FASCICLE_FILE_WRITER"]
REASONS = {"ENOSPC": "No space left on device", "EIO": "Input/output error", "EROFS": "Read-only file system"}
# Under a sanitizer every start takes a second: a sample of the calls.
MOST_CALLS = 8 if SANITIZED else 70


def reads(folder):
    """Whether a run folder is one complete run: the summary, and every frame that it names."""
    summary = json.loads((folder / "summary.json").read_text())
    return all((folder / "frames" / f"{muscle['name']}.{k:04d}.vtp").read_bytes().rstrip().endswith(b"</VTKFile>")
               for muscle in summary["muscles"] for k in summary["vtp_frames"])


@unittest.skipUnless(os.path.exists(SHIM), "no failing file layer was built")
class FaultTest(ProgramTest):
    def setUp(self):
        super().setUp()
        source, _ = small_scene.write_scene(self.folder / "input")
        source[source.index("--phases") + 1] = "2,0,0"
        self.source = source
        self.out = self.folder / "out"

    def make_run(self, *more):
        run = self.folder / "run"
        self.check_done("simulate", *self.source, *more, "--export", "vtp", "--quiet", "--out", run)
        return run

    def start(self, command, at, kind):
        count = self.folder / "count"
        environment = {**os.environ, "LD_PRELOAD": SHIM, "FAULT_FOLDER": str(self.out), "FAULT_AT": str(at),
                       "FAULT_KIND": kind, "FAULT_COUNT": str(count),
                       "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}
        result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120,
                                cwd=self.folder, env=environment)
        return result, int(count.read_text())

    def with_faults(self, command, earlier=None, may_keep=lambda names: False, quiet=False, most=MOST_CALLS):
        """Lets the command fail everywhere. earlier: fills self.out with what was there before. may_keep: of the names of new
        files whether they are a whole that a failure at the very end may leave. quiet: failures are no errors."""
        inputs = {folder: file_hashes(folder) for folder in (self.folder / "input", self.folder / "run")
                  if folder.is_dir()}

        def prepare():
            shutil.rmtree(self.out, ignore_errors=True)
            if earlier is not None:
                earlier(self.out)
            return file_hashes(self.out) if self.out.is_dir() else None

        prepare()
        result, calls = self.start(command, 0, "")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(calls, 2)
        whole = set(file_hashes(self.out))
        step = max(1, calls // most)
        failures = 0
        for at in range(1, calls + 1, step):
            for kind in ("ENOSPC", ("EIO", "EROFS")[at // step % 2], ("EINTR", "SHORT")[at // step % 2]):
                with self.subTest(at=at, kind=kind, calls=calls):
                    before = prepare()
                    result, _ = self.start(command, at, kind)
                    after = file_hashes(self.out) if self.out.is_dir() else None
                    for folder, hashes in inputs.items():
                        self.assertEqual(file_hashes(folder), hashes, "an input was changed")
                    self.assertFalse([name for name in after or {} if "part" in name], "a temporary file was left")
                    if result.returncode == 0: # as if nothing had happened; or nobody is told, and nothing is half
                        self.assertTrue(quiet or kind in ("EINTR", "SHORT") or set(after) == whole, result.stderr)
                        if not quiet:
                            self.assertEqual(set(after), whole)
                        continue
                    failures += 1
                    self.assertIn(kind, REASONS, "what is no failure was taken for one: " + result.stderr)
                    self.check_error_result(result, 1, [str(self.out)])
                    # Closing has no way to tell EROFS.
                    self.assertTrue(any(REASONS[k] in result.stderr for k in {kind, "EIO"}), result.stderr)
                    self.assertNotIn(".fascicle-part", result.stderr, "a name that no user knows")
                    if after != before:
                        self.assertTrue(may_keep(set(after) - set(before or {})),
                                        f"{result.stderr}: {sorted(after)}, before {sorted(before or {})}")
        self.assertTrue(quiet or failures > 0)

    def test_simulate(self):
        command = [PROGRAM, "simulate", *self.source, "--export", "vtp", "--quiet", "--out", self.out]
        self.with_faults(command)

    def test_simulate_into_the_folder_of_an_earlier_run(self):
        run = self.make_run("--set", "fibres.method=kukacka", "--set", "fibres.count=4")
        (run / "notes.txt").write_text("mine")
        command = [PROGRAM, "simulate", *self.source, "--export", "vtp", "--quiet", "--out", self.out]
        self.with_faults(command, lambda out: shutil.copytree(run, out))

    def test_simulate_with_a_model(self):
        command = [PROGRAM, "simulate", *self.source, "--set", "fibres.method=kukacka", "--set", "fibres.count=4",
                   "--export", "vtp,osim", "--quiet", "--out", self.out]
        # The model comes after the last frame: a run without it is kept rather than lost.
        self.with_faults(command, None, lambda names: reads(self.out), most=20)

    def test_simulate_with_pictures(self):
        command = [PROGRAM, "simulate", *self.source, "--export", "vtp,png", "--quiet", "--out", self.out]
        if "without drawing" in self.run_program(*command[1:]).stderr:
            self.skipTest("built without drawing")
        # Pictures come last: a run without them is kept rather than lost.
        self.with_faults(command, None, lambda names: reads(self.out), most=6)

    def test_fibres(self):
        command = [PROGRAM, "fibres", *self.source, "--set", "fibres.count=4", "--quiet", "--out", self.out]
        self.with_faults(command)

    def test_compare(self):
        run = self.make_run()
        self.with_faults([PROGRAM, "compare", run, run, "--quiet", "--out", self.out])

    def test_convert_and_repair(self):
        mesh = self.folder / "input" / "strap.obj"

        def old(out):
            out.mkdir()
            (out / "a.vtp").write_text("of before")

        self.with_faults([PROGRAM, "convert", mesh, self.out / "a.vtp"], old)
        # The mesh comes first, then what is told of it.
        self.with_faults([PROGRAM, "repair", mesh, self.out / "b.vtp", "--report", self.out / "b.json"], None,
                         lambda names: names == {"b.vtp"})

    def test_lines(self):
        (self.folder / "input" / "model.osim").write_text(MODEL)
        (self.folder / "input" / "trial.mot").write_text(MOTION)
        self.with_faults([PROGRAM, "lines", "--osim", self.folder / "input" / "model.osim", "--motion",
                          self.folder / "input" / "trial.mot", "--export", "vtp", "--quiet", "--out", self.out])

    def test_templates(self):
        # Pictures of different files: those that are done stay.
        self.with_faults([PROGRAM, "templates", "--size", "16", "--thumbnails", self.out], None, lambda names: True)

    def test_render_and_report(self):
        if self.run_program("render", "--help").returncode != 0:
            self.skipTest("built without drawing")
        run = self.make_run()

        def old(out):
            out.mkdir()
            for name in ("a.png", "a.gif", "a.html"):
                (out / name).write_text("of before")
            (out / "film").mkdir()
            (out / "film" / "film_0001.png").write_text("of before")

        size = ["--size", "32x32", "--quiet"]
        for command in (["render", run, "--frame", "1", *size, "--out", self.out / "a.png"],
                        ["render", run, "--frames", "0:2", *size, "--out", self.out / "film"],
                        ["render", run, "--frames", "0:2", *size, "--out", self.out / "a.gif"],
                        ["report", run, "--quiet", "--out", self.out / "a.html"]):
            self.with_faults([PROGRAM, *command], old, most=4)

    def test_bench(self):
        """Its one file is written as all others are; that it is told is enough, since measuring takes seconds."""
        result, _ = self.start([PROGRAM, "bench", "--short", "--part", "paint", "--quiet", "--json", self.out / "b.json"],
                               1, "ENOSPC")
        self.check_error_result(result, 1, [str(self.out), REASONS["ENOSPC"]])
        self.assertFalse(self.out.exists())

    def test_files_of_the_editor(self):
        run = self.make_run("--set", "fibres.method=kukacka", "--set", "fibres.count=4")
        for what in ("project", "settings", "preset", "recent"):
            for again in (False, True):
                earlier = None
                if again:
                    def earlier(out, what=what):
                        self.out.mkdir()
                        subprocess.run([WRITER, what, str(run), str(out)], check=True)
                # A list without its picture, or a picture that no list names, is whole.
                self.with_faults([WRITER, what, run, self.out], earlier, lambda names: what == "recent")
        kinds = subprocess.run([WRITER, "kinds"], capture_output=True, text=True) # fails when built without drawing
        for what in kinds.stdout.split() if kinds.returncode == 0 else []:
            with self.subTest(what):
                self.with_faults([WRITER, what, run, self.out], most=10)
        # The folder that all sessions share stays.
        self.with_faults([WRITER, "autosave", run, self.out], None, lambda names: not names, most=16)
        self.with_faults([WRITER, "cache", run, self.out], quiet=True)


if __name__ == "__main__":
    unittest.main()
