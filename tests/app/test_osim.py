"""--osim: a model and a measured trial move the bones of a simulation."""
import csv
import json
import math
import os
import unittest
from pathlib import Path

import small_scene
from program import SOURCE_DIR, ProgramTest

MODEL = """<?xml version="1.0"?>
<OpenSimDocument Version="40000"><Model name="leg"><Ground name="ground"/>
<BodySet name="bodyset"><objects>
<Body name="pelvis"><attached_geometry><Mesh name="a"><mesh_file>hip.obj</mesh_file></Mesh></attached_geometry></Body>
<Body name="femur_r"><attached_geometry><Mesh name="b"><mesh_file>thigh.obj</mesh_file><scale_factors>0.001 0.001 0.001</scale_factors></Mesh>
<Mesh name="c"><mesh_file>patella.vtp</mesh_file></Mesh></attached_geometry></Body>
<Body name="tibia_r"><attached_geometry><Mesh name="d"><mesh_file>tibia.vtp</mesh_file></Mesh></attached_geometry></Body>
</objects></BodySet>
<JointSet name="jointset"><objects>
<SliderJoint name="s"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/pelvis</socket_child_frame>
<coordinates><Coordinate name="pelvis_tx"/></coordinates></SliderJoint>
<PinJoint name="hip"><socket_parent_frame>/bodyset/pelvis</socket_parent_frame><socket_child_frame>/bodyset/femur_r</socket_child_frame>
<coordinates><Coordinate name="hip_flexion_r"/></coordinates></PinJoint>
<PinJoint name="knee"><socket_parent_frame>knee_in_femur</socket_parent_frame><socket_child_frame>/bodyset/tibia_r</socket_child_frame>
<frames><PhysicalOffsetFrame name="knee_in_femur"><socket_parent>/bodyset/femur_r</socket_parent><translation>0 -0.4 0</translation></PhysicalOffsetFrame></frames>
<coordinates><Coordinate name="knee_angle_r"/></coordinates></PinJoint>
</objects></JointSet>
<ForceSet><objects>%s</objects></ForceSet></Model></OpenSimDocument>
"""

MUSCLE = """<Thelen2003Muscle name="%s"><max_isometric_force>%s</max_isometric_force><optimal_fiber_length>0.08</optimal_fiber_length>
<GeometryPath name="path"><PathPointSet><objects>
<PathPoint name="p"><socket_parent_frame>/bodyset/%s</socket_parent_frame><location>-0.05 0.03 0</location></PathPoint>
<PathPoint name="q"><socket_parent_frame>/bodyset/%s</socket_parent_frame><location>-0.03 -0.12 0</location></PathPoint>
</objects></PathPointSet></GeometryPath></Thelen2003Muscle>
"""

HEADER = "walk\ninDegrees=yes\nendheader\n"


class OsimTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.input = self.folder / "model of a leg"
        (self.input / "Geometry").mkdir(parents=True)
        self.model, self.trial = self.input / "leg.osim", self.input / "walk.mot"
        self.model.write_text(MODEL % (MUSCLE % ("glut", "120", "pelvis", "femur_r") + MUSCLE % ("ham", "90", "pelvis", "tibia_r") +
                                       MUSCLE % ("idle", "0", "pelvis", "femur_r")))
        small_scene.write_box(self.input / "Geometry" / "hip.obj", (-0.045, 0.01, -0.03), (0.03, 0.08, 0.03), (3, 3, 3))
        small_scene.write_box(self.input / "thigh.obj", (-25, -400, -20), (15, -20, 20), (2, 12, 2))
        self.write_trial([(0.02 * k, 0.005 * k, 3 * math.sin(0.5 * k), -2 * k) for k in range(9)])
        self.source = ["--osim", self.model, "--motion", self.trial]
        self.out = self.folder / "out"

    def write_trial(self, rows, header=HEADER, columns="time\tpelvis_tx\thip_flexion_r\tknee_angle_r\n"):
        self.trial.write_text(header + columns + "".join("\t".join(map(repr, row)) + "\n" for row in rows))

    def rows(self, name, out=None):
        with open((out or self.out) / name, newline="") as file:
            return list(csv.DictReader(file))

    def summary(self, out=None):
        return json.loads(((out or self.out) / "summary.json").read_text())

    def test_a_trial_drives_bones_muscles_and_numbers(self):
        text = self.check_done("simulate", *self.source, "--muscle", "glut=pelvis,femur_r", "--threads", "1", "--export", "vtp", "--out",
                               self.out)
        for words in ("note: glut: no mesh, a spindle stands in for it: 16.0 cm3 (120 N / 60 N/cm2 x 8.0 cm)",
                      "note: bone femur_r lacks a part: patella.vtp not found",
                      "note: bodies without a bone, since their meshes were not found: tibia_r (tibia.vtp)",
                      "note: walk.mot: frames ", "note: angle_deg is hip_flexion_r",
                      "--axes opensim_to_lps"):
            self.assertIn(words, text)
        summary = self.summary()
        lead_in, last = summary["model"]["lead_in_frames"], summary["frames"]
        self.assertEqual(last, lead_in + 8)
        self.assertEqual(summary["model"]["bodies"], {"pelvis": "pelvis", "femur_r": "femur_r"})
        self.assertEqual(summary["unit"], "m")
        paths = [entry["path"] for entry in summary["inputs"]]
        self.assertIn(str(self.model), paths)
        self.assertIn(str(self.trial), paths)
        metrics = self.rows("metrics.csv")
        self.assertEqual(list(metrics[0])[-3:], ["pelvis_tx_mm", "hip_flexion_r_deg", "knee_angle_r_deg"])
        poses = {(row["frame"], row["bone"]): row for row in self.rows("motion.csv")}
        for k in range(9):
            row, frame = metrics[lead_in + k], str(lead_in + k)
            flexion = 3 * math.sin(0.5 * k)
            self.assertEqual(row["frame"], frame)
            self.assertAlmostEqual(float(row["angle_deg"]), flexion, places=9)
            self.assertAlmostEqual(float(row["hip_flexion_r_deg"]), flexion, places=9)
            self.assertAlmostEqual(float(row["pelvis_tx_mm"]), 5 * k, places=9)
            femur = poses[frame, "femur_r"]
            self.assertAlmostEqual(float(femur["m00"]), math.cos(math.radians(flexion)), places=12)
            self.assertAlmostEqual(float(femur["m10"]), math.sin(math.radians(flexion)), places=12)
            self.assertAlmostEqual(float(femur["m03"]), 0.005 * k, places=12)
            self.assertLess(abs(float(row["volume_ratio"]) - 1), 0.01)
        lines = [row for row in self.rows("lines.csv") if row["muscle"] == "glut"]
        self.assertEqual(list(lines[0])[-2:], ["moment_arm_hip_flexion_r_mm", "moment_arm_knee_angle_r_mm"])
        for row in lines:
            a = math.radians(float(row["angle_deg"]))  # about the origin of the pelvis
            x, y = -30 * math.cos(a) + 120 * math.sin(a), -30 * math.sin(a) - 120 * math.cos(a)
            length = math.hypot(-50 - x, 30 - y)
            self.assertAlmostEqual(float(row["length_mm"]), length, places=9)
            self.assertAlmostEqual(float(row["moment_arm_mm"]), (x * (30 - y) - y * (-50 - x)) / length, places=9)
            self.assertEqual(float(row["moment_arm_knee_angle_r_mm"]), 0)
        for name in ("frames/glut.0000.vtp", f"frames/glut.{last:04d}.vtp", "bones/femur_r.vtp"):
            self.assertTrue((self.out / name).is_file(), name)

    def test_info_tells_what_a_model_holds(self):
        text = self.check_done("info", self.model)
        for words in ("OpenSim model, version 40000", "coordinates   3", "3 lines", "pelvis, 1 meshes",
                      "femur_r, 1 meshes; not found: patella.vtp", "tibia_r, 0 meshes; not found: tibia.vtp"):
            self.assertIn(words, text)
        self.model.write_text("no model")
        self.check_error(1, ["leg.osim"], "info", self.model)

    def test_a_table_of_poses_works_as_before(self):
        motion = self.folder / "poses.csv"
        motion.write_text("frame,bone,cx,cy,cz,ax,ay,az,angle_deg\n4,femur_r,0,0,0,0,0,1,4\n")
        text = self.check_done("simulate", "--osim", self.model, "--motion", motion, "--muscle", "glut", "--threads", "1", "--out",
                               self.out)
        self.assertIn("poses.csv: moves femur_r, 4 frames", text)
        self.assertEqual(self.summary()["frames"], 4)

    def test_what_is_wrong_is_told(self):
        def fails(code, words, *arguments):
            self.check_error(code, words, "simulate", *arguments, "--out", self.out)

        glut = ["--muscle", "glut=pelvis,femur_r"]
        fails(2, ["--osim", "--motion TRIAL.mot"], "--osim", self.model, *glut)
        fails(1, ["absent.osim"], "--osim", "absent.osim", "--motion", self.trial, *glut)
        fails(1, ["absent.mot"], "--osim", self.model, "--motion", "absent.mot", *glut)
        fails(1, ["leg.osim", "'ham'", "'tibia_r', which has no bone", "--bone MESH=tibia_r"], *self.source, "--muscle", "ham")
        fails(1, ["'idle' tells no force"], *self.source, "--muscle", "idle")
        fails(1, ["glutt", "no such file, and no muscle of the model", "did you mean 'glut'?"], *self.source, "--muscle", "glutt=pelvis")
        fails(2, ["--muscle", "no body 'femur'", "did you mean 'femur_r'?"], *self.source, "--muscle", "glut=pelvis,femur")
        fails(2, ["--hinge", "cannot go with --osim"], *self.source, *glut, "--hinge", "0,0,0;1,0,0")
        fails(2, ["--axes", "did you mean 'opensim_to_lps'?"], *self.source, *glut, "--axes", "opensim_to_lp")
        fails(2, ["--mesh-frame", "body, ground or scan"], *self.source, *glut, "--mesh-frame", "world")
        fails(2, ["--to", "--from"], *self.source, *glut, "--from", "0.1", "--to", "0.1")
        fails(1, ["walk.mot", "within 0 to 0.16 s"], *self.source, *glut, "--from", "0.1", "--to", "2")
        fails(2, ["--coordinate", "is about a model"], "--scene", "squish-box", "--coordinate", "q")
        self.write_trial([(0, 0, 1, 0), (0.1, 0, float("nan"), 0)])
        fails(1, ["walk.mot, line 6"], *self.source, *glut)
        self.write_trial([(0, 0, 0, 0), (0.1, 0, 180, 0)])
        fails(1, ["walk.mot", "'femur_r' would turn by half a turn"], *self.source, *glut)
        self.model.write_text("<xml/>")
        fails(1, ["leg.osim", "is no OpenSim model"], *self.source, *glut)

    def test_inputs_are_not_replaced_and_malformed_files_end_in_one_line(self):
        import shutil
        trial = self.folder / "metrics.csv"
        shutil.copy(self.trial, trial)
        self.check_error(2, ["would replace the input"], "simulate", "--osim", self.model, "--motion", trial, "--muscle", "glut", "--out",
                         self.folder)
        model, rows = self.model.read_bytes(), self.trial.read_bytes()
        for percent in range(0, 100, 9):
            self.model.write_bytes(model[:len(model) * percent // 100])
            self.check_error(1, ["leg.osim"], "simulate", *self.source, "--muscle", "glut", "--out", self.out)
        self.model.write_bytes(model)
        for percent in (0, 10, 40):
            self.trial.write_bytes(rows[:len(rows) * percent // 100])
            result = self.run_program("simulate", *self.source, "--muscle", "glut", "--quiet", "--threads", "1", "--out", self.out)
            if result.returncode != 0:
                self.check_error_result(result, 1, ["walk.mot"])

    @unittest.skipUnless((Path(os.environ.get("FASCICLE_DATA", SOURCE_DIR / "../shared/data")) / "opensim").is_dir(), "no real data")
    def test_real_data_of_a_gait_model(self):
        data = Path(os.environ.get("FASCICLE_DATA", SOURCE_DIR / "../shared/data")) / "opensim"
        text = self.check_done("simulate", "--osim", data / "gait2392_thelen2003muscle.osim", "--motion", data / "subject01_walk1_ik.mot",
                               "--muscle", "glut_max1_r", "--axes", "opensim_to_lps", "--from", "0.6", "--to", "1.8", "--trial-frames", "12",
                               "--iterations", "4", "--out", self.out)
        self.assertIn("glut_max1_r: no mesh, a spindle stands in for it", text)
        rows = self.rows("metrics.csv")
        self.assertEqual(len(rows), self.summary()["model"]["lead_in_frames"] + 13)
        self.assertLess(max(float(row["penetrating_vertices"]) for row in rows), 1)


if __name__ == "__main__":
    unittest.main()
