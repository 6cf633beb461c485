"""fascicle render and --export png: pictures without a display."""
import os
import struct
import unittest

import small_scene
from program import ProgramTest


def png_size(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[12:16] == b"IHDR", path
    return struct.unpack(">II", data[16:24])


class RenderTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.source, _ = small_scene.write_scene(self.folder / "input")
        self.no_display = {key: value for key, value in os.environ.items()
                           if key not in ("DISPLAY", "WAYLAND_DISPLAY")}

    def render(self, name, *arguments):
        out = self.folder / name
        self.check_done("render", *arguments, "--quiet", "--out", out, env=self.no_display)
        return out

    def simulate(self, *options):
        out = self.folder / "run"
        self.check_done("simulate", *self.source, *options, "--quiet", "--out", out, env=self.no_display)
        return out

    def test_a_run_and_its_source_give_the_same_picture(self):
        run = self.simulate("--export", "vtp")
        size = ("--frame", "6", "--size", "320x200", "--view", "right")
        from_run = self.render("run.png", run, *size)
        self.assertEqual(png_size(from_run), (320, 200))
        self.assertEqual(from_run.read_bytes(), self.render("source.png", *self.source, *size).read_bytes())
        self.assertEqual(from_run.read_bytes(), self.render("operand_last.png", *size, run).read_bytes())
        rest = self.render("rest.png", run, "--size", "320x200", "--view", "right")
        self.assertNotEqual(from_run.read_bytes(), rest.read_bytes())

    def test_view_and_colour_change_the_picture(self):
        run = self.simulate("--export", "vtp")
        pictures = {self.render(f"{view}.png", run, "--size", "64x64", "--view", view).read_bytes()
                    for view in ("anterior", "posterior", "left", "right", "superior", "inferior")}
        self.assertEqual(len(pictures), 6)
        at = (run, "--frame", "6", "--size", "64x64")
        colours = {self.render(f"{colour}.png", *at, "--colour", colour).read_bytes()
                   for colour in ("anatomy", "strain", "depth", "contact")}
        self.assertEqual(len(colours), 4)
        self.assertIn(self.render("default.png", *at).read_bytes(), colours)
        self.check_error(2, ["--colour", "did you mean 'depth'?"], "render", *at, "--colour", "dept", "--out", "x.png")

    def test_the_whole_editor(self):
        run = self.simulate("--export", "vtp")
        at = ("--ui", "--frame", "6", "--size", "800x500")
        editor = self.render("editor.png", run, *at)
        self.assertEqual(png_size(editor), (800, 500))
        plain = self.render("plain.png", run, *at[1:])
        self.assertNotEqual(editor.read_bytes(), plain.read_bytes())
        self.assertNotEqual(editor.read_bytes(),
                            self.render("rest.png", run, "--ui", "--size", "800x500").read_bytes())
        self.assertEqual(png_size(self.render("source.png", *self.source, *at)), (800, 500))
        self.check_error(2, ["frame 13", "12"], "render", run, "--ui", "--frame", "13", "--out", "x.png")
        self.check_error(2, ["--view", "--ui"], "render", run, "--ui", "--view", "left", "--out", "x.png")
        thinned = self.simulate("--export", "vtp", "--every", "3")
        self.check_error(2, ["--every"], "render", thinned, "--ui", "--frame", "6", "--out", "x.png")

    def test_export_png_leaves_four_pictures(self):
        run = self.simulate("--export", "png")
        self.assertEqual(sorted(file.name for file in run.glob("*.png")),
                         ["film_strip.png", "flexed.png", "last.png", "rest.png"])
        self.assertEqual(png_size(run / "rest.png"), (1280, 800))
        width, height = png_size(run / "film_strip.png")
        self.assertGreater(width, 5 * height)
        contents = [(run / name).read_bytes() for name in ("rest.png", "flexed.png", "last.png")]
        self.assertEqual(len(set(contents)), 3)

    def test_errors(self):
        run = self.simulate("--export", "vtp", "--every", "5")
        out = ["--out", self.folder / "x.png"]
        self.check_error(2, ["--out"], "render", run)
        self.check_error(2, ["no source"], "render", *out)
        self.check_error(2, ["one of the two"], "render", run, *self.source, *out)
        for size in ("100", "100x", "axb", "0x100", "100x100000", "-5x100", "100x100x100"):
            self.check_error(2, ["--size", size.split("x")[0]], "render", run, "--size", size, *out)
        self.check_error(2, ["--view", "did you mean 'posterior'?"], "render", run, "--view", "postrior", *out)
        self.check_error(2, ["--frame", "13", "0 to 12"], "render", *self.source, "--frame", "13", *out)
        self.check_error(2, ["frame 7", "5"], "render", run, "--frame", "7", *out)
        self.check_error(1, ["nowhere"], "render", self.folder / "nowhere", *out)
        self.check_error(1, ["input"], "render", self.folder / "input", *out)
        self.check_error(1, ["no such place", "annot"], "render", run, "--size", "16x16", "--out",
                         "/proc/no such place/x.png")
        self.assertFalse((self.folder / "x.png").exists())
        (run / "frames" / "strap.0000.vtp").write_text("garbage")
        self.check_error(1, ["strap.0000.vtp"], "render", run, *out)


if __name__ == "__main__":
    unittest.main()
