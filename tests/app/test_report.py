"""fascicle report and fascicle render --frames: what a run leaves for others to look at."""
import html.parser
import os
import stat
import struct
import unittest

import small_scene
from program import ProgramTest


class Page(html.parser.HTMLParser):
    """Collects tags and checks that they close in order."""
    VOID = {"meta", "img", "br"}

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.tags, self.faults, self.fetched = [], [], [], []
        self.feed(text)
        self.close()
        if self.open:
            self.faults.append(f"left open: {self.open}")

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        if tag not in self.VOID:
            self.open.append(tag)
        self.fetched += [v for k, v in attributes if k in ("src", "href", "xlink:href") and not v.startswith("data:")]

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"{tag} closed out of order at {self.getpos()}")


def gif_frames(path):
    """Size and number of pictures of a GIF, read block by block."""
    data = path.read_bytes()
    assert data[:6] == b"GIF89a", path
    width, height, flags = struct.unpack("<HHB", data[6:11])
    at = 13 + (3 << (flags & 7) + 1 if flags & 0x80 else 0)
    count = 0

    def skip_blocks(at):
        while data[at]:
            at += data[at] + 1
        return at + 1
    while data[at] != 0x3B:
        if data[at] == 0x21:
            at = skip_blocks(at + 2)
        else:
            assert data[at] == 0x2C
            count += 1
            local = data[at + 9]
            at = skip_blocks(at + 11 + (3 << (local & 7) + 1 if local & 0x80 else 0))
    return width, height, count


class ReportTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.source, _ = small_scene.write_scene(self.folder / "input")
        self.run_folder = self.folder / "run"
        self.check_done("simulate", *self.source, "--export", "vtp", "--quiet", "--out", self.run_folder)

    def test_reports_of_a_run_and_of_its_source(self):
        for name, operand in (("run.html", [self.run_folder]), ("source.html", self.source)):
            out = self.folder / name
            self.check_done("report", *operand, "--quiet", "--out", out)
            text = out.read_text(encoding="utf-8")
            page = Page(text)
            self.assertEqual(page.faults, [])
            self.assertEqual(page.fetched, [])
            self.assertNotIn("script", page.tags)
            self.assertEqual(page.tags.count("img"), 4)
            self.assertGreaterEqual(page.tags.count("svg"), 8)
            self.assertIn("strap", text)
            self.assertIn("Time of solving a frame", text)
        self.check_error(2, ["--out FILE.html"], "report", self.run_folder)
        self.check_error(1, ["summary.json"], "report", self.folder / "nothing", "--out", self.folder / "x.html")
        self.assertFalse((self.folder / "x.html").exists())

    def test_frames_as_pictures_and_as_a_gif(self):
        size = ("--size", "121x80", "--quiet")
        self.check_done("render", self.run_folder, "--frames", "0:12:5", *size, "--out", self.folder / "film")
        self.assertEqual(sorted(f.name for f in (self.folder / "film").iterdir()),
                         ["film_0000.png", "film_0005.png", "film_0010.png", "film_0012.png"])
        self.check_done("render", self.run_folder, "--frames", "2:", *size, "--fps", "10", "--out", self.folder / "f.gif")
        self.assertEqual(gif_frames(self.folder / "f.gif"), (121, 80, 11))
        self.check_done("render", *self.source, "--frames", "0:2", *size, "--out", self.folder / "source.gif")
        self.assertEqual(gif_frames(self.folder / "source.gif")[2], 3)

    def test_a_film_by_the_encoder_in_the_path(self):
        tools = self.folder / "tools"
        tools.mkdir()
        without = {**os.environ, "PATH": str(tools)}
        arguments = ("render", self.run_folder, "--frames", "0:3", "--size", "65x48", "--quiet", "--out", "f.mp4")
        self.check_error(1, ["f.mp4", "ffmpeg"], *arguments, env=without)
        fake = tools / "ffmpeg"
        fake.write_text('#!/bin/sh\nfor last; do :; done\nexec cat > "$last"\n')
        fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
        self.check_done(*arguments, env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"})
        self.assertEqual((self.folder / "f.mp4").stat().st_size, 4 * 64 * 48 * 4)

    def test_wrong_options(self):
        for words, options in ((["--frames", "FIRST:LAST"], ("--frames", "3", "--out", "d")),
                               (["--frames"], ("--frames", "5:3", "--out", "d")),
                               (["--out", "FILE.gif"], ("--frames", "0:3", "--out", "x.avi")),
                               (["--fps", "50"], ("--frames", "0:3", "--fps", "60", "--out", "x.gif")),
                               (["--transparent"], ("--frames", "0:3", "--transparent", "--out", "x.gif")),
                               (["frame 99"], ("--frames", "0:99", "--out", "d"))):
            self.check_error(2, words, "render", self.run_folder, *options)
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ["input", "run"])


if __name__ == "__main__":
    unittest.main()
