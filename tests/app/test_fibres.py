"""fascicle fibres, and fibres in fascicle simulate."""
import csv
import json
import unittest
from xml.etree import ElementTree

from program import SOURCE_DIR, ProgramTest, file_hashes
from small_scene import write_scene


class FibresTest(ProgramTest):
    def rows(self, file):
        with open(file, newline="") as lines:
            return list(csv.DictReader(lines))

    def short_motion(self):
        """Three frames of the two-headed scene's lever."""
        path = self.folder / "motion.csv"
        path.write_text("frame,bone,cx,cy,cz,ax,ay,az,angle_deg\n3,lever,0,0,0,1,0,0,0\n")
        return path

    def test_rest_fibres_are_written(self):
        out = self.folder / "out"
        text = self.check_done("fibres", "--scene", "cylinder", "--set", "fibres.count=20", "--set", "fibres.segments=12",
                               "--out", out)
        self.assertIn("kukacka", text)
        self.assertEqual(set(file_hashes(out)), {"fibres.csv", "architecture.csv", "fibres/strap.0000.vtp"})
        rows = self.rows(out / "fibres.csv")
        self.assertEqual(len(rows), 20)
        self.assertEqual([int(row["fibre"]) for row in rows], list(range(20)))
        self.assertTrue(all(100 < float(row["length_mm"]) < 200 for row in rows))
        summary = self.rows(out / "architecture.csv")[0]
        self.assertEqual((summary["muscle"], summary["method"], summary["fibres"], summary["segments"]),
                         ("strap", "kukacka", "20", "12"))
        self.assertGreater(float(summary["pcsa_cm2"]), 0)

    def test_any_number_of_threads_gives_the_same_fibres(self):
        for method in ("kukacka", "streamlines", "chmd"):
            hashes = []
            for threads in ("1", "2"):
                out = self.folder / f"{method}{threads}"
                self.check_done("fibres", "--scene", "two-heads", "--set", f"fibres.method={method}", "--set",
                                "fibres.count=30", "--threads", threads, "--quiet", "--out", out)
                hashes.append(file_hashes(out / "fibres"))
            self.assertEqual(hashes[0], hashes[1], method)

    def test_simulate_carries_fibres(self):
        out = self.folder / "run"
        options = ["simulate", "--scene", "two-heads", "--motion", self.short_motion(), "--export", "vtp", "--quiet",
                   "--out", out]
        self.check_done(*options, "--set", "fibres.method=streamlines", "--set", "fibres.count=16")
        rows = self.rows(out / "fibres.csv")
        self.assertEqual(len(rows), 16 * 4)
        self.assertEqual({"frame", "muscle", "fibre", "length_mm", "moment_arm_mm"} - set(rows[0]), set())
        self.assertEqual(len(list((out / "fibres").glob("*.vtp"))), 4)
        metrics = self.rows(out / "metrics.csv")
        self.assertAlmostEqual(float(metrics[0]["fibre_strain_mean"]), 0, places=12)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["muscles"][0]["fibres"]["count"], 16)
        picture = self.folder / "fibres.png"
        self.check_done("render", out, "--frame", 3, "--colour", "fibres", "--size", "300x200", "--out", picture)
        plain = self.folder / "plain.png"
        self.check_done("render", out, "--frame", 3, "--size", "300x200", "--out", plain)
        self.assertNotEqual(picture.read_bytes(), plain.read_bytes())
        # The next run without fibres leaves none behind.
        self.check_done(*options)
        self.assertFalse((out / "fibres.csv").exists())
        self.assertNotIn("fibre_strain_mean", self.rows(out / "metrics.csv")[0])

    def test_fibres_become_an_opensim_model(self):
        out = self.folder / "run"
        source, _ = write_scene(self.folder / "scene")
        text = self.check_done("simulate", *source, "--set", "fibres.method=kukacka", "--set", "fibres.count=6",
                               "--set", "fibres.segments=8", "--export", "osim,vtp", "--out", out)
        self.assertRegex(text, r"strap\.osim: \d fibres, .* length within 0\.\d\d mm, moment arm within 0\.\d\d mm")
        files = set(file_hashes(out))
        self.assertLess({"strap.osim", "strap.mot", "strap_report.csv", "strap_report.json",
                         "Geometry/fixed.vtp", "Geometry/turning.vtp"}, files)
        model = ElementTree.parse(out / "strap.osim").getroot()
        self.assertEqual((model.tag, model.get("Version")), ("OpenSimDocument", "40000"))
        rows = self.rows(out / "strap_report.csv")
        muscles = model.findall("./Model/ForceSet/objects/Millard2012EquilibriumMuscle")
        self.assertEqual([m.get("name") for m in muscles], [row["name"] for row in rows])
        self.assertEqual(rows[0]["name"], "strap_f01")
        report = json.loads((out / "strap_report.json").read_text())
        self.assertEqual((report["fitted_frames"], report["other_frames"], report["axes"]), (7, 6, "opensim"))
        self.assertLess(report["largest"]["length_difference_mm"], 1)
        # Of a folder: the same motion, fibres bound anew.
        again = self.folder / "again.osim"
        self.check_done("export", out, "--out", again, "--up", "y")
        self.assertEqual(len(self.rows(self.folder / "again_report.csv")), len(rows))
        self.assertEqual(json.loads((self.folder / "again_report.json").read_text())["axes"], "as-is")

    def test_an_opensim_model_needs_fibres(self):
        out = self.folder / "none"
        self.check_error(2, ["--export osim", "fibres.method"], "simulate", "--scene", "cylinder", "--export", "osim",
                         "--out", out)
        self.assertFalse(out.exists())

    def test_what_cannot_be_decomposed_says_why(self):
        out = self.folder / "out"
        command = ("fibres", "--out", out)
        self.check_error(1, ["box"], *command, "--scene", "squish-box")
        self.check_error(1, ["superficial fibres"], *command, "--scene", "hip", "--set", "fibres.method=chmd")
        self.check_error(2, ["fibres.count"], *command, "--scene", "hip", "--set", "fibres.count=0")
        self.check_error(2, ["nobody"], *command, "--scene", "hip", "--fibre-template", "nobody=x.json")
        bad = self.folder / "bad.json"
        bad.write_text('{"key": "x", "front": []}')
        self.check_error(1, ["bad.json"], *command, "--scene", "cylinder", "--fibre-template", f"strap={bad}")
        own = self.folder / "own" / "fibres" / "strap.0000.vtp"
        own.parent.mkdir(parents=True)
        own.write_text("mine")
        template = self.folder / "own" / "fibres.csv"
        template.write_text((SOURCE_DIR / "resources/fibre_templates/fanned.json").read_text())
        before = file_hashes(self.folder / "own")
        self.check_error(2, ["replace the input"], "fibres", "--scene", "cylinder", "--fibre-template", f"strap={template}",
                         "--out", self.folder / "own")
        self.assertEqual(file_hashes(self.folder / "own"), before)
        self.assertFalse(out.exists() and any(out.iterdir()))


if __name__ == "__main__":
    unittest.main()
