"""What cannot work ends in one line and the right exit code, and leaves nothing half-written and no input changed."""
import os
import resource
import shutil
import subprocess
import unittest
from pathlib import Path

import small_scene
from program import PROGRAM, ProgramTest, file_hashes


class FailureTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.input = self.folder / "input"
        self.source, _ = small_scene.write_scene(self.input)
        self.before = file_hashes(self.input)

    def tearDown(self):
        self.assertEqual(file_hashes(self.input), self.before, "an input was changed")
        for file in self.folder.rglob("*"):
            self.assertNotIn(".part", file.name, "a half-written file was left")

    def fails(self, code, words, *arguments, **options):
        out = self.folder / "out"
        self.check_error(code, words, "simulate", *arguments, "--out", out, **options)
        if out.is_dir():
            self.assertFalse((out / "summary.json").exists(), "a failed run has no summary")

    def without(self, *names):
        """The SOURCE options but those named."""
        kept, options = [], list(self.source)
        while options:
            name, value = options.pop(0), options.pop(0)
            if name not in names:
                kept += [name, value]
        return kept

    # Files that are not what they should be.

    def test_mesh_is_missing(self):
        self.fails(1, ["nowhere.obj", "no such file"], "--muscle", self.input / "nowhere.obj",
                   "--bone", self.input / "fixed.obj")

    def test_mesh_is_a_folder(self):
        self.fails(1, ["input", "folder"], "--muscle", self.input, "--bone", self.input / "fixed.obj")

    def test_mesh_is_garbage_or_cut_short(self):
        bad = self.folder / "bad.obj"
        whole = (self.input / "strap.obj").read_text()
        for name, content in (("garbage", bytes(range(256)) * 40), ("empty", b""),
                              ("cut in a line", whole[:len(whole) // 2].encode()),
                              ("no triangles", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
                              ("index out of range", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
                              ("open", whole.rsplit("f ", 1)[0].encode())):
            with self.subTest(name):
                bad.write_bytes(content)
                self.fails(1, ["bad.obj"], "--muscle", bad, "--bone", self.input / "fixed.obj")

    def test_project_is_missing_or_garbage(self):
        self.fails(1, ["nowhere.fascicle", "no such file"], "--project", self.input / "nowhere.fascicle")
        bad = self.folder / "bad.fascicle"
        bad.write_text('{"muscles": [')
        self.fails(1, ["bad.fascicle"], "--project", bad)

    def test_outlines_are_missing_or_garbage(self):
        self.fails(1, ["nowhere.csv", "no such file"], *self.source, "--attachments",
                   f"strap={self.input / 'nowhere.csv'}")
        bad = self.folder / "bad.csv"
        bad.write_text("what,is,this\n1,2\n")
        self.fails(1, ["bad.csv"], *self.source, "--attachments", f"strap={bad}")

    # Command lines that are wrong.

    def test_option_or_scene_or_parameter_is_unknown(self):
        self.fails(2, ["unknown option '--thread'", "did you mean '--threads'?"], *self.source, "--thread", "2")
        self.fails(2, ["hipp", "did you mean 'hip'?"], "--scene", "hipp")
        self.fails(2, ["solver.stifness", "did you mean 'solver.stiffness'?"], *self.source, "--set",
                   "solver.stifness=1")

    def test_value_is_bad(self):
        for option, value, expected in (
                ("--set", "solver.stiffness", "KEY=VALUE"), ("--set", "solver.stiffness=2", "0 to 1"),
                ("--set", "solver.stiffness=stiff", "'stiff'"), ("--set", "solver.method=magic", "xpbd"),
                ("--set", "solver.iterations=1.5", "whole"), ("--set", "solver.stiffness=nan", "'nan'"),
                ("--threads", "--quiet", "--threads"), ("--angle-deg", "3", "2 times"), ("--iterations", "0", "--iterations"), ("--iterations", "many", "'many'"),
                ("--threads", "0", "--threads"), ("--threads", "-3", "--threads"), ("--every", "0", "--every"),
                ("--method", "classical", "did you mean 'classic'?"), ("--export", "vtp,bmp", "'bmp'")):
            with self.subTest(option + " " + value):
                self.fails(2, [option if option != "--set" or "=" not in value else "solver.", expected],
                           *self.source, option, value)

    def test_source_is_missing_or_contradicts_itself(self):
        self.fails(2, ["--scene"])
        self.fails(2, ["--scene", "--muscle"], "--scene", "hip", *self.source)
        self.fails(2, ["--muscle"], "--bone", self.input / "fixed.obj")
        self.fails(2, ["--units"], *self.without("--units"), "--units", "inches")

    def test_hinge_is_bad(self):
        for hinge in ("0,0,0;0,0,0", "0,0,0", "a,b,c;1,0,0", "0,0,0;1,0", "0,0,0;1,0,inf", "1,2,3;4,5,6;7,8,9", "nan,0,0;1,0,0"):
            with self.subTest(hinge):
                self.fails(2, ["--hinge"], *self.without("--hinge"), "--hinge", hinge)
        self.fails(2, ["--angle-deg", "'far'"], *self.without("--angle-deg"), "--angle-deg", "far")

    def test_phases_are_bad(self):
        for phases in ("0,0,0", "1,2", "1,2,3,4", "-1,2,3", "1.5,2,3", "a,b,c", "", "99999999999,0,0"):
            with self.subTest(phases):
                self.fails(2, ["--phases"], *self.without("--phases"), "--phases", phases)

    def test_motion_without_a_moving_bone(self):
        self.fails(2, ["--moving-bone"], *self.without("--moving-bone"))

    def test_attachments_name_no_muscle(self):
        outlines = self.folder / "outlines.csv"
        outlines.write_text("x")
        self.fails(2, ["--attachments", "stap", "strap"], *self.source, "--attachments", f"stap={outlines}")
        self.fails(2, ["--attachments", "MUSCLE=FILE"], *self.source, "--attachments", str(outlines))
        self.fails(2, ["--surface-fibres", "stap"], *self.source, "--surface-fibres", f"stap={outlines}")

    def test_out_is_missing(self):
        self.check_error(2, ["--out"], "simulate", *self.source)
        self.check_error(2, ["--out"], "simulate", *self.source, "--out")

    # Places that cannot be written to.

    def test_out_is_a_file(self):
        file = self.folder / "file"
        file.write_text("mine")
        self.check_error(1, ["file"], "simulate", *self.source, "--out", file)
        self.check_error(1, ["file"], "simulate", *self.source, "--out", file / "below")
        self.assertEqual(file.read_text(), "mine")

    def test_out_is_read_only(self):
        place = self.folder / "read only"
        place.mkdir()
        for folder in (self.folder, self.input):
            folder.chmod(0o755)
        place.chmod(0o555)
        # Permissions do not hold root: a copy of the program runs as nobody then, who may not see the build folder.
        program = Path(shutil.copy(PROGRAM, self.folder))
        program.chmod(0o755)
        as_nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        for out in (place, place / "new"):
            result = subprocess.run([program, "simulate", *map(str, self.source), "--out", out], capture_output=True,
                                    text=True, timeout=120, cwd=self.folder, **as_nobody)
            self.check_error_result(result, 1, ["read only", "ermission denied"])
        self.assertEqual(file_hashes(place), {})

    def test_files_may_not_grow(self):
        """A limit on file sizes fails writes as a full disk does, part of the way through a file."""
        def limit(size):
            return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        for size in (0, 100, 3000, 8000):
            with self.subTest(size):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.fails(1, [str(self.folder / "out"), "cannot write: File too large"], *self.source, "--export",
                           "vtp", preexec_fn=limit(size))

    def test_disk_is_full(self):
        """A disk of 64 kB, where the system lets a test mount one."""
        disk = self.folder / "disk"
        disk.mkdir()
        script = 'mount -t tmpfs -o size=64k none "$1" || exit 77; shift; "$@"; code=$?; ls -R "$0" >&3; exit $code'
        with open(self.folder / "listing", "w+") as listing:
            result = subprocess.run(
                ["unshare", "--mount", *([] if os.geteuid() == 0 else ["--map-root-user"]), "bash", "-c",
                 f"exec 3>&{listing.fileno()}; {script}", disk, disk, PROGRAM, "simulate", *map(str, self.source),
                 "--export", "vtp", "--out", disk / "out"],
                capture_output=True, text=True, timeout=120, pass_fds=[listing.fileno()])
            if result.returncode == 77 or "unshare" in result.stderr:
                self.skipTest("no right to mount: " + result.stderr.strip())
            self.check_error_result(result, 1, [str(disk), "cannot write: No space left"])
            listing.seek(0)
            text = listing.read()
        self.assertNotIn(".part", text)
        self.assertNotIn("summary.json", text)


if __name__ == "__main__":
    unittest.main()
