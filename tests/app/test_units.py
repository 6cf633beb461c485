"""Units and axes of files: guessed, shown, never silently applied. Series, conversions, and what info tells of them."""
import json
import struct
import unittest

import small_scene
from program import ProgramTest


class UnitsTest(ProgramTest):
    def values(self, *arguments):
        text = self.check_done("info", *arguments)
        return {line[2:16].strip(): line[16:] for line in text.splitlines() if line.startswith("  ")}

    def series(self, said=""):
        """A ParaView series of two frames of a box in millimetres, as another program writes it: without a unit."""
        small_scene.write_box(self.folder / "box.obj", (0, 0, 0), (20, 30, 50), (1, 1, 1))
        self.check_done("convert", "box.obj", "plain_0.vtp")
        self.check_done("convert", "box.obj", "plain_1.vtp")
        (self.folder / "plain.pvd").write_text(
            '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="plain_0.vtp"/>'
            '<DataSet timestep="1" file="plain_1.vtp"/></Collection></VTKFile>')

    def extent(self, glb):
        """Largest coordinate of a .glb, in metres."""
        data = (self.folder / glb).read_bytes()
        length, = struct.unpack_from("<I", data, 12)
        document = json.loads(data[20:20 + length])
        return max(max(a["max"]) for a in document["accessors"] if "max" in a and len(a["max"]) == 3)

    def test_a_series_without_a_unit_is_guessed_with_a_note(self):
        self.series()
        result = self.run_program("export", "plain.pvd", "--out", "a.glb", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("unit guessed: millimetres", result.stderr)
        self.assertAlmostEqual(self.extent("a.glb"), 0.05, delta=1e-6)
        result = self.run_program("export", "plain.pvd", "--out", "b.glb", "--units", "m")
        self.assertEqual(result.stderr, "")
        self.assertAlmostEqual(self.extent("b.glb"), 50, delta=1e-3)
        self.run_program("export", "plain.pvd", "--out", "a.usda")
        self.assertIn("metersPerUnit = 0.001", (self.folder / "a.usda").read_text())
        self.assertEqual(self.run_program("export", "plain.pvd", "--as", "obj", "--out", "objs").stderr, "")
        text = (self.folder / "objs" / "plain_0000.obj").read_text()
        self.assertNotIn("1 unit", text)  # what is not known is not claimed
        # A series of OBJ files without a unit, too.
        result = self.run_program("export", "objs/plain_0000.obj", "--out", "c.glb")
        self.assertIn("unit guessed: millimetres", result.stderr)
        self.assertAlmostEqual(self.extent("c.glb"), 0.05, delta=1e-6)

    def test_a_run_says_its_unit_in_its_files(self):
        source, _ = small_scene.write_scene(self.folder)
        self.check_done("simulate", *source, "--export", "vtp,meshes", "--out", "run", "--quiet")
        for series in ("run/strap.pvd", "run/meshes/strap.pvd"):
            result = self.run_program("export", series, "--out", "a.glb")
            self.assertEqual((result.returncode, result.stderr), (0, ""), series)
            self.assertAlmostEqual(self.extent("a.glb"), 0.04, delta=0.002)
        frame = sorted((self.folder / "run/frames").glob("*.vtp"))[0]
        self.assertEqual(self.values(frame)["unit"], "mm (as the file says)")
        result = self.run_program("export", "run/strap.pvd", "--out", "b.glb", "--units", "m")
        self.assertIn("says millimetres; --units m counts", result.stderr)
        self.check_error(2, ["--units", "a run says"], "export", "run", "--out", "c.glb", "--units", "m")

    def test_metres_and_millimetres_do_not_mix_silently(self):
        source, _ = small_scene.write_scene(self.folder)
        source = source[:-2]  # without --units
        self.check_done("convert", "strap.obj", "m.obj", "--units", "m")
        said = (self.folder / "m.obj").read_text()
        self.assertTrue(said.startswith("# 1 unit = 1000 mm\n"))
        (self.folder / "strap.obj").write_text(said)
        text = self.check_done("simulate", *source, "--out", "run")
        self.assertIn("strap.obj: says metres, taken times 1000 to the scene's millimetres", text)
        volume = json.loads((self.folder / "run/summary.json").read_text())
        self.assertIn("unit guessed: millimetres", str(volume["notes"]))
        (self.folder / "strap.obj").write_text("\n".join(said.splitlines()[1:]))
        self.check_error(1, ["strap.obj", "fixed.obj", "convert IN OUT --units mm"], "simulate", *source, "--out", "run")

    def test_frames_are_noted(self):
        source, _ = small_scene.write_scene(self.folder)
        for name, space in (("strap", "RAS"), ("fixed", "LPS")):
            file = self.folder / f"{name}.obj"
            file.write_text(f"# SPACE={space}\n" + file.read_text())
        text = self.check_done("simulate", *source, "--out", "run")
        self.assertIn("frames differ: RAS in strap.obj, LPS in fixed.obj", text)

    def test_axes_there_and_back_and_one_body(self):
        small_scene.write_box(self.folder / "box.obj", (1, 2, 3), (20, 30, 50), (1, 1, 1))
        text = self.check_done("convert", "box.obj", "box.glb", "--units", "m", "--axes", "lps_to_y_up")
        self.assertIn("turned: LPS to Y up", text)
        self.assertNotIn("nothing was turned", text)
        self.assertIn("nothing was turned", self.check_done("convert", "box.obj", "flat.glb", "--units", "m"))
        self.assertEqual(self.values("box.glb")["box"], "0.001 0.003 -0.03 to 0.02 0.05 -0.002")
        self.check_done("convert", "box.glb", "back.ply", "--units", "mm", "--axes", "y_up_to_lps")
        values = self.values("back.ply")
        self.assertEqual(values["unit"], "mm (as the file says)")
        self.assertTrue(values["file's frame"].startswith("LPS"))
        self.assertEqual(values["size"].split(",")[0], "19 28 47")
        self.assertGreater(float(values["volume"].split()[0]), 0)
        self.check_error(2, ["--axes", "y_up_to_lps"], "convert", "box.obj", "a.ply", "--axes", "y_up_to_lsp")
        (self.folder / "two.obj").write_text(
            "o left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no right\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 4 5 6\n")
        self.assertIn("left, right; --body NAME takes one", self.check_done("convert", "two.obj", "all.ply"))
        self.check_done("convert", "two.obj", "right.ply", "--body", "right")
        self.assertEqual(self.values("right.ply")["box"], "5 0 0 to 6 1 0")
        self.check_error(2, ["no body 'rihgt'", "did you mean 'right'", "left, right"], "convert", "two.obj", "x.ply",
                         "--body", "rihgt")
        self.check_error(2, ["holds one mesh"], "convert", "right.ply", "x.ply", "--body", "right")

    def test_what_files_say_is_carried_or_said_to_be_dropped(self):
        small_scene.write_box(self.folder / "box.obj", (1, 2, 3), (20, 30, 50), (1, 1, 1))
        file = self.folder / "said.obj"
        file.write_text("# SPACE=RAS\n# 1 unit = 10 mm\n" + (self.folder / "box.obj").read_text())
        before = "said.obj"
        for suffix in ("stl", "ply", "off", "vtk", "vtp", "obj"):
            self.check_done("convert", before, f"a.{suffix}")
            values = self.values(f"a.{suffix}")
            self.assertTrue(values["file's frame"].startswith("RAS"), suffix)
            self.assertEqual(values["file's unit"], "1 unit = 10 mm", suffix)
            self.assertEqual(values["unit"], "cm (as the file says)", suffix)
            before = f"a.{suffix}"
        self.check_done("repair", "said.obj", "mended.vtp")
        self.assertTrue(self.values("mended.vtp")["file's frame"].startswith("RAS"))
        self.assertIn("dropped: SPACE=RAS, which glTF", self.check_done("convert", "said.obj", "a.glb"))
        text = self.check_done("convert", "said.obj", "lps.ply", "--axes", "ras_to_lps", "--scale", "10")
        self.assertIn("turned: RAS to LPS", text)
        self.assertTrue(self.values("lps.ply")["file's frame"].startswith("LPS"))
        self.assertEqual(self.values("lps.ply")["file's unit"], "1 unit = 1 mm")

    def test_info_of_frames_and_of_sizes_beyond_measure(self):
        source, _ = small_scene.write_scene(self.folder)
        self.check_done("simulate", *source, "--export", "glb,obj,pc2,mdd", "--out", "run", "--quiet")
        frames = "13"
        glb = next((self.folder / "run").glob("*.glb"))
        values = self.values(glb)
        self.assertEqual(values["unit"], "m (as the file says)")
        self.assertTrue(values["frames"].startswith(frames + ", 0 to "), values["frames"])
        self.assertEqual(values["bodies"], "3: strap, fixed, turning")
        obj = sorted((self.folder / "run/obj").glob("*.obj"))[0]
        self.assertTrue(self.values(obj)["series"].startswith(frames + " files"))
        for key in ("pc2", "mdd"):
            values = self.values(f"run/{key}/strap.{key}")
            self.assertEqual(values["frames"].split(",")[0], frames)
            self.assertEqual(values["unit"], "mm (as the file says)")
            self.assertIn("s", values["time"])
            self.assertEqual(values["mesh"], "strap.obj")
            (self.folder / f"alone.{key}").write_bytes((self.folder / f"run/{key}/strap.{key}").read_bytes())
            self.assertIn("none", self.values(f"alone.{key}")["mesh"])
        (self.folder / "huge.obj").write_text("v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nv 0 0 1e200\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        text = self.check_done("info", "huge.obj")
        self.assertNotIn("nan", text)
        self.assertNotIn("inf", text)
        self.assertIn("none, the coordinates are too large", text)


if __name__ == "__main__":
    unittest.main()
