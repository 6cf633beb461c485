"""fascicle simulate --motion: keyed poses from a table, and notes about bones that overlap."""
import csv
import json
import math
import unittest

import small_scene
from program import ProgramTest

TURNS = "frame,bone,cx,cy,cz,ax,ay,az,angle_deg\n"


class MotionTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.hinge_source, _ = small_scene.write_scene(self.folder / "input")
        self.source = self.without("--hinge", "--angle-deg", "--phases")
        self.motion = self.folder / "motion of a joint.csv"

    def without(self, *names):
        pairs = zip(self.hinge_source[::2], self.hinge_source[1::2])
        return [word for pair in pairs if pair[0] not in names for word in pair]

    def simulate(self, out, *arguments):
        return self.check_done("simulate", *arguments, "--threads", "1", "--out", self.folder / out)

    def summary(self, out):
        return json.loads((self.folder / out / "summary.json").read_text())

    def rows(self, out, name):
        with open(self.folder / out / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_the_motion_of_a_run_fed_back_gives_the_same_run(self):
        self.simulate("first", *self.hinge_source)
        text = self.simulate("again", *self.source, "--motion", self.folder / "first" / "motion.csv")
        self.assertIn("note: motion.csv: moves turning, 12 frames", text)
        self.assertEqual((self.folder / "again" / "motion.csv").read_bytes(),
                         (self.folder / "first" / "motion.csv").read_bytes())
        first, again = self.summary("first"), self.summary("again")
        self.assertEqual(again["state_hash"], first["state_hash"])
        self.assertEqual(again["frames"], 12)
        self.assertIn(str(self.folder / "first" / "motion.csv"), [entry["path"] for entry in again["inputs"]])
        self.assertEqual({row["angle_deg"] for row in self.rows("again", "metrics.csv")}, {"0"})
        self.assertGreater(sum(again["stage_seconds"].values()), 0)
        self.assertTrue(any(name.startswith("contact") for name in again["stage_seconds"]), again["stage_seconds"])

    def test_one_joint_has_an_angle(self):
        self.motion.write_text(TURNS + "6,turning,0,0,-40,1,0,0,20\n10,turning,0,0,-40,2,0,0,0\n12,turning,0,0,-40,1,0,0,0\n")
        self.simulate("joint", *self.source, "--motion", self.motion)
        self.simulate("hinge", *self.hinge_source)
        for a, b in zip(self.rows("joint", "metrics.csv"), self.rows("hinge", "metrics.csv")):
            self.assertAlmostEqual(float(a["angle_deg"]), float(b["angle_deg"]), places=9)
        for a, b in zip(self.rows("joint", "motion.csv"), self.rows("hinge", "motion.csv")):
            self.assertEqual((a["frame"], a["bone"]), (b["frame"], b["bone"]))
            for key in a:
                if key.startswith("m"):
                    self.assertAlmostEqual(float(a[key]), float(b[key]), places=9)
        self.assertEqual(self.summary("joint")["hinge"], self.summary("hinge")["hinge"])

    def test_several_joints_and_bones_however_they_were_named(self):
        rows = [f"{k},turning,0,0,-40,1,0,0,{8 * (1 - math.cos(k))}\n{k},turning,0,0,-40,0,1,0,{8 * math.sin(k)}\n"
                for k in range(1, 7)]
        self.motion.write_text(TURNS + "".join(rows) + "3,fixed,0,0,40,0,0,1,5\n6,fixed,0,0,40,0,0,1,0\n")
        text = self.simulate("out", *self.source, "--motion", self.motion)
        self.assertIn("moves fixed, turning, 6 frames", text)
        self.assertEqual(self.summary("out")["frames"], 6)
        self.assertNotIn("hinge", self.summary("out"))
        poses = {(row["frame"], row["bone"]): row for row in self.rows("out", "motion.csv")}
        self.assertAlmostEqual(float(poses["3", "fixed"]["m00"]), math.cos(math.radians(5)), places=12)
        flexion, abduction = math.radians(8 * (1 - math.cos(3))), math.radians(8 * math.sin(3))
        self.assertAlmostEqual(float(poses["3", "turning"]["m11"]), math.cos(flexion), places=12)
        self.assertAlmostEqual(float(poses["3", "turning"]["m01"]), math.sin(abduction) * math.sin(flexion), places=12)
        self.assertEqual(float(poses["6", "fixed"]["m00"]), 1.0)

    def test_what_is_wrong_is_told_with_file_and_line(self):
        def fails(code, words, *arguments):
            self.check_error(code, words, "simulate", *arguments, "--out", self.folder / "out")

        fails(1, ["nowhere.csv", "no such file"], *self.source, "--motion", "nowhere.csv")
        self.motion.write_text(TURNS + "5,turning,0,0,0,1,0,0,10\n6,turing,0,0,0,1,0,0,10\n")
        fails(1, ["motion of a joint.csv, line 3", "'turing'", "did you mean 'turning'?"], *self.source, "--motion", self.motion)
        self.motion.write_text(TURNS + "5,turning,0,0,0,1,0,0,ten\n")
        fails(1, ["motion of a joint.csv, line 2", "'ten' in column 'angle_deg'", "a number"], *self.source, "--motion",
              self.motion)
        for option, value in (("--angle-deg", "20"), ("--hinge", "0,0,0;1,0,0"), ("--phases", "1,1,1")):
            fails(2, [option, "cannot go with --motion"], *self.source, "--motion", self.motion, option, value)
        fails(2, ["--motion", "2 times"], *self.source, "--motion", self.motion, "--motion", self.motion)

    def test_the_motion_is_not_replaced_by_that_of_the_run(self):
        self.simulate("run", *self.hinge_source)
        file = self.folder / "run" / "motion.csv"
        before = file.read_bytes()
        self.check_error(2, ["would replace the input", "motion.csv"], "simulate", *self.source, "--motion", file, "--out",
                         self.folder / "run")
        self.assertEqual(file.read_bytes(), before)

    def test_bones_that_overlap_are_a_note(self):
        small_scene.write_box(self.folder / "inner.obj", (-5, -5, 55), (5, 5, 59.5), (2, 2, 2))
        text = self.simulate("out", *self.hinge_source, "--bone", self.folder / "inner.obj")
        self.assertIn("note: fixed and inner overlap by 5.00 mm at rest: where bones overlap", text)
        self.assertNotIn("overlap", self.simulate("out2", *self.hinge_source))


if __name__ == "__main__":
    unittest.main()
