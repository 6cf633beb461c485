"""fascicle reproduce --short: the whole report twice, the same numbers; restart; errors. Never how fast anything is."""
import csv
import json
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as xml

from program import PROGRAM, TIMEOUT, ProgramTest, file_hashes

TIMES = {"report.html", "timings.json", "speed.csv"}  # hold times, or the date


class ReproduceTest(ProgramTest):
    def reproduce(self, out, *options):
        return self.check_done("reproduce", "--short", "--quiet", *options, "--out", self.folder / out)

    def files(self, out):
        return {name: value for name, value in file_hashes(self.folder / out).items() if not name.startswith("work/")}

    def test_two_runs_give_the_same_numbers_and_a_whole_report(self):
        self.reproduce("a", "--threads", "1")
        self.reproduce("b", "--threads", "2")
        a, b = self.files("a"), self.files("b")
        self.assertEqual(set(a), set(b))
        self.assertLessEqual({"report.html", "results.json", "timings.json", "curves.csv", "moment_arms.csv", "sensitivity.csv",
                              "speed.csv"}, set(a))
        for name in set(a) - TIMES:
            self.assertEqual(a[name], b[name], f"{name} differs between two runs")

        results = json.loads((self.folder / "a" / "results.json").read_text())
        self.assertTrue(results["short"])
        self.assertIn("xpbd", results["methods"])
        self.assertIn("classic", results["methods"])
        done = {e["key"]: e for e in results["experiments"] if "left_out" not in e}
        self.assertLessEqual({"squish-box", "iliacus", "gluteus_maximus"}, set(done))
        for key in ("squish-box", "iliacus", "gluteus_maximus"):
            self.assertEqual([run["method"] for run in done[key]["runs"]], results["methods"], key)
            self.assertTrue(done[key]["data"].startswith("embedded scene"))
            for run in done[key]["runs"]:
                self.assertNotIn("failed", run)
                self.assertEqual(run["metrics"]["attachment_drift_mm"]["greatest"] < 1e-6
                                 if "attachment_drift_mm" in run["metrics"] else True, True, (key, run["method"]))
            self.assertTrue(done[key]["findings"])
        left_out = {e["key"]: e["left_out"] for e in results["experiments"] if "left_out" in e}
        self.assertIn("gluteus_medius.vtk", left_out["gluteus_medius"])
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

        page = (self.folder / "a" / "report.html").read_text()
        root = xml.fromstring(page.replace("<!DOCTYPE html>", ""))
        self.assertFalse([e for e in root.iter() if e.tag.endswith("script") or e.get("href")])
        self.assertGreater(len([e for e in root.iter() if e.tag.endswith("svg")]), 10)
        self.assertGreater(page.count("data:image/png;base64,"), 10)
        self.assertNotRegex(page, r"\bnan\b")

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
        command = [PROGRAM, "reproduce", "--short", "--quiet", "--only", "squish-box,iliacus", "--methods", "classic,xpbd",
                   "--out", str(out)]
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


if __name__ == "__main__":
    unittest.main()
