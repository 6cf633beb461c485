"""Ctrl-C in the middle of a run: what is done so far stays, complete and valid."""
import csv
import json
import os
import pty
import re
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as xml

import small_scene
from program import PROGRAM, ProgramTest


class InterruptTest(ProgramTest):
    def setUp(self):
        super().setUp()
        source, _ = small_scene.write_scene(self.folder / "input")
        source[source.index("--phases") + 1] = "100000,0,0"  # longer than any test waits
        self.out = self.folder / "out"
        self.command = [PROGRAM, "simulate", *map(str, source), "--export", "vtp", "--out", str(self.out)]

    def start(self, **options):
        process = subprocess.Popen(self.command, stdout=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        deadline = time.time() + 60
        # Frames are hidden until the run ends.
        while not list(self.out.glob(".fascicle-part-*/frames/strap.0003.vtp")):
            self.assertIsNone(process.poll(), "ended by itself")
            self.assertLess(time.time(), deadline, "no frames within a minute")
            time.sleep(0.02)
        return process

    def check_folder(self, last):
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual((summary["state"], summary["frames"]), ("cancelled", last))
        for name in ("metrics.csv", "motion.csv"):
            with open(self.out / name, newline="") as lines:
                rows = list(csv.DictReader(lines))
            self.assertEqual(sorted({int(row["frame"]) for row in rows}), list(range(last + 1)), name)
            self.assertFalse(any(None in row.values() for row in rows), name)
        frames = sorted(file.name for file in (self.out / "frames").iterdir())
        self.assertEqual(frames, [f"strap.{k:04d}.vtp" for k in range(last + 1)])
        xml.parse(self.out / "frames" / frames[-1])
        series = xml.parse(self.out / "strap.pvd").getroot().findall(".//DataSet")
        self.assertEqual([entry.get("file") for entry in series], [f"frames/{name}" for name in frames])
        self.assertEqual([file for file in self.out.rglob("*.part*")], [])

    def test_signals_stop_a_run_cleanly(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                process = self.start(stderr=subprocess.PIPE)
                self.addCleanup(process.stderr.close)
                process.send_signal(number)
                _, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 1)
                told = re.fullmatch(r"fascicle: cancelled at frame (\d+) of 100000; (.*) holds frames 0\.\.(\d+)\n",
                                    errors)
                self.assertIsNotNone(told, errors)
                self.assertEqual(told[2], str(self.out))
                self.assertEqual(told[1], told[3])
                self.check_folder(int(told[1]))
                for file in (self.out / "frames").iterdir():
                    file.unlink()

    def test_a_terminal_gets_a_bar(self):
        try:
            master, slave = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminal to be had: {error}")
        self.addCleanup(os.close, master)
        process = self.start(stderr=slave)
        os.close(slave)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        process.wait(timeout=60)
        text = os.read(master, 1 << 16).decode()
        self.assertRegex(text, r"\rsolve \[[#.]{24}\] 0 %  \d+/100000  [0-9.]+ frames/s, [0-9:]+ left")
        self.assertIn("\r\x1b[K", text)


if __name__ == "__main__":
    unittest.main()
