"""fascicle info and fascicle scenes."""
import unittest

import small_scene
from program import ProgramTest


class InfoTest(ProgramTest):
    def values(self, text):
        """label -> value of the lines of one file."""
        return {line[2:16].strip(): line[16:] for line in text.splitlines() if line.startswith("  ")}

    def test_a_box_in_millimetres_and_in_metres(self):
        for scale, unit in ((1, "mm"), (0.001, "m")):
            file = self.folder / f"box_{unit}.obj"
            vertices, triangles = small_scene.write_box(file, [0, 0, 0], [20 * scale, 30 * scale, 50 * scale],
                                                        (1, 2, 3))
            text = self.check_done("info", file)
            self.assertEqual(text.splitlines()[0], str(file))
            values = self.values(text)
            self.assertEqual(values["vertices"], str(vertices))
            self.assertEqual(values["triangles"], str(triangles))
            self.assertTrue(values["unit"].startswith(unit + " "), values["unit"])
            self.assertAlmostEqual(float(values["volume"].split()[0]), 30000 * scale ** 3, delta=1e-5 * scale ** 3)
            self.assertEqual(values["volume"].split()[1], unit + "3")
            self.assertAlmostEqual(float(values["area"].split()[0]), 6200 * scale ** 2, delta=1e-5 * scale ** 2)
            self.assertEqual(values["surface"], "closed")
            self.assertEqual(values["defects"], "none")

    def test_defects_are_told_and_are_no_error(self):
        file = self.folder / "open.obj"
        file.write_text("v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\nf 1 2 3\nf 1 4 2\nf 1 4 2\nf 1 3 3\n")
        text = self.check_done("info", file)
        self.assertIn("surface       open", text)
        self.assertIn("hole", text)
        self.assertIn("duplicate", text)
        self.assertIn("volume        none", text)

    def test_several_files_and_errors(self):
        small_scene.write_scene(self.folder)
        text = self.check_done("info", "strap.obj", "fixed.obj")
        self.assertEqual([line for line in text.splitlines() if not line.startswith(" ")],
                         ["strap.obj", "fixed.obj"])
        self.check_error(2, ["no mesh"], "info")
        self.check_error(1, ["nowhere.obj", "no such file"], "info", "nowhere.obj")
        (self.folder / "bad.vtk").write_bytes(b"# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 9 float\n1 2")
        self.check_error(1, ["bad.vtk"], "info", "bad.vtk")

    def test_scenes_are_listed_with_a_line_each(self):
        lines = self.check_done("scenes").splitlines()
        self.assertEqual([line.split()[0] for line in lines], ["hip", "squish-box", "cylinder", "two-heads"])
        self.assertTrue(all(len(line.split()) > 5 for line in lines))


if __name__ == "__main__":
    unittest.main()
