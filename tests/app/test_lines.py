"""fascicle lines: line muscles of an OpenSim model over a motion."""
import csv
import math
import unittest

from program import ProgramTest

MODEL = """<OpenSimDocument Version="40000"><Model name="pulley"><Ground name="ground"><WrapObjectSet><objects>
<WrapCylinder name="wheel"><radius>0.04</radius><length>1</length><quadrant>+y</quadrant></WrapCylinder></objects></WrapObjectSet>
</Ground><BodySet><objects><Body name="arm"/></objects></BodySet><JointSet><objects><PinJoint name="hinge">
<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/arm</socket_child_frame>
<coordinates><Coordinate name="angle"/></coordinates></PinJoint></objects></JointSet><ForceSet><objects>
<Thelen2003Muscle name="rope"><GeometryPath><PathPointSet><objects>
<PathPoint name="a"><socket_parent_frame>/ground</socket_parent_frame><location>0.3 0 0</location></PathPoint>
<PathPoint name="b"><socket_parent_frame>/bodyset/arm</socket_parent_frame><location>-0.3 0 0</location></PathPoint>
</objects></PathPointSet><PathWrapSet><objects><PathWrap name="w"><wrap_object>wheel</wrap_object></PathWrap></objects>
</PathWrapSet></GeometryPath></Thelen2003Muscle></objects></ForceSet></Model></OpenSimDocument>
"""
MOTION = "turn\nversion=1\nnRows=3\nnColumns=2\ninDegrees=yes\nendheader\ntime\tangle\n0\t0\n0.1\t10\n0.2\t20\n"


def write_wheel(file, sides=64):
    """A closed prism of the wheel's size, in millimetres, as OBJ."""
    lines = []
    for z in (-500, 500):
        for i in range(sides):
            a = 2 * math.pi * i / sides
            lines.append(f"v {40 * math.cos(a)} {40 * math.sin(a)} {z}")
    for i in range(sides):
        j = (i + 1) % sides
        lines.append(f"f {i + 1} {j + 1} {sides + j + 1} {sides + i + 1}")
    lines.append("f " + " ".join(str(i) for i in range(sides, 0, -1)))
    lines.append("f " + " ".join(str(sides + i) for i in range(1, sides + 1)))
    file.write_text("\n".join(lines) + "\n")


class LinesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "m.osim").write_text(MODEL)
        (self.folder / "m.mot").write_text(MOTION)

    def rows(self, folder):
        with open(self.folder / folder / "lines.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_rope_over_a_wheel(self):
        text = self.check_done("lines", "--osim", "m.osim", "--motion", "m.mot", "--out", "out", "--export", "vtp,csv")
        self.assertIn("pulley: 1 bodies, 1 coordinates, 1 muscles, 3 frames", text)
        rows = self.rows("out")
        self.assertEqual(list(rows[0]), ["frame", "muscle", "angle_deg", "length_mm", "moment_arm_mm"])
        self.assertEqual([row["frame"] for row in rows], ["0", "1", "2"])
        for row in rows:
            angle = math.radians(float(row["angle_deg"]))
            length = 2 * math.sqrt(300 ** 2 - 40 ** 2) + 40 * (math.pi + angle - 2 * math.acos(40 / 300))
            self.assertAlmostEqual(float(row["length_mm"]), length, places=6)
            self.assertAlmostEqual(float(row["moment_arm_mm"]), -40, places=6)
        self.assertTrue((self.folder / "out" / "frames" / "lines.0002.vtp").exists())
        self.assertEqual((self.folder / "out" / "lines.pvd").read_text().count("<DataSet"), 3)
        self.assertIn("polylines     1", self.check_done("info", "out/frames/lines.0000.vtp"))

    def test_the_same_as_a_string_over_a_mesh_for_any_number_of_threads(self):
        write_wheel(self.folder / "wheel.obj")
        for threads in (1, 3):
            self.assertEqual("", self.check_done("lines", "--osim", "m.osim", "--motion", "m.mot", "--out", f"out{threads}",
                                                 "--bone", "ground=wheel.obj", "--quiet", "--threads", threads))
        rows = self.rows("out1")
        self.assertEqual(list(rows[0])[-3:], ["string_length_mm", "string_moment_arm_mm", "string_clear"])
        for row in rows:
            self.assertEqual(row["string_clear"], "1")
            self.assertAlmostEqual(float(row["string_length_mm"]), float(row["length_mm"]), delta=1)
            self.assertAlmostEqual(float(row["string_moment_arm_mm"]), -40, delta=0.5)
        self.assertEqual((self.folder / "out1/lines.csv").read_bytes(), (self.folder / "out3/lines.csv").read_bytes())

    def test_without_a_coordinate_that_turns_there_are_lengths_alone(self):
        (self.folder / "still.mot").write_text(MOTION.replace("\t10\n", "\t0\n").replace("\t20\n", "\t0\n"))
        text = self.check_done("lines", "--osim", "m.osim", "--motion", "still.mot", "--out", "out")
        self.assertIn("--coordinate", text)
        self.assertEqual(list(self.rows("out")[0]), ["frame", "muscle", "length_mm"])
        self.check_done("lines", "--osim", "m.osim", "--motion", "still.mot", "--out", "out", "--coordinate", "angle")
        self.assertAlmostEqual(float(self.rows("out")[0]["moment_arm_mm"]), -40, places=6)

    def test_what_is_wrong_is_told_and_leaves_nothing(self):
        good = ("--osim", "m.osim", "--motion", "m.mot")
        self.check_error(2, ["no --osim"], "lines", "--motion", "m.mot", "--out", "out")
        self.check_error(2, ["no --out"], "lines", *good)
        self.check_error(2, ["'angel'", "did you mean 'angle'?"], "lines", *good, "--out", "out", "--coordinate", "angel")
        self.check_error(2, ["--bone", "BODY=MESH"], "lines", *good, "--out", "out", "--bone", "arm")
        self.check_error(2, ["there is no body 'leg'", "ground, arm"], "lines", *good, "--out", "out", "--bone", "leg=x.obj")
        self.check_error(1, ["x.obj", "no such file"], "lines", *good, "--out", "out", "--bone", "arm=x.obj")
        self.check_error(2, ["--export", "'png'"], "lines", *good, "--out", "out", "--export", "png")
        self.check_error(1, ["none.osim", "no such file"], "lines", "--osim", "none.osim", "--motion", "m.mot", "--out", "out")
        (self.folder / "bad.osim").write_text(MODEL.replace("</Ground>", ""))
        self.check_error(1, ["bad.osim, line"], "lines", "--osim", "bad.osim", "--motion", "m.mot", "--out", "out")
        (self.folder / "bad.mot").write_text(MOTION.replace("0.1\t10", "0.1\tten"))
        self.check_error(1, ["bad.mot, line 9", "'ten'"], "lines", "--osim", "m.osim", "--motion", "bad.mot", "--out", "out")
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
