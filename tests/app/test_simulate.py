"""fascicle simulate from mesh files: what it leaves, and that it leaves the same for any number of threads."""
import csv
import json
import os
import re
import subprocess
import unittest

import small_scene
from program import PROGRAM, TIMEOUT, ProgramTest, file_hashes

METRIC_COLUMNS = ("frame,muscle,angle_deg,volume_ratio,edge_extension_mean,edge_extension_p99,"
                  "dihedral_change_mean_rad,penetrating_vertices,penetration_max_mm")
SUMMARY_KEYS = {"scene", "method", "threads", "iterations", "frames", "prepare_seconds", "solve_seconds", "fps_median",
                "fps_mean", "state_hash", "muscles"}


class SimulateTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.source, self.counts = small_scene.write_scene(self.folder / "input")

    def simulate(self, out, *options):
        text = self.check_done("simulate", *self.source, *options, "--out", self.folder / out)
        return self.folder / out, text

    def summary(self, out):
        return json.loads((out / "summary.json").read_text())

    def rows(self, file):
        with open(file, newline="") as lines:
            return list(csv.DictReader(lines))

    def test_everything_the_contract_names_is_there(self):
        before = file_hashes(self.folder / "input")
        out, _ = self.simulate("out", "--export", "vtp,csv", "--threads", "2")
        self.assertEqual(file_hashes(self.folder / "input"), before, "an input was changed")
        self.assertEqual(set(file_hashes(out)), {"summary.json", "metrics.csv", "motion.csv", "strap.pvd",
                                                  "bones/fixed.vtp", "bones/turning.vtp"} |
                         {f"frames/strap.{k:04d}.vtp" for k in range(13)})

        summary = self.summary(out)
        self.assertLessEqual(SUMMARY_KEYS, set(summary))
        self.assertEqual(summary["muscles"][0]["name"], "strap")
        self.assertEqual((summary["muscles"][0]["vertices"], summary["muscles"][0]["triangles"]), self.counts)
        self.assertEqual((summary["method"], summary["threads"], summary["iterations"], summary["frames"]),
                         ("xpbd", 2, 10, 12))
        self.assertEqual(summary["state"], "finished")
        self.assertGreater(summary["fps_median"], 0)

        header = (out / "metrics.csv").read_text().split("\n")[0]
        self.assertTrue(header.startswith(METRIC_COLUMNS + ",") or header == METRIC_COLUMNS, header)
        rows = self.rows(out / "metrics.csv")
        self.assertEqual([int(row["frame"]) for row in rows], list(range(13)))
        self.assertEqual({row["muscle"] for row in rows}, {"strap"})
        self.assertAlmostEqual(float(rows[6]["angle_deg"]), 20, places=6)
        self.assertAlmostEqual(float(rows[8]["angle_deg"]), 10, places=6)
        self.assertAlmostEqual(float(rows[0]["volume_ratio"]), 1, places=9)
        for row in rows:
            self.assertLess(abs(float(row["volume_ratio"]) - 1), 0.01)

    def test_surfaces_carry_depth_and_edge_extension(self):
        out, _ = self.simulate("out", "--export", "vtp")
        rows = self.rows(out / "metrics.csv")

        def array(frame, name):
            text = (out / "frames" / f"strap.{frame:04d}.vtp").read_text()
            values = re.search(f'<DataArray[^>]*Name="{name}"[^>]*>([^<]*)<', text.split("<PointData")[1]).group(1)
            return [float(value) for value in values.split()]

        self.assertEqual(array(0, "depth"), [0.0] * self.counts[0])
        self.assertEqual(array(0, "edge_extension"), [1.0] * self.counts[0])
        for k in (3, 6, 12):
            self.assertEqual(len(array(k, "depth")), self.counts[0])
            self.assertAlmostEqual(max(array(k, "depth")), float(rows[k]["penetration_max_mm"]), places=9)
            self.assertEqual(sum(depth > 0.1 for depth in array(k, "depth")), float(rows[k]["penetrating_vertices"]))
            extension = array(k, "edge_extension")
            self.assertLess(max(extension), float(rows[k]["edge_extension_max"]) + 1e-9)
        self.assertGreater(max(array(6, "edge_extension")), 1.01)

    def test_motion_is_the_hinge_turn_of_the_moving_bone(self):
        out, _ = self.simulate("out")
        rows = self.rows(out / "motion.csv")
        self.assertEqual(list(rows[0])[:6], ["frame", "bone", "m00", "m01", "m02", "m03"])
        self.assertEqual(len(rows), 2 * 13)
        import math
        turn = {(row["frame"], row["bone"]): row for row in rows}
        half = turn["3", "turning"]
        angle = math.radians(10)
        self.assertAlmostEqual(float(half["m11"]), math.cos(angle), places=9)
        self.assertAlmostEqual(float(half["m12"]), -math.sin(angle), places=9)
        # The centre (0, 0, -40) stays where it is.
        self.assertAlmostEqual(float(half["m22"]) * -40 + float(half["m23"]), -40, places=9)
        self.assertEqual(float(turn["3", "fixed"]["m11"]), 1.0)

    def test_same_state_for_any_number_of_threads_and_on_every_run(self):
        hashes = {}
        for name, threads in (("a", 1), ("b", 2), ("c", 3), ("d", 8), ("e", 1)):
            out, _ = self.simulate(name, "--threads", threads, "--export", "vtp")
            hashes[name] = self.summary(out)["state_hash"]
            self.assertEqual(file_hashes(out / "frames"), file_hashes(self.folder / "a" / "frames"), f"run {name}")
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        other, _ = self.simulate("f", "--set", "solver.stiffness=0.5")
        self.assertNotEqual(self.summary(other)["state_hash"], hashes["a"])

    def test_cached_distance_grids_change_nothing_and_may_be_shared_lost_or_locked(self):
        plain = self.summary(self.simulate("plain")[0])["state_hash"]
        cache = self.folder / "cache"
        environment = {**os.environ, "FASCICLE_CACHE": str(cache)}

        def start(out):
            return subprocess.Popen([PROGRAM, "simulate", *map(str, self.source), "--quiet", "--out", str(self.folder / out)],
                                    env=environment, stderr=subprocess.PIPE, text=True)

        def check(out, run):
            _, errors = run.communicate(timeout=TIMEOUT)
            self.assertEqual((run.returncode, errors), (0, ""))
            self.assertEqual(self.summary(self.folder / out)["state_hash"], plain)

        for out, run in [(out, start(out)) for out in ("first", "second", "third")]:  # all at once
            check(out, run)
        files = sorted(cache.iterdir())
        self.assertEqual(len(files), 2, files)  # one per bone
        files[0].write_bytes(files[0].read_bytes()[:1000])
        files[1].unlink()
        check("after damage", start("after damage"))
        self.assertEqual(sorted(cache.iterdir()), files)
        environment["FASCICLE_CACHE"] = str(files[0])  # a file where the folder should be
        check("no folder", start("no folder"))

    def test_every_thins_the_surfaces_and_keeps_the_last(self):
        out, _ = self.simulate("out", "--export", "vtp", "--every", "5")
        self.assertEqual(sorted(file_hashes(out / "frames")),
                         [f"strap.{k:04d}.vtp" for k in (0, 5, 10, 12)])
        self.assertEqual(len(self.rows(out / "metrics.csv")), 13)

    def test_a_second_run_replaces_the_first(self):
        out, _ = self.simulate("out", "--export", "vtp")
        first = file_hashes(out / "frames")
        self.source[self.source.index("--phases") + 1] = "3,0,0"
        self.simulate("out", "--export", "vtp")
        self.assertEqual(self.summary(out)["frames"], 3)
        self.assertEqual(len(self.rows(out / "metrics.csv")), 4)
        self.assertEqual(len(file_hashes(out / "frames")), 4, f"stale frames of {len(first)}")

    def test_classic_runs_and_is_named(self):
        out, _ = self.simulate("out", "--method", "classic")
        summary = self.summary(out)
        self.assertEqual((summary["method"], summary["iterations"]), ("classic", 3))
        out, _ = self.simulate("out2", "--method", "classic", "--iterations", "1")
        self.assertEqual(self.summary(out)["iterations"], 1)

    def test_parameters_reach_the_run_and_the_summary(self):
        out, _ = self.simulate("out", "--set", "solver.pressure=1.2", "--set", "solver.method=classic")
        summary = self.summary(out)
        self.assertEqual(summary["method"], "classic")
        self.assertEqual(float(summary["parameters"]["solver.pressure"]), 1.2)
        self.assertEqual(float(summary["parameters"]["solver.bending"]), 0.9, "the method's own default")

    def test_progress_and_closing_table(self):
        result = self.run_program("simulate", *self.source, "--out", "out")
        self.assertEqual(result.returncode, 0)
        self.assertIn("solve 100 %, frame 12 of 12", result.stdout)
        self.assertEqual(result.stderr, "")
        self.assertIn("strap", result.stdout)
        self.assertIn("volume", result.stdout)
        quiet = self.run_program("simulate", *self.source, "--out", "out", "--quiet")
        self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
