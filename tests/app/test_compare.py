"""fascicle compare: two runs against each other."""
import csv
import json
import math
import re
import unittest

from program import ProgramTest
from small_scene import write_scene


class CompareTest(ProgramTest):
    def simulate(self, name, *more):
        source, _ = write_scene(self.folder / "scene")
        self.check_done("simulate", *source, "--export", "vtp", "--threads", "1", "--quiet", "--out", name, *more)

    def rows(self):
        with open(self.folder / "out" / "difference.csv", newline="") as file:
            return list(csv.DictReader(file))

    def points(self, run, frame):
        """Positions of the strap in a frame, from the ascii or binary-free part of the vtp that every reader knows."""
        text = (self.folder / run / "frames" / f"strap.{frame:04d}.vtp").read_text()
        body = re.search(r"<Points>\s*<DataArray[^>]*>(.*?)</DataArray>", text, re.S).group(1)
        numbers = [float(x) for x in body.split()]
        return list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))

    def test_two_runs(self):
        self.simulate("a")
        self.simulate("b", "--set", "solver.stiffness=0.2", "--every", "4")
        text = self.check_done("compare", "a", "b", "--out", "out", "--threads", "1")
        self.assertIn("solver.stiffness: 0.9 in A, 0.2 in B", text)
        rows = self.rows()
        self.assertEqual([int(r["frame"]) for r in rows], [0, 4, 8, 12])
        self.assertEqual(float(rows[0]["max_mm"]), 0)
        self.assertGreater(float(rows[2]["max_mm"]), 0)
        for row in rows:  # against a loop over the files' own numbers
            pairs = zip(self.points("a", int(row["frame"])), self.points("b", int(row["frame"])))
            distances = [math.dist(p, q) for p, q in pairs]
            rms = math.sqrt(sum(d * d for d in distances) / len(distances))
            self.assertAlmostEqual(float(row["rms_mm"]), rms, places=9)
            self.assertAlmostEqual(float(row["max_mm"]), max(distances), places=9)
        summary = json.loads((self.folder / "out" / "comparison.json").read_text())
        self.assertEqual([p["key"] for p in summary["parameters"]], ["solver.stiffness"])
        self.assertEqual((summary["parameters"][0]["a"], summary["parameters"][0]["b"]), (0.9, 0.2))
        self.assertEqual(summary["common_frames"], 4)
        largest = max(rows, key=lambda r: float(r["max_mm"]))
        self.assertEqual(summary["muscles"][0]["max_frame"], int(largest["frame"]))
        with open(self.folder / "a" / "metrics.csv", newline="") as file:
            a = {r["frame"]: r for r in csv.DictReader(file)}
        with open(self.folder / "b" / "metrics.csv", newline="") as file:
            b = {r["frame"]: r for r in csv.DictReader(file)}
        for row in rows:  # the runs' own tables say the same, up to the rounding of the files
            k = row["frame"]
            self.assertAlmostEqual(float(row["b_minus_a_volume_ratio"]),
                                   float(b[k]["volume_ratio"]) - float(a[k]["volume_ratio"]), places=6)
        self.assertNotIn("b_minus_a_solve_ms", rows[0])

    def test_a_run_against_itself(self):
        self.simulate("a")
        self.assertIn("all parameters are the same", self.check_done("compare", "a", "a", "--out", "out"))
        for row in self.rows():
            self.assertEqual(float(row["max_mm"]), 0)
            self.assertEqual(float(row["b_minus_a_edge_extension_mean"]), 0)

    def test_bad_input(self):
        self.simulate("a")
        self.check_error(2, ["two runs", "RUN_A RUN_B"], "compare", "a", "--out", "out")
        self.check_error(2, ["--out DIR"], "compare", "a", "a")
        self.check_error(1, ["nowhere"], "compare", "a", "nowhere", "--out", "out")
        source, _ = write_scene(self.folder / "scene")
        self.check_done("simulate", *source, "--threads", "1", "--quiet", "--out", "no_frames")
        self.check_error(1, ["no_frames", "--export vtp"], "compare", "a", "no_frames", "--out", "out")
        (self.folder / "scene" / "strap.obj").rename(self.folder / "scene" / "belt.obj")
        source[source.index("--muscle") + 1] = self.folder / "scene" / "belt.obj"
        self.check_done("simulate", *source, "--export", "vtp", "--threads", "1", "--quiet", "--out", "belt")
        self.check_error(1, ["cannot be compared", "strap is only in A"], "compare", "a", "belt", "--out", "out")
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
