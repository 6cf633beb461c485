"""--lines: line muscles of an OpenSim model beside the simulated ones."""
import csv
import json
import math
import unittest

import small_scene
from program import ProgramTest

# The strap's middle line, from 45 mm above the middle (fixed) to 45 mm below it (turning), 8 mm behind the hinge's plane.
MODEL = """<?xml version="1.0"?>
<OpenSimDocument Version="40000"><Model name="strap"><Ground name="ground"/>
<BodySet name="bodyset"><objects><Body name="turning_r"/></objects></BodySet>
<JointSet name="jointset"><objects><PinJoint name="j"><socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>/bodyset/turning_r</socket_child_frame><coordinates><Coordinate name="q"/></coordinates></PinJoint></objects></JointSet>
<ForceSet><objects><Thelen2003Muscle name="line"><GeometryPath name="path"><PathPointSet><objects>
<PathPoint name="a"><socket_parent_frame>/ground</socket_parent_frame><location>0 0.008 0.045</location></PathPoint>
<PathPoint name="b"><socket_parent_frame>/bodyset/turning_r</socket_parent_frame><location>0 0.008 -0.045</location></PathPoint>
</objects></PathPointSet></GeometryPath></Thelen2003Muscle></objects></ForceSet></Model></OpenSimDocument>
"""


class SceneLinesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.source, _ = small_scene.write_scene(self.folder / "input")
        self.model = self.folder / "input" / "model of a strap.osim"
        self.model.write_text(MODEL)
        self.out = self.folder / "out"

    def rows(self, name):
        with open(self.out / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_a_run_leaves_lengths_and_moment_arms(self):
        text = self.check_done("simulate", *self.source, "--lines", self.model, "--threads", "1", "--out", self.out)
        self.assertIn("body turning_r goes with bone turning, by name", text)
        self.assertIn("body ground goes with bone fixed, the nearest", text)
        rows, metrics = self.rows("lines.csv"), self.rows("metrics.csv")
        self.assertEqual(list(rows[0]), ["frame", "muscle", "angle_deg", "length_mm", "moment_arm_mm"])
        self.assertEqual([row["frame"] for row in rows], [str(k) for k in range(13)])
        for row, other in zip(rows, metrics):
            self.assertEqual((row["muscle"], row["angle_deg"]), ("line", other["angle_deg"]))
            # The hinge is (0, 0, -40) about x: the end lies at (8, -5) from it in y, z, the other one at (8, 85).
            angle = math.radians(float(row["angle_deg"]))
            y = 8 * math.cos(angle) + 5 * math.sin(angle)
            z = 8 * math.sin(angle) - 5 * math.cos(angle)
            length = math.hypot(8 - y, 85 - z)
            self.assertAlmostEqual(float(row["length_mm"]), length, places=9)
            # Pull from the end towards the other point: torque about x, positive flexion is positive angle here.
            arm = (y * (85 - z) - z * (8 - y)) / length
            self.assertAlmostEqual(float(row["moment_arm_mm"]), arm, places=9)
        self.assertGreater(float(rows[0]["moment_arm_mm"]), 7)
        inputs = json.loads((self.out / "summary.json").read_text())["inputs"]
        self.assertIn(str(self.model), [entry["path"] for entry in inputs])
        # A run without the option leaves none of an earlier one.
        self.check_done("simulate", *self.source, "--threads", "1", "--quiet", "--out", self.out)
        self.assertFalse((self.out / "lines.csv").exists())

    def test_lines_change_nothing_of_the_muscles(self):
        states = []
        for more in ([], ["--lines", self.model]):
            self.check_done("simulate", *self.source, *more, "--threads", "1", "--quiet", "--out", self.out)
            states.append(json.loads((self.out / "summary.json").read_text())["state_hash"])
        self.assertEqual(states[0], states[1])

    def test_what_is_wrong_is_told(self):
        def fails(code, words, *arguments):
            self.check_error(code, words, *arguments, "--out", self.out)

        simulate = ["simulate", *self.source]
        fails(1, ["absent.osim"], *simulate, "--lines", self.folder / "absent.osim")
        self.model.write_text(MODEL.replace("0.045", "0.445"))
        fails(1, ["model of a strap.osim", "mm from the bones"], *simulate, "--lines", self.model)
        self.model.write_text("<xml/>")
        fails(1, ["model of a strap.osim"], *simulate, "--lines", self.model)
        fails(2, ["--lines", "fascicle simulate"], "fibres", *self.source, "--lines", self.model)


if __name__ == "__main__":
    unittest.main()
