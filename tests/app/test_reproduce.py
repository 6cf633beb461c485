"""fascicle reproduce --short: the same numbers twice; restart; errors. Never how fast anything is. Stand-ins alone, so that it tells the
same everywhere; .ci/run makes the whole report."""
import csv
import json
import signal
import subprocess
import sys
import time
import unittest

from program import PROGRAM, SOURCE_DIR, TIMEOUT, ProgramTest, file_hashes

sys.path.insert(0, f"{SOURCE_DIR}/tools")
from check_report import check_folder  # noqa: E402

TIMES = {"report.html", "timings.json", "speed.csv"}  # hold times, or the date


class ReproduceTest(ProgramTest):
    def command(self, out, *options):
        nothing = self.folder / "no data"
        nothing.mkdir(exist_ok=True)
        return ["reproduce", "--short", "--quiet", *options, "--data", str(nothing), "--out", str(self.folder / out)]

    def reproduce(self, out, *options):
        return self.check_done(*self.command(out, *options))

    def files(self, out):
        return {name: value for name, value in file_hashes(self.folder / out).items() if not name.startswith("work/")}

    def test_two_runs_give_the_same_numbers_and_a_report_that_passes_the_check(self):
        # Every method once, and every part of the report; the other experiments would show nothing new.
        self.reproduce("a", "--threads", "1", "--only", "iliacus,gluteus_medius,sensitivity,speed")
        self.reproduce("b", "--threads", "2", "--only", "iliacus,gluteus_medius,sensitivity")
        a, b = self.files("a"), self.files("b")
        self.assertEqual(set(a), set(b) | {"speed.csv"})
        self.assertLessEqual({"report.html", "results.json", "timings.json", "curves.csv", "moment_arms.csv", "sensitivity.csv",
                              "speed.csv"}, set(a))
        for name in set(a) - TIMES:
            self.assertEqual(a[name], b[name], f"{name} differs between two runs")
        faults, summary = check_folder(self.folder / "a")
        self.assertEqual(faults, [])
        self.assertRegex(summary, r"^1 experiments, \d+ runs, \d+ methods, \d+ plots, \d+ pictures, ")

        results = json.loads((self.folder / "a" / "results.json").read_text())
        self.assertTrue(results["short"])
        self.assertLessEqual({"xpbd", "classic"}, set(results["methods"]))
        iliacus, medius = results["experiments"]
        self.assertEqual([run["method"] for run in iliacus["runs"]], results["methods"])
        self.assertTrue(iliacus["data"].startswith("embedded scene"))
        for run in iliacus["runs"]:
            if "attachment_drift_mm" in run["metrics"]:
                self.assertLess(run["metrics"]["attachment_drift_mm"]["greatest"], 1e-6, run["method"])
        self.assertIn("gluteus_medius.vtk", medius["left_out"])
        self.assertEqual([v["variant"] for v in results["sensitivity"]["variants"]],
                         ["as given", "remeshed evenly", "half the triangles", "twice the triangles", "half the passes", "twice the passes"])
        given, _, half, twice = results["sensitivity"]["variants"][:4]
        self.assertLess(half["triangles"], 0.6 * given["triangles"])
        self.assertGreater(twice["triangles"], 1.8 * given["triangles"])

        with open(self.folder / "a" / "curves.csv", newline="") as lines:
            rows = list(csv.DictReader(lines))
        own = [row for row in rows if (row["experiment"], row["method"]) == ("iliacus", "xpbd")]
        self.assertEqual([float(row["frame"]) for row in own], [25.0 * k for k in range(13)])
        self.assertEqual(float(own[0]["volume_ratio"]), 1)
        self.assertTrue(all(abs(float(row["volume_ratio"]) - 1) < 0.01 for row in own))
        with open(self.folder / "a" / "fibre_lengths-iliacus-xpbd.csv", newline="") as lines:
            fibres = list(csv.reader(lines))
        self.assertEqual((len(fibres), len(fibres[0])), (14, 102))

        # The check itself finds what is wrong.
        page = self.folder / "a" / "report.html"
        text = page.read_text()
        for old, new, fault in (("</main>", '<script src="https://example.org/x.js"></script></main>', "refers to 'https"),
                                ("Fig. 12", "Plot 12", "nothing is said of figures [12]"),
                                ("<footer>", "<footer>1.5e-07 ", "'5e-0'"),
                                ('class="verdict', 'class="word', "has no sentence from the data")):
            self.assertIn(old, text)
            page.write_text(text.replace(old, new))
            self.assertIn(fault, " ".join(check_folder(self.folder / "a")[0]))

    def test_finished_runs_are_used_again_and_a_damaged_one_is_made_again(self):
        options = ("--only", "squish-box", "--methods", "classic")
        self.reproduce("out", *options)
        first = self.files("out")
        (run,) = (self.folder / "out" / "work").iterdir()
        before = file_hashes(run)
        self.reproduce("out", *options)
        self.assertEqual(file_hashes(run), before)
        self.assertTrue(json.loads((self.folder / "out" / "timings.json").read_text())["runs"][0]["reused"])
        self.assertEqual(self.files("out")["results.json"], first["results.json"])

        table = run / "metrics.csv"
        table.write_text(table.read_text()[:-40])
        self.reproduce("out", *options)
        self.assertFalse(json.loads((self.folder / "out" / "timings.json").read_text())["runs"][0]["reused"])
        self.assertEqual(self.files("out")["results.json"], first["results.json"])

    def test_a_smaller_report_leaves_no_table_of_a_larger_one(self):
        self.reproduce("out", "--only", "iliacus", "--methods", "classic")
        self.assertIn("fibre_lengths-iliacus-classic.csv", self.files("out"))
        (self.folder / "out" / "mine.csv").write_text("stays")
        self.reproduce("out", "--only", "squish-box", "--methods", "classic")
        self.assertEqual(set(self.files("out")), {"report.html", "results.json", "timings.json", "curves.csv",
                                                  "published_program.csv", "mine.csv"})

    def test_an_interrupted_report_goes_on_where_it_was_cut_off(self):
        out = self.folder / "out"
        command = [PROGRAM, *self.command("out", "--only", "iliacus", "--methods", "classic,xpbd")]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        deadline = time.time() + TIMEOUT
        while not list(out.glob("work/*/run.json")):  # the first run is finished
            self.assertIsNone(process.poll(), "ended by itself")
            self.assertLess(time.time(), deadline)
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=TIMEOUT)
        if process.returncode == 0:
            self.skipTest("was done before the signal came")
        self.assertEqual(process.returncode, 1)
        self.assertRegex(errors, r"^fascicle: cancelled, no report was written; what is finished is kept in .*/work, "
                                 r"and the same command goes on there\n$")
        self.assertEqual({path.name for path in out.iterdir()}, {"work"})
        kept = {path.parent.name: file_hashes(path.parent) for path in out.glob("work/*/run.json")}
        self.assertGreaterEqual(len(kept), 1)
        subprocess.run(command, check=True, timeout=TIMEOUT, capture_output=True)
        for name, hashes in kept.items():
            self.assertEqual(file_hashes(out / "work" / name), hashes, "a finished run was made again")
        self.assertTrue((out / "report.html").is_file())

    def test_the_command_line_is_checked_before_anything_is_made(self):
        self.check_error(2, ["--out DIR"], "reproduce")
        self.check_error(2, ["--only", "iliacus"], "reproduce", "--only", "iliacos", "--out", "out")
        self.check_error(2, ["--methods", "classic"], "reproduce", "--methods", "clasic", "--out", "out")
        self.check_error(2, ["--data", "no folder"], "reproduce", "--data", "nowhere", "--out", "out")
        self.check_error(2, ["--threads"], "reproduce", "--threads", "0", "--out", "out")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_run_that_fails_is_told_and_tables_of_a_users_own_stay(self):
        out = self.folder / "a"
        out.mkdir()
        (out / "work").write_text("no folder, so that no run can be made")
        (out / "speed.csv").write_text("mine")
        self.check_error(1, ["squish-box", "xpbd"], *self.command("a", "--only", "squish-box", "--methods", "xpbd"))
        self.assertIn("squish-box", (out / "report.html").read_text())
        self.assertEqual((out / "speed.csv").read_text(), "mine")


if __name__ == "__main__":
    unittest.main()
