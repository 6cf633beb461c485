"""fascicle repair: files in and out, the table, the report, refusals."""
import json
import re
import unittest

import small_scene
from program import ProgramTest


class RepairTest(ProgramTest):
    def write_obj(self, name, vertices, triangles):
        lines = ["v %s %s %s" % tuple(v) for v in vertices] + ["f %d %d %d" % tuple(i + 1 for i in t) for t in triangles]
        (self.folder / name).write_text("\n".join(lines) + "\n")
        return name

    def box(self, low, size):
        """Vertices and triangles of a box, each triangle with vertices of its own."""
        small_scene.write_box(self.folder / "box_tmp.obj", low, size, (2, 2, 2))
        vertices, triangles = [], []
        for line in (self.folder / "box_tmp.obj").read_text().splitlines():
            words = line.split()
            if words[0] == "v":
                vertices.append([float(w) for w in words[1:]])
            elif words[0] == "f":
                triangles.append([int(w) - 1 for w in words[1:]])
        return vertices, triangles

    def test_a_soup_with_a_hole_becomes_a_solid(self):
        vertices, triangles = self.box([0, 0, 0], [20, 30, 50])
        soup = [vertices[i] for t in triangles for i in t]
        name = self.write_obj("soup.obj", soup, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(triangles) - 1)])
        before = (self.folder / name).read_bytes()
        text = self.check_done("repair", name, "solid.vtk", "--report", "solid.json")
        self.assertIn("hole filled", text)
        self.assertIn("closed, manifold, consistently oriented; written to solid.vtk", text)
        self.assertEqual((self.folder / name).read_bytes(), before)
        info = self.check_done("info", "solid.vtk")
        self.assertIn("defects       none", info)
        self.assertIn("volume        30000 mm3", info)
        report = json.loads((self.folder / "solid.json").read_text())
        self.assertTrue(report["good"])
        self.assertIsNone(report["before"]["volume"])
        self.assertAlmostEqual(report["after"]["volume"], 30000, places=3)
        self.assertEqual(report["after"]["boundary_edges"], 0)
        self.assertEqual({step["key"] for step in report["steps"]}, {"unused", "weld", "holes"})
        again = self.check_done("repair", "solid.vtk", "again.vtk", "--quiet")
        self.assertEqual(again, "")
        self.assertEqual((self.folder / "solid.vtk").read_bytes(), (self.folder / "again.vtk").read_bytes())

    def test_remeshing_keeps_the_volume_and_arrays_follow(self):
        vertices, triangles = self.box([0, 0, 0], [20, 30, 50])
        points = " ".join("%g %g %g" % tuple(v) for v in vertices)
        cells = " ".join("3 %d %d %d" % tuple(t) for t in triangles)
        (self.folder / "in.vtk").write_text(
            "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS %d float\n%s\nPOLYGONS %d %d\n%s\n"
            "POINT_DATA %d\nSCALARS height float 1\nLOOKUP_TABLE default\n%s\n"
            % (len(vertices), points, len(triangles), 4 * len(triangles), cells, len(vertices),
               " ".join("%g" % (v[2] + 0.5) for v in vertices)))
        text = self.check_done("repair", "in.vtk", "out.vtp", "--edge", "4", "--smooth", "1")
        self.assertIn("1 array per point carried over", text)
        info = self.check_done("info", "out.vtp")
        self.assertIn("surface       closed", info)
        bytes_out = (self.folder / "out.vtp").read_text()
        self.assertIn('Name="height"', bytes_out)
        heights = [float(w) for w in re.search(r'Name="height"[^>]*>([^<]*)<', bytes_out).group(1).split()]
        self.assertGreaterEqual(min(heights), 0.4999)
        self.assertLessEqual(max(heights), 50.5001)
        self.assertGreater(len(set(heights)), 20)

    def test_what_cannot_be_repaired_is_one_line_and_no_file(self):
        name = self.write_obj("sheet.obj", [(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)], [(0, 1, 2), (0, 2, 3)])
        self.check_error(1, ["sheet.obj", "cannot be repaired", "1 hole"], "repair", name, "out.obj", "--report", "r.json")
        self.assertFalse((self.folder / "out.obj").exists())
        self.assertFalse(json.loads((self.folder / "r.json").read_text())["good"])
        self.check_error(1, ["no surface is left"], "repair", name, "out.obj", "--fill", "10")
        self.check_error(1, ["nowhere.obj"], "repair", "nowhere.obj", "out.obj")

    def test_the_input_is_never_written_over(self):
        vertices, triangles = self.box([0, 0, 0], [20, 30, 50])
        name = self.write_obj("box.obj", vertices, triangles)
        (self.folder / "link.obj").symlink_to(self.folder / name)
        before = (self.folder / name).read_bytes()
        for out in (name, "./box.obj", "link.obj"):
            self.check_error(2, ["never changed"], "repair", name, out)
        self.check_error(2, ["--report"], "repair", name, "out.obj", "--report", name)
        self.assertEqual((self.folder / name).read_bytes(), before)

    def test_wrong_command_lines(self):
        vertices, triangles = self.box([0, 0, 0], [20, 30, 50])
        name = self.write_obj("box.obj", vertices, triangles)
        self.check_error(2, ["two files"], "repair", name)
        self.check_error(2, ["out.xyz"], "repair", name, "out.xyz")
        self.check_error(2, ["--islands"], "repair", name, "out.obj", "--islands", "2")
        self.check_error(2, ["--edge"], "repair", name, "out.obj", "--edge", "3", "--triangles", "100")
        self.check_error(2, ["--weld"], "repair", name, "out.obj", "--weld", "-1")
        self.check_error(2, ["--fill"], "repair", name, "out.obj", "--fill", "100000")
        self.check_error(1, ["box.obj", "20 million"], "repair", name, "out.obj", "--edge", "0.0001")


if __name__ == "__main__":
    unittest.main()
