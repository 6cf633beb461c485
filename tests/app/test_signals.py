"""Signals at any moment, and two programs at once: nothing half-written under a final name, what is there can be read."""
import csv
import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import small_scene
from program import PROGRAM, SANITIZED, ProgramTest, file_hashes
from test_lines import MODEL, MOTION

WRITER = os.environ["FASCICLE_FILE_WRITER"]
SHIM = os.environ["FASCICLE_FAULT_SHIM"]
RUNS = 3 if SANITIZED else 12


def check_run(test, folder):
    """A run folder is one whole run."""
    summary = json.loads((folder / "summary.json").read_text())
    frames = summary["frames"]
    for name in ("metrics.csv", "motion.csv"):
        with open(folder / name, newline="") as lines:
            rows = list(csv.DictReader(lines))
        test.assertEqual(sorted({int(row["frame"]) for row in rows}), list(range(frames + 1)), name)
        test.assertFalse(any(None in row.values() for row in rows), name)
    files = sorted(file.name for file in (folder / "frames").iterdir()) if summary["vtp_frames"] else []
    test.assertEqual(files, [f"strap.{k:04d}.vtp" for k in summary["vtp_frames"]])
    for name in files:
        xml.parse(folder / "frames" / name)
    return summary


class SignalTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.source, _ = small_scene.write_scene(self.folder / "input")
        self.source[self.source.index("--phases") + 1] = "20,0,0"
        self.random = random.Random(7)

    def no_temporaries(self, folder):
        self.assertEqual([str(file) for file in folder.rglob("*") if "part" in file.name], [])

    def interrupt(self, command, number, seconds):
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, cwd=self.folder)
        time.sleep(seconds)
        process.send_signal(number)
        _, errors = process.communicate(timeout=100)
        return process.returncode, errors

    def duration(self, command):
        start = time.time()
        self.check_done(*command)
        return time.time() - start

    def at_random_moments(self, command, check, runs=RUNS):
        """check(code): of what is there after a run that ended with 0, 1, or minus the signal before it could listen."""
        whole = self.duration(command)
        for i in range(runs):
            number = (signal.SIGINT, signal.SIGTERM)[i % 2]
            seconds = self.random.uniform(0, 1.1) * whole
            with self.subTest(signal=number.name, seconds=round(seconds, 4)):
                code, errors = self.interrupt([PROGRAM, *command], number, seconds)
                self.assertIn(code, (0, 1, -number), errors)
                if code == 1:
                    self.assertRegex(errors, r"\Afascicle: .*cancelled[^\n]*\n\Z")
                else:
                    self.assertEqual(errors, "")
                check(code)

    def test_simulate(self):
        out = self.folder / "out"
        notes = out / "notes.txt"

        def check(code):
            self.no_temporaries(self.folder)
            if (out / "summary.json").exists():
                summary = check_run(self, out)
                self.assertIn(summary["state"], ("finished", "cancelled"))
            self.assertEqual(notes.read_text(), "mine")

        out.mkdir()
        notes.write_text("mine")
        self.at_random_moments(["simulate", *self.source, "--export", "vtp", "--out", out], check, 2 * RUNS)

    def test_fibres(self):
        out = self.folder / "out"

        def check(code):
            self.no_temporaries(self.folder)
            if code != 0: # the whole of the run before, which has the same fibres
                self.assertEqual(sorted(file.name for file in out.iterdir()), ["architecture.csv", "fibres", "fibres.csv"])

        self.at_random_moments(["fibres", *self.source, "--set", "fibres.count=50", "--out", out], check)

    def test_pictures_and_reports(self):
        if self.run_program("render", "--help").returncode != 0:
            self.skipTest("built without drawing")
        run, out = self.folder / "run", self.folder / "out"
        out.mkdir()
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        before = file_hashes(run)

        def check_file(file, begin, end):
            def check(code):
                self.no_temporaries(self.folder)
                self.assertEqual(file_hashes(run), before)
                content = file.read_bytes() # of this run, or of the one before
                self.assertTrue(content.startswith(begin) and content.rstrip().endswith(end))
            return check

        size = ["--size", "64x64", "--quiet"]
        few = max(2, RUNS // 3)
        self.at_random_moments(["render", run, "--frame", "3", *size, "--out", out / "a.png"],
                               check_file(out / "a.png", b"\x89PNG", b"IEND\xaeB`\x82"), few)
        self.at_random_moments(["render", *self.source, "--frame", "3", *size, "--out", out / "b.png"],
                               check_file(out / "b.png", b"\x89PNG", b"IEND\xaeB`\x82"), few)
        self.at_random_moments(["render", run, "--frames", "0:10", *size, "--out", out / "a.gif"],
                               check_file(out / "a.gif", b"GIF89a", b";"), few)
        self.at_random_moments(["report", run, "--quiet", "--out", out / "a.html"],
                               check_file(out / "a.html", b"<!DOCTYPE html>", b"</html>"), few)
        film = out / "film"

        def check_film(code):
            self.no_temporaries(self.folder)
            self.assertEqual(len(list(film.iterdir())), 11)
        self.at_random_moments(["render", run, "--frames", "0:10", *size, "--out", film], check_film, few)

    def test_short_commands(self):
        """Either done, or nothing is left."""
        run, out = self.folder / "run", self.folder / "out"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        (self.folder / "m.osim").write_text(MODEL)
        (self.folder / "m.mot").write_text(MOTION)

        def check(code):
            self.no_temporaries(self.folder)
            for file in out.rglob("*.csv"):
                self.assertTrue(file.read_text().endswith("\n"))
        for command in (["lines", "--osim", "m.osim", "--motion", "m.mot", "--export", "vtp", "--out", out],
                        ["compare", run, run, "--out", out], ["convert", "input/strap.obj", out / "a.vtp"]):
            self.at_random_moments(command, check, max(2, RUNS // 2))

    def test_repair_and_export(self):
        run, out = self.folder / "run", self.folder / "out"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        small_scene.write_box(self.folder / "input" / "large.obj", (0, 0, 0), (100, 100, 100), (24, 24, 24))
        before = {folder: file_hashes(folder) for folder in (run, self.folder / "input")}
        ends = {".vtp": b"</VTKFile>", ".usda": b"}", ".json": b"}"}

        def check(code):
            self.no_temporaries(self.folder)
            for folder, hashes in before.items():
                self.assertEqual(file_hashes(folder), hashes)
            for file in out.rglob("*"):
                if file.suffix in ends:
                    self.assertTrue(file.read_bytes().rstrip().endswith(ends[file.suffix]), file)
                elif file.suffix == ".glb":
                    self.assertEqual(int.from_bytes(file.read_bytes()[8:12], "little"), file.stat().st_size)
        for command in (["repair", "input/large.obj", out / "a.vtp", "--report", out / "a.json", "--quiet"],
                        ["export", run, "--out", out / "a.glb", "--quiet"], ["export", run, "--out", out / "a.usda", "--quiet"],
                        ["export", run, "--as", "obj", "--out", out / "obj", "--quiet"]):
            self.at_random_moments(command, check, max(2, RUNS // 2))

    def test_bench(self):
        json_file = self.folder / "bench.json"
        command = [PROGRAM, "bench", "--short", "--part", "paint", "--quiet", "--json", json_file]
        for number in (signal.SIGINT, signal.SIGTERM):
            code, errors = self.interrupt(command, number, self.random.uniform(0.02, 0.2))
            self.assertIn(code, (0, 1, -number), errors)
            if json_file.exists():
                json.loads(json_file.read_text())
            self.no_temporaries(self.folder)

    def test_killed_runs_leave_the_run_before_and_no_lock(self):
        out = self.folder / "out"
        command = ["simulate", *self.source, "--export", "vtp", "--quiet", "--out", out]
        whole = self.duration(command)
        for _ in range(RUNS):
            seconds = self.random.uniform(0.2, 1) * whole
            with self.subTest(seconds=round(seconds, 4)):
                code, _ = self.interrupt([PROGRAM, *command], signal.SIGKILL, seconds)
                self.assertIn(code, (0, -signal.SIGKILL))
                if (out / "summary.json").exists():
                    check_run(self, out)
        # What killed programs left hidden goes with the next run, which no lock keeps out.
        self.check_done(*command)
        self.no_temporaries(out)
        check_run(self, out)

    def test_what_killed_commands_leave_goes_with_the_next(self):
        """SIGKILL at the calls that change files, by the failing file layer: random moments would seldom hit a short command there."""
        if not os.path.exists(SHIM):
            self.skipTest("no failing file layer was built")
        run, out = self.folder / "run", self.folder / "out"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        size = ["--size", "32x32", "--quiet"]
        commands = [["convert", "input/strap.obj", out / "a.vtp"],
                    ["repair", "input/strap.obj", out / "b.vtp", "--report", out / "b.json", "--quiet"],
                    ["export", run, "--out", out / "c.glb", "--quiet"],
                    ["export", run, "--as", "obj", "--out", out / "series", "--quiet"]]
        if self.run_program("render", "--help").returncode == 0:
            commands += [["render", run, "--frame", "1", *size, "--out", out / "d.png"],
                         ["render", run, "--frames", "0:2", *size, "--out", out / "e.gif"]]
        for command in commands:
            with self.subTest(command=command[0], out=str(command)):
                shutil.rmtree(out, ignore_errors=True)
                out.mkdir()
                (out / "z.vtp.part1-0").write_text("somebody's")
                self.check_done(*command)
                before, left, killed = file_hashes(out), 0, 0
                for at in range(1, 7):
                    environment = {**os.environ, "LD_PRELOAD": SHIM, "FAULT_FOLDER": str(out), "FAULT_AT": str(at), "FAULT_KIND": "KILL",
                                   "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}
                    result = self.run_program(*command, env=environment)
                    self.assertIn(result.returncode, (0, -signal.SIGKILL), result.stderr)
                    killed += result.returncode != 0
                    after = file_hashes(out)
                    left += len(set(after) - set(before))
                    self.assertEqual({name: after.get(name) for name in before}, before, "what was there is as it was")
                self.assertGreater(killed, 1)
                self.assertGreater(left, 0, "else this test shows nothing")
                self.check_done(*command)
                self.assertEqual(file_hashes(out), before)

    def test_killed_while_writing_a_file_of_the_editor(self):
        run, user = self.folder / "run", self.folder / "user"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        for what, file in (("project", "my.fascicle"), ("settings", "settings.json"), ("recent", "recent.json"),
                           ("preset", "presets/mine.json")):
            subprocess.run([WRITER, what, run, user], check=True)
            start = time.time()
            subprocess.run([WRITER, what, run, user], check=True)
            whole = time.time() - start
            for _ in range(RUNS):
                self.interrupt([WRITER, what, run, user], signal.SIGKILL, self.random.uniform(0, 1) * whole)
                json.loads((user / file).read_text())
        self.check_done("simulate", "--project", user / "my.fascicle", "--quiet", "--out", self.folder / "again")


class TogetherTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.source, _ = small_scene.write_scene(self.folder / "input")
        self.source[self.source.index("--phases") + 1] = "20,0,0"

    def together(self, commands, **environment):
        started = [subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                    text=True, cwd=self.folder, env={**os.environ, **environment}) for command in commands]
        return [(process.communicate(timeout=200)[1], process.returncode) for process in started]

    def test_one_output_folder(self):
        out = self.folder / "out"
        command = [PROGRAM, "simulate", *self.source, "--export", "vtp", "--quiet", "--out", out]
        refused = 0
        for _ in range(max(2, RUNS // 3)):
            ends = self.together([command, [*command, "--set", "solver.stiffness=0.5"], command])
            self.assertIn(0, [code for _, code in ends])
            for errors, code in ends:
                if code != 0:
                    refused += 1
                    self.assertEqual(code, 1)
                    self.assertRegex(errors, r"\Afascicle: .*out: another program is writing into this folder[^\n]*\n\Z")
            self.assertEqual(check_run(self, out)["state"], "finished")
            self.assertEqual([file for file in out.rglob("*") if "part" in file.name], [])
        self.assertGreater(refused, 0)

    def test_one_cache(self):
        cache = self.folder / "cache"
        command = [PROGRAM, "simulate", *self.source, "--set", "contact.grid_mm=4", "--quiet", "--out"]
        subprocess.run([*map(str, command), str(self.folder / "alone")], check=True)
        expected = json.loads((self.folder / "alone" / "summary.json").read_text())["state_hash"]

        def check(number):
            ends = self.together([[*command, self.folder / str(k)] for k in range(number)], FASCICLE_CACHE=str(cache))
            self.assertEqual([code for _, code in ends], [0] * number, ends)
            for k in range(number):
                summary = json.loads((self.folder / str(k) / "summary.json").read_text())
                self.assertEqual(summary["state_hash"], expected)
            self.assertEqual([file for file in cache.iterdir() if "part" in file.name], [])

        check(4)
        entries = sorted(cache.iterdir())
        self.assertGreater(len(entries), 0)
        good = file_hashes(cache)
        for damage in (lambda whole: b"", lambda whole: whole[:len(whole) // 2], lambda whole: whole[:-1] + b"?",
                       lambda whole: b"?" + whole[1:], lambda whole: whole + b"more"):
            for entry in entries:
                entry.write_bytes(damage(entry.read_bytes()))
            check(2)
            self.assertEqual(file_hashes(cache), good, "damaged entries are made again")
        for entry in entries: # what is no file is passed over
            entry.unlink()
            entry.mkdir()
        check(2)
        shutil.rmtree(cache)
        cache.write_text("no folder")
        ends = self.together([[*command, self.folder / "0"]], FASCICLE_CACHE=str(cache))
        self.assertEqual(ends, [("", 0)])

    def test_one_file_of_the_editor(self):
        run, user = self.folder / "run", self.folder / "user"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", run)
        for what, file in (("project", "my.fascicle"), ("settings", "settings.json"), ("recent", "recent.json")):
            for _ in range(max(2, RUNS // 4)):
                ends = self.together([[WRITER, what, run, user]] * 4)
                self.assertEqual(ends, [("", 0)] * 4)
                json.loads((user / file).read_text())
            self.assertEqual([name for name in user.rglob("*") if "part" in name.name], [])
        self.assertEqual(self.together([[WRITER, "cache", run, user / "cache"]] * 6), [("", 0)] * 6)


if __name__ == "__main__":
    unittest.main()
