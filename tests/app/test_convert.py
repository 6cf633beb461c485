"""fascicle convert, and fascicle info of every format."""
import os
import struct
import unittest

import small_scene
from program import ProgramTest, file_hashes

FORMATS = ("vtk", "vtp", "ply", "stl", "off", "obj", "glb", "usda")
FLOATS = {"stl", "glb", "usda"}


class ConvertTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.vertices, self.triangles = small_scene.write_box(self.folder / "box.obj", [0.1, 0, 0], [20, 30, 50], (2, 3, 4))

    def values(self, *arguments):
        text = self.check_done("info", *arguments)
        return {line[2:16].strip(): line[16:] for line in text.splitlines() if line.startswith("  ")}

    def test_every_format_to_every_other_and_back(self):
        normal = self.normal()
        for a in FORMATS:
            self.check_done("convert", "box.obj", f"a.{a}")
            for b in FORMATS:
                self.check_done("convert", f"a.{a}", f"b.{b}")
                # Where no format on the way keeps floats alone, nothing changes, to the last bit.
                if not FLOATS & {a, b}:
                    self.check_done("convert", f"b.{b}", "c.obj")
                    self.assertEqual((self.folder / "c.obj").read_bytes().strip(), normal)
            text = self.check_done("info", *(f"b.{b}" for b in FORMATS))
            for line in (f"  vertices      {self.vertices}", f"  triangles     {self.triangles}", "  surface       closed",
                         "  defects       none"):
                self.assertEqual(text.splitlines().count(line), len(FORMATS), f"{a}: {line}\n{text}")
            # What says metres is carried on as that, though the size tells otherwise.
            said = {"glb", "usda"} if a not in ("glb", "usda") else set(FORMATS)
            self.assertEqual(text.count("unit          m (as the file says, though the size fits mm)"), len(said), text)
            self.assertEqual(text.count("unit          mm (guessed from the size)"), len(FORMATS) - len(said), text)

    def normal(self):
        self.check_done("convert", "box.obj", "normal.obj")
        return (self.folder / "normal.obj").read_bytes().strip()

    def test_what_is_lost_is_said(self):
        (self.folder / "rich.ply").write_text(
            "ply\nformat ascii 1.0\ncomment SPACE=LPS\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\nelement face 1\n"
            "property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
            "end_header\n0 0 0 1 2 3 0.5\n100 0 0 1 2 3 0.5\n0 100.1 0 1 2 3 0.5\n3 0 1 2\n0 2\n")
        text = self.check_done("convert", "rich.ply", "a.stl")
        for words in ("a.stl: PLY to STL, 3 vertices, 1 triangle", "dropped: 1 line", "dropped: arrays of points", "RGB, quality",
                      "rounded to float"):
            self.assertIn(words, text)
        text = self.check_done("convert", "rich.ply", "a.vtp")
        self.assertNotIn("dropped", text)
        values = self.values("a.vtp")
        self.assertEqual(values["point arrays"], "RGB (3), quality")
        self.assertEqual(values["polylines"], "1")
        self.assertIn("LPS", self.values("rich.ply")["file's frame"])

    def test_names_of_arrays_steer_no_terminal(self):
        lines = ["# vtk DataFile Version 3.0", "x", "ASCII", "DATASET POLYDATA", "POINTS 3 float", "0 0 0", "1 0 0", "0 1 0",
                 "POLYGONS 1 4", "3 0 1 2", "POINT_DATA 3", "SCALARS a\x1b[2Jb float 1", "LOOKUP_TABLE default", "1", "2", "3"]
        (self.folder / "a.vtk").write_text("\n".join(lines) + "\n")
        (self.folder / "b.vtk").write_bytes("\n".join(lines).replace("a\x1b[2Jb", "caf\xe9").encode("latin-1") + b"\n")
        for source in ("a.vtk", "b.vtk"):
            for target in ("a.vtp", "a.ply", "a.obj", "b.vtk", "a.stl"):
                if source == target:
                    continue
                result = self.run_program("convert", source, target, encoding="latin-1")
                self.assertEqual(result.returncode, 0, result.stderr)
                for text in (result.stdout, result.stderr):
                    self.assertFalse([c for c in text if c < " " and c != "\n"], repr(text))
                self.assertIn("a [2Jb" if source == "a.vtk" else "caf", result.stdout)
            if source == "a.vtk":
                (self.folder / "b.vtk").write_bytes("\n".join(lines).replace("a\x1b[2Jb", "caf\xe9").encode("latin-1") + b"\n")
        self.assertEqual(self.run_program("convert", "b.vtk", "c.vtp", encoding="latin-1").returncode, 0)
        self.assertIn("caf\ufffd", (self.folder / "c.vtp").read_bytes().decode("utf-8"))

    def test_units_only_when_asked(self):
        self.assertEqual(self.values("box.obj")["box"], "0.1 0 0 to 20 30 50")
        self.check_done("convert", "box.obj", "a.ply")
        self.assertEqual(self.values("a.ply")["box"], "0.1 0 0 to 20 30 50")
        text = self.check_done("convert", "a.ply", "m.ply", "--units", "m")
        self.assertIn("scaled by 0.001 to m (mm, guessed from the size)", text)
        self.assertEqual(self.values("m.ply")["box"], "0.0001 0 0 to 0.02 0.03 0.05")
        self.check_done("convert", "m.ply", "mm.off", "--units", "mm")
        self.assertEqual(self.values("mm.off")["box"], "0.1 0 0 to 20 30 50")
        self.check_done("convert", "box.obj", "half.vtk", "--scale", "0.5")
        self.assertEqual(self.values("half.vtk")["box"], "0.05 0 0 to 10 15 25")
        # What the file says goes before the guess.
        (self.folder / "said.obj").write_text("# 1 unit = 10.000000 mm\n" + (self.folder / "box.obj").read_text())
        text = self.check_done("convert", "said.obj", "a.obj", "--units", "mm")
        self.assertIn("scaled by 10 to mm (1 unit = 10 mm, as the file says)", text)
        self.assertEqual(self.values("said.obj")["file's unit"], "1 unit = 10 mm")

    def test_formats_that_are_in_metres_say_so(self):
        for suffix in ("glb", "usda"):
            self.assertIn("--units m scales it", self.check_done("convert", "box.obj", f"mm.{suffix}"))
            self.assertNotIn("--units", self.check_done("convert", "box.obj", f"m.{suffix}", "--units", "m"))
            self.assertEqual(self.values(f"m.{suffix}")["file's unit"], "1 unit = 1000 mm")

    def test_the_input_is_never_overwritten(self):
        (self.folder / "link.obj").symlink_to("box.obj")
        os.link(self.folder / "box.obj", self.folder / "hard.obj")
        (self.folder / "sub").symlink_to(".")
        before = file_hashes(self.folder)
        for out in ("box.obj", "./box.obj", "link.obj", "hard.obj", "sub/box.obj", self.folder / "box.obj"):
            self.check_error(2, ["the output is the input"], "convert", "box.obj", out)
            self.check_error(2, ["the output is the input"], "convert", "link.obj", out)
        self.assertEqual(file_hashes(self.folder), before)

    def test_mistakes(self):
        (self.folder / "bad.stl").write_bytes(b"x" * 80 + struct.pack("<I", 10**9) + b"y" * 100)
        before = file_hashes(self.folder)
        self.check_error(2, ["needs an input and an output"], "convert", "box.obj")
        self.check_error(2, ["'.xyz'", ".ply"], "convert", "box.obj", "a.xyz")
        self.check_error(2, ["--scale", "above 0"], "convert", "box.obj", "a.ply", "--scale", "-1")
        self.check_error(2, ["--scale", "'big'"], "convert", "box.obj", "a.ply", "--scale", "big")
        self.check_error(2, ["--units", "'inch'"], "convert", "box.obj", "a.ply", "--units", "inch")
        self.check_error(2, ["two ways"], "convert", "box.obj", "a.ply", "--units", "m", "--scale", "2")
        self.check_error(2, ["cannot be written as a table"], "convert", "box.obj", "a.csv")
        self.check_error(1, ["nowhere.obj", "no such file"], "convert", "nowhere.obj", "a.ply")
        self.check_error(1, ["bad.stl, byte 80", "1000000000"], "convert", "bad.stl", "a.ply")
        self.check_error(1, ["not finite after scaling"], "convert", "box.obj", "a.ply", "--scale", "1e308")
        self.check_error(1, ["a.stl", "that a float can hold"], "convert", "box.obj", "a.stl", "--scale", "1e40")
        self.assertEqual(file_hashes(self.folder), before)

    def test_outlines_become_lines_and_motions_tables(self):
        (self.folder / "outlines.csv").write_text(
            "attachment,bone,x_cm,y_cm,z_cm\norigin,pelvis,1,0,0\norigin,pelvis,0,1,0\norigin,pelvis,0,0,1\n"
            "insertion,femur,1,1,0\ninsertion,femur,0,1,1\n")
        text = self.check_done("convert", "outlines.csv", "outlines.vtp")
        self.assertIn("pelvis, femur", text)
        values = self.values("outlines.vtp")
        self.assertEqual(values["polylines"], "2")
        self.assertEqual(values["line arrays"], "attachment, outline")
        self.assertTrue(values["box"].endswith("to 10 10 10"))
        (self.folder / "walk.mot").write_text(
            "walk\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\ntime\thip_flexion_r\tknee_angle_r\n0\t0.5\t-1e-3\n0.1\t1.25\t2\n")
        self.check_done("convert", "walk.mot", "walk.csv")
        self.assertEqual((self.folder / "walk.csv").read_text(),
                         "time,hip_flexion_r,knee_angle_r\n0,0.5,-0.001\n0.1,1.25,2\n")
        self.check_done("convert", "walk.mot", "walk.sto")
        self.check_done("convert", "walk.sto", "again.csv")
        self.assertEqual((self.folder / "again.csv").read_bytes(), (self.folder / "walk.csv").read_bytes())
        self.assertIn("inDegrees=yes", (self.folder / "walk.sto").read_text())
        self.check_error(2, ["for meshes"], "convert", "walk.mot", "w.csv", "--units", "m")


if __name__ == "__main__":
    unittest.main()
