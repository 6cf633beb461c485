"""fascicle export of a run: what it must not touch, and runs that have not all frames as files."""
import csv
import json
import unittest

from program import ProgramTest, file_hashes
from small_scene import write_scene


class ExportTest(ProgramTest):
    def simulate(self, name, *more):
        source, _ = write_scene(self.folder / "scene")
        self.check_done("simulate", *source, "--export", "vtp", "--threads", "1", "--quiet", "--out", name, *more)

    def test_the_run_that_is_read_is_never_changed(self):
        self.simulate("a")
        before = file_hashes(self.folder / "a")
        for kind, out in (("metrics", "a/summary.csv"), ("metrics", "a/metrics.csv"), ("json", "a/summary.json")):
            self.check_error(2, ["another name"], "export", "a", "--as", kind, "--out", out)
            self.assertEqual(file_hashes(self.folder / "a"), before, (kind, out))
        for kind, out in (("run", "a"), ("run", "a/."), ("meshes", "a"), ("obj", "a"), ("fibres", "a"), ("meshes", "a/frames"),
                          ("pc2", "scene/../a/bones"), ("fibres", "a/fibres/more")):
            self.check_error(2, ["another folder"], "export", "a", "--as", kind, "--out", out)
            self.assertEqual(file_hashes(self.folder / "a"), before, (kind, out))
        self.check_done("export", "a", "--as", "obj", "--out", "a/obj")  # as simulate --export leaves it
        self.assertEqual({**file_hashes(self.folder / "a"), **before}, file_hashes(self.folder / "a"))

    def test_a_table_of_a_users_own_stays_one_of_ours_goes(self):
        table = self.folder / "a" / "fibres.csv"
        table.parent.mkdir()
        table.write_text("frame,mine\n")
        self.simulate("a")
        self.assertEqual(table.read_text(), "frame,mine\n")
        self.simulate("a", "--set", "fibres.method=kukacka", "--set", "fibres.count=4")
        self.assertTrue(table.read_text().startswith("frame,muscle,fibre,angle_deg,"))
        self.simulate("a")  # without fibres: the table would pass for its own
        self.assertFalse(table.exists())

    def test_exports_of_an_earlier_run_go_with_it(self):
        source, _ = write_scene(self.folder / "scene")
        run = self.folder / "a"
        simulate = ["simulate", *source, "--threads", "1", "--quiet", "--out", "a"]
        self.check_done(*simulate, "--export", "json,obj,glb,usda")
        self.assertTrue((run / "metrics.json").exists() and (run / "strap.glb").exists())
        summary = json.loads((run / "summary.json").read_text())
        self.assertEqual(sorted(entry["file"] for entry in summary["exports"]), sorted(name for name in file_hashes(run) if name not in
                         ("summary.json", "metrics.csv", "motion.csv")))
        (run / "obj" / "mine.txt").write_text("mine")
        (run / "notes.txt").write_text("mine")
        (self.folder / "far.txt").write_text("mine")
        for path in ("../far.txt", str(self.folder / "far.txt"), "obj/../notes.txt", "obj", "", 3, "notes.txt"):
            summary["exports"].append({"file": path, "bytes": 4, "written": 3})  # a summary may say anything
        summary["exports"] += ["notes.txt", {"file": "notes.txt"}, None]
        (run / "summary.json").write_text(json.dumps(summary))
        self.check_done(*simulate, "--export", "usda")
        self.assertEqual(sorted(file_hashes(run)),
                         ["metrics.csv", "motion.csv", "notes.txt", "obj/mine.txt", "strap.usda", "summary.json"])
        self.assertTrue((self.folder / "far.txt").exists())
        # An export that has become an input stays.
        self.check_done(*simulate, "--export", "pc2")
        strap = run / "pc2" / "strap.obj"
        before = strap.read_bytes()
        self.check_done(*[strap if str(word).endswith("strap.obj") else word for word in simulate])
        self.assertEqual(strap.read_bytes(), before)
        self.assertTrue((run / "pc2" / "strap.pc2").exists())  # it may need the others
        # So does one that somebody has changed.
        self.check_done(*simulate, "--export", "json,usda")
        (run / "metrics.json").write_text("{}")
        self.check_done(*simulate)
        self.assertTrue((run / "metrics.json").exists())
        self.assertFalse((run / "strap.usda").exists())

    def test_fibres_are_polylines_without_being_asked_for(self):
        self.check_done("simulate", *write_scene(self.folder / "scene")[0], "--set", "fibres.method=kukacka", "--set",
                        "fibres.count=4", "--every", "5", "--threads", "1", "--quiet", "--out", "a")
        self.assertEqual(sorted(p.name for p in (self.folder / "a" / "fibres").glob("*.vtp")),
                         [f"strap.{k:04d}.vtp" for k in (0, 5, 10, 12)])
        self.assertFalse((self.folder / "a" / "frames").exists())

    def test_frames_are_refused_where_there_is_no_choice(self):
        self.simulate("a")
        for kind in ("metrics", "json", "run", "osim"):
            self.check_error(2, ["--frames", kind], "export", "a", "--as", kind, "--out", "x", "--frames", "0:4")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["a", "scene"])

    def test_a_thinned_run_is_written_as_a_run(self):
        fibres = ("--set", "fibres.method=kukacka", "--set", "fibres.count=4")
        self.simulate("whole", *fibres)
        self.simulate("thin", "--every", "5", *fibres)
        self.check_done("export", "thin", "--as", "run", "--out", "again")
        summary = json.loads((self.folder / "again" / "summary.json").read_text())
        self.assertEqual(summary["vtp_frames"], [0, 5, 10, 12])
        first = json.loads((self.folder / "thin" / "summary.json").read_text())
        self.assertTrue(all(entry["hash"] for entry in first["inputs"]))
        for key in ("inputs", "threads", "method", "parameters"):  # facts of the run, not of the export
            self.assertEqual(summary[key], first[key], key)
        for frame in summary["vtp_frames"]:  # the fibres of that frame, not of the one in its place
            name = f"fibres/strap.{frame:04d}.vtp"
            self.assertEqual(self.lengths("again", name), self.lengths("whole", name), frame)
        with open(self.folder / "again" / "motion.csv", newline="") as file:
            self.assertEqual({int(row["frame"]) for row in csv.DictReader(file)}, {0, 5, 10, 12})
        # What was written is a run: read, written once more, the same.
        self.check_done("export", "again", "--as", "run", "--out", "third")
        for name in ("motion.csv", "frames/strap.0010.vtp"):
            self.assertEqual((self.folder / "third" / name).read_bytes(), (self.folder / "again" / name).read_bytes(), name)

    def lengths(self, run, name):
        """Numbers of the array length_mm, to 6 digits: the rest is bound to the surface anew."""
        text = (self.folder / run / name).read_text()
        begin = text.index(">", text.index('Name="length_mm"')) + 1
        return [f"{float(x):.6g}" for x in text[begin:text.index("<", begin)].split()]

    def test_a_frame_without_its_rows_is_told(self):
        self.simulate("a", "--every", "5")
        for table in ("motion.csv", "metrics.csv"):
            path = self.folder / "a" / table
            lines = path.read_text().splitlines(keepends=True)
            path.write_text("".join(line for line in lines if not line.startswith("5,")))
            self.check_error(1, [table, "frame 5"], "export", "a", "--as", "obj", "--out", "x")
            path.write_text("".join(lines))


if __name__ == "__main__":
    unittest.main()
