"""fascicle bench --short: what it prints and writes. Never how fast anything is."""
import json
import signal
import statistics
import subprocess
import unittest

from program import PROGRAM, ProgramTest, file_hashes

SPREAD = {"median", "min", "max", "runs"}


class BenchTest(ProgramTest):
    def bench(self, *options):
        text = self.check_done("bench", "--short", "--case", "squish-box", *options)
        return text, json.loads((self.folder / "bench.json").read_text())

    def check_spread(self, spread, runs):
        self.assertEqual(set(spread), SPREAD)
        self.assertEqual(spread["runs"], runs)
        self.assertGreater(spread["min"], 0)
        self.assertLessEqual(spread["min"], spread["median"])
        self.assertLessEqual(spread["median"], spread["max"])

    def test_short_bench_has_every_part_and_ratios_that_fit(self):
        text, report = self.bench("--quiet", "--runs", "3")
        self.assertEqual(report["runs"], 3)
        self.assertTrue(report["compiler"] and report["flags"] and report["machine"]["cpu"])
        self.assertGreaterEqual(report["machine"]["threads"], 1)
        (case,) = report["cases"]
        self.assertEqual((case["name"], case["triangles"], case["frames"]), ("squish-box", 5292, 2))

        rows = report["frames"]
        skipped = {skip["what"] for skip in report["skipped"]}
        methods = {row["method"] for row in rows}
        self.assertEqual(methods | skipped, {"classic", "reference", "sweeps", "fast", "bullet"})
        self.assertEqual({(row["method"], row["passes"], row["threads"]) for row in rows if row["method"] not in ("sweeps", "fast")} -
                         {("bullet", 3, 1)}, {("classic", 3, 1), ("reference", 3, 1), ("reference", 10, 1)})
        classic = next(row for row in rows if row["method"] == "classic")["frames_per_second"]["median"]
        for row in rows:
            self.check_spread(row["frames_per_second"], 3)
            self.assertAlmostEqual(row["frames_per_second"]["median"], statistics.median(row["runs"]))
            self.assertAlmostEqual(row["times_classic"], row["frames_per_second"]["median"] / classic)
            self.assertIsNone(row["times_published"])  # was never measured on this scene
            self.assertAlmostEqual(row["pass_us"] * row["passes"] * row["frames_per_second"]["median"], 1e6, delta=1)
            self.assertLessEqual(sum(row["stage_us"].values()), 1.5 * row["pass_us"] * row["threads"])
            self.assertIn(row["method"], text)
            if row["method"] != "bullet":
                self.assertGreater(row["bytes_per_triangle"], 50)
                self.assertTrue(row["stage_us"])
        self.check_same_state(rows)

        self.assertEqual(report["main_case"], "squish-box")
        self.assertEqual([(row["triangles"], row["threads"]) for row in report["scaling"]],
                         [(5292, 1), (5292, 2), (4 * 5292, 1), (4 * 5292, 2)])
        for row in report["scaling"]:
            self.check_spread(row["ns_per_triangle_substep"], 3)
        self.assertEqual({row["threads"] for row in report["prepare"]}, {1, 2})
        for row in report["prepare"]:
            self.check_spread(row["seconds"], 3)
            self.assertIn(row["cache"], ("cold", "warm"))
            self.assertLessEqual({"read", "solvers"}, set(row["stage_seconds"]))
        self.assertEqual(len(report["paint"]), 4)
        for row in report["paint"]:
            self.check_spread(row["value"], 3)
        self.assertTrue(any("triad in memory" == row["name"] for row in report["limits"]))
        for row in report["limits"]:
            self.check_spread(row["value"], 3)
        self.assertIn("short form", text)

    def check_same_state(self, rows):
        """The same method with the same passes ends in the same state whatever the number of threads."""
        hashes = {}
        for row in rows:
            hashes.setdefault((row["method"], row["passes"]), set()).add(row["state_hash"])
        self.assertTrue(all(len(found) == 1 for found in hashes.values()), hashes)

    def test_parts_methods_and_threads_can_be_chosen(self):
        _, report = self.bench("--part", "frames", "--method", "classic,reference", "--threads", "1", "--frames", "1")
        self.assertEqual({row["method"] for row in report["frames"]}, {"classic", "reference"})
        self.assertEqual((report["scaling"], report["prepare"], report["paint"], report["limits"]), ([], [], [], []))
        self.assertEqual(report["cases"][0]["frames"], 1)

    def test_a_case_without_data_is_left_out_with_the_reason(self):
        (self.folder / "empty").mkdir()
        out = self.check_done("bench", "--short", "--quiet", "--data", "empty", "--case", "iliacus", "--json", "x.json")
        self.assertIn("left out: iliacus, ", out)
        report = json.loads((self.folder / "x.json").read_text())
        self.assertIn("iliacus.vtk: no such file", report["skipped"][-1]["reason"] + report["skipped"][0]["reason"] +
                      report["skipped"][1]["reason"])
        self.assertEqual(report["frames"], [])

    def test_wrong_options(self):
        self.check_error(2, ["--case", "squish-bx", "did you mean 'squish-box'?"], "bench", "--case", "squish-bx")
        self.check_error(2, ["--part", "got 'x'"], "bench", "--part", "x")
        self.check_error(2, ["--threads", "got '0'"], "bench", "--threads", "1,0")
        self.check_error(2, ["--data", "no folder"], "bench", "--data", "nowhere")
        self.check_error(1, ["/proc/none", "cannot"], "bench", "--short", "--quiet", "--case", "squish-box", "--part", "frames",
                         "--method", "classic", "--json", "/proc/none/bench.json")

    def test_an_interrupt_ends_it_and_leaves_nothing(self):
        process = subprocess.Popen([PROGRAM, "bench", "--case", "squish-box", "--part", "frames", "--runs", "1000"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while "classic" not in (line := process.stdout.readline()):  # progress: frames are being timed
            self.assertNotEqual(line, "", "ended by itself")
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, errors), (1, "fascicle: bench: cancelled; nothing was written\n"))
        self.assertEqual(file_hashes(self.folder), {})


if __name__ == "__main__":
    unittest.main()
