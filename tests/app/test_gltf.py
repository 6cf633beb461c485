"""What the program writes for Blender, Houdini and others, looked at by checkers that are not ours (scripts/validators) and by hand."""
import csv
import json
import re
import shutil
import struct
import subprocess
import unittest

import small_scene
from program import SOURCE_DIR, TIMEOUT, ProgramTest

MODULES = SOURCE_DIR / "build" / "validators" / "node_modules"


def needs(package):
    reason = ("node is not installed" if shutil.which("node") is None else
              "" if (MODULES / package).is_dir() else f"{package} is not there: run scripts/validators")
    return unittest.skipIf(reason != "", reason)


class Glb:
    """A .glb by the specification, without any library."""
    FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
    COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}

    def __init__(self, path):
        data = path.read_bytes()
        assert data[:4] == b"glTF"
        version, length, json_length = struct.unpack_from("<III", data, 4)
        assert version == 2 and length == len(data) and data[16:20] == b"JSON" and json_length % 4 == 0
        self.json = json.loads(data[20:20 + json_length].decode("utf-8"))
        start = 20 + json_length
        assert data[start + 4:start + 8] == b"BIN\0"
        self.binary = data[start + 8:]

    def values(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        assert view["byteOffset"] % 4 == 0 and "byteStride" not in view
        n = accessor["count"] * self.COMPONENTS[accessor["type"]]
        flat = struct.unpack_from(f"<{n}{self.FORMATS[accessor['componentType']]}", self.binary, view["byteOffset"])
        width = self.COMPONENTS[accessor["type"]]
        return [flat[i:i + width] for i in range(0, n, width)]

    def node(self, name):
        [(index, node)] = [(i, n) for i, n in enumerate(self.json["nodes"]) if n["name"] == name and "mesh" in n]
        return index, node

    def sampler(self, node, path):
        animation = self.json["animations"][0]
        [channel] = [c for c in animation["channels"] if c["target"] == {"node": node, "path": path}]
        return animation["samplers"][channel["sampler"]]


def vtp_points(path):
    text = path.read_text()
    block = re.search(r"<Points>.*?<DataArray[^>]*>(.*?)</DataArray>", text, re.S).group(1)
    numbers = [float(word) for word in block.split()]
    return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]


def in_metres(p):
    """LPS in mm to glTF: metres, y up."""
    return p[0] / 1000, p[2] / 1000, -p[1] / 1000


def turned(q, v):
    """v turned by the quaternion (x, y, z, w)."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


class GltfTest(ProgramTest):
    def setUp(self):
        super().setUp()
        source, _ = small_scene.write_scene(self.folder / "input")
        # A second muscle beside the first, with a name that has to be escaped everywhere, and fibres in both.
        self.second = 'm\u00fcskel "b" #2'
        small_scene.write_box(self.folder / "input" / (self.second + ".obj"), (-10, 5.5, -40), (10, 9.5, 40), (4, 1, 16))
        source += ["--muscle", self.folder / "input" / (self.second + ".obj")]
        self.source = source + ["--set", "fibres.method=kukacka", "--set", "fibres.count=4"]

    def simulate(self, *options):
        out = self.folder / "run"
        self.check_done("simulate", *self.source, *options, "--quiet", "--out", out)
        return out

    def reports(self, *files):
        result = subprocess.run(["node", SOURCE_DIR / "tests/app/validate_gltf.js", MODULES, *files], capture_output=True,
                                text=True, timeout=TIMEOUT)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [json.loads(line) for line in result.stdout.splitlines()]

    @needs("gltf-validator")
    def test_the_validator_of_khronos_has_nothing_to_say(self):
        run = self.simulate("--export", "vtp,glb")
        [whole] = run.glob("*.glb")
        few, still, y_up, mesh = (self.folder / name for name in ("few.glb", "still.glb", "y_up.glb", "mesh.glb"))
        self.check_done("export", run, "--out", few, "--morph-targets", "3")
        self.check_done("export", run, "--out", still, "--frames", "4:4")
        self.check_done("export", run, "--out", y_up, "--up", "y", "--frames", "2:9:3")
        self.check_done("export", whole, "--out", mesh)  # what was read back
        for report in self.reports(whole, few, still, y_up, mesh):
            found = report["issues"]
            self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])
            self.assertEqual((found["numInfos"], found["numHints"]), (0, 0), found["messages"])
        info = self.reports(whole)[0]["info"]
        self.assertEqual(info["animationCount"], 1)
        self.assertTrue(info["hasMorphTargets"])
        self.assertEqual(info["drawCallCount"], 6)  # two muscles, their fibres, two bones

    def test_shapes_and_bones_are_those_of_the_frames(self):
        run = self.simulate("--export", "vtp,glb")
        [path] = run.glob("*.glb")
        glb = Glb(path)
        for name in ("strap", self.second):
            index, node = glb.node(name)
            [primitive] = glb.json["meshes"][node["mesh"]]["primitives"]
            base = glb.values(primitive["attributes"]["POSITION"])
            self.assertEqual(len(primitive["targets"]), 12)
            for frame, target in enumerate(primitive["targets"], 1):
                wanted = vtp_points(run / "frames" / f"{name}.{frame:04d}.vtp")
                moved = glb.values(target["POSITION"])
                worst = max(abs(b + d - w) for p, q, v in zip(base, moved, wanted)
                            for b, d, w in zip(p, q, in_metres(v)))
                self.assertLess(worst, 1e-8)  # 0.01 micrometre: floats
            sampler = glb.sampler(index, "weights")
            times = [t for (t,) in glb.values(sampler["input"])]
            for frame, time in enumerate(times):
                self.assertAlmostEqual(time, frame / 60, places=6)
            weights = [w for (w,) in glb.values(sampler["output"])]
            self.assertEqual([weights[12 * k:12 * k + 12].index(1) for k in range(1, 13)], list(range(12)))
            self.assertEqual(sum(weights), 12)
        index, node = glb.node("strap fibres")
        [primitive] = glb.json["meshes"][node["mesh"]]["primitives"]
        self.assertEqual(primitive["mode"], 1)
        wanted = vtp_points(run / "fibres" / "strap.0012.vtp")
        base, moved = (glb.values(a) for a in (primitive["attributes"]["POSITION"], primitive["targets"][-1]["POSITION"]))
        self.assertLess(max(abs(b + d - w) for p, q, v in zip(base, moved, wanted)
                            for b, d, w in zip(p, q, in_metres(v))), 1e-8)
        # The turning bone: its corners by motion.csv and by the samplers.
        index, node = glb.node("turning")
        turns, places = (glb.values(glb.sampler(index, path)["output"]) for path in ("rotation", "translation"))
        [primitive] = glb.json["meshes"][node["mesh"]]["primitives"]
        corners = glb.values(primitive["attributes"]["POSITION"])
        rest = vtp_points(run / "bones" / "turning.vtp")
        with open(run / "motion.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["bone"] == "turning"]
        self.assertEqual(len(rows), 13)
        for k, row in enumerate(rows):
            for corner, point in zip(corners, rest):
                wanted = in_metres([sum(float(row[f"m{i}{j}"]) * c for j, c in enumerate([*point, 1])) for i in range(3)])
                found = [a + b for a, b in zip(turned(turns[k], corner), places[k])]
                self.assertLess(max(abs(a - b) for a, b in zip(found, wanted)), 1e-7)
            if k > 0:  # the shorter way
                self.assertGreater(sum(a * b for a, b in zip(turns[k], turns[k - 1])), 0)
        about = glb.json["asset"]["extras"]["fascicle"]
        self.assertEqual(about["unit"], "mm")
        self.assertEqual(about["frames"], list(range(13)))
        self.assertNotIn(str(self.folder), json.dumps(glb.json))  # no paths of the user's

    @needs("tinyusdz")
    def test_another_reader_reads_the_usd(self):
        run = self.simulate("--export", "usda")
        [path] = run.glob("*.usda")
        result = subprocess.run(["node", SOURCE_DIR / "tests/app/read_usd.mjs", MODULES, path], capture_output=True, text=True,
                                timeout=TIMEOUT)
        self.assertEqual(result.returncode, 0, result.stderr[-2000:])
        report = json.loads(result.stdout.splitlines()[-1])
        self.assertTrue(report["read"], report["error"])
        self.assertEqual(len(report["meshes"]), 4)

    def test_all_that_a_run_can_be_exported_as(self):
        run = self.simulate("--export", "vtp,csv,glb,usda,obj,pc2,mdd,json,meshes", "--every", "5")
        name = json.loads((run / "summary.json").read_text())["scene"]
        for file in (f"{name}.glb", f"{name}.usda", f"obj/{name}_0000.obj", f"obj/{name}_0012.obj", "pc2/strap.pc2",
                     "pc2/strap.obj", "mdd/strap fibres.mdd", "metrics.json", "meshes/turning.pvd", "fibres/strap.pvd"):
            self.assertTrue((run / file).is_file(), file)
        self.assertEqual(len(list((run / "obj").iterdir())), 4)  # 0, 5, 10, 12
        self.assertFalse((run / "pc2" / "fixed.pc2").exists())  # it stands still
        data = json.loads((run / "metrics.json").read_text())
        self.assertEqual(data["format"], "fascicle metrics")
        with open(run / "metrics.csv", newline="") as file:
            table = list(csv.DictReader(file))
        self.assertEqual(len(data["metrics"]), len(table))
        self.assertEqual(list(data["metrics"][3]), list(table[3]))
        for row, wanted in zip(data["metrics"], table):
            self.assertEqual(row["muscle"], wanted["muscle"])
            self.assertEqual(row["volume_ratio"], float(wanted["volume_ratio"]))
        self.assertEqual(len(data["fibres"]), 13 * len({(r["muscle"], r["fibre"]) for r in data["fibres"]}))
        series = (run / "fibres" / "strap.pvd").read_text()
        self.assertEqual(re.findall(r'file="([^"]*)"', series), [f"strap.{k:04d}.vtp" for k in (0, 5, 10, 12)])
        self.assertEqual([float(t) for t in re.findall(r'timestep="([^"]*)"', series)], [0, 5 / 60, 10 / 60, 12 / 60])
        leftovers = [p for p in run.rglob("*") if ".part" in p.name or p.name.startswith(".fascicle")]
        self.assertEqual(leftovers, [])

    def test_one_form_becomes_another_and_keeps_its_numbers(self):
        run = self.simulate("--export", "vtp")
        glb, usda, objs, again = (self.folder / name for name in ("a.glb", "b.usda", "c", "d"))
        self.check_done("export", run, "--out", glb)
        self.check_done("export", glb, "--out", usda)
        self.check_done("export", usda, "--as", "obj", "--out", objs)
        [first] = objs.glob("*_0000.obj")
        text = first.read_text()
        self.assertIn("# 1 unit = 1000 mm", text)
        self.assertIn("# up y", text)
        self.check_done("export", first, "--as", "mdd", "--out", again, "--frames", "0:12:4")
        with open(again / "strap.mdd", "rb") as file:
            frames, points = struct.unpack(">ii", file.read(8))
            times = struct.unpack(f">{frames}f", file.read(4 * frames))
            values = struct.unpack(f">{frames * points * 3}f", file.read())
        self.assertEqual(frames, 4)
        for time, wanted in zip(times, (0, 4 / 60, 8 / 60, 12 / 60)):
            self.assertAlmostEqual(time, wanted, places=6)
        wanted = vtp_points(run / "frames" / "strap.0008.vtp")
        self.assertEqual(points, len(wanted))
        for i, point in enumerate(wanted):
            for a, b in zip(values[3 * (2 * points + i):], in_metres(point)):
                self.assertAlmostEqual(a, b, delta=2e-8)
        info = self.check_done("info", glb)
        self.assertIn("glTF 2.0", info)
        self.assertIn("first of 13 frames", info)

    def test_wrong_command_lines_and_what_cannot_be_written(self):
        self.check_error(2, ["--export", "'glp'", "did you mean 'glb'?", "usda", "vtp"], "simulate", *self.source, "--export",
                         "vtp,glp", "--out", "x")
        self.assertFalse((self.folder / "x").exists())
        self.check_error(2, ["--morph-targets"], "simulate", *self.source, "--morph-targets", "0", "--out", "x")
        self.check_error(2, ["--as"], "export", "run", "--out", "x")
        self.check_error(2, ["did you mean 'pc2'?"], "export", "run", "--as", "pc3", "--out", "x")
        self.check_error(2, ["fascicle render"], "export", "run", "--as", "gif", "--out", "x.gif")
        self.check_error(1, ["nothing.glb"], "export", "nothing.glb", "--out", "x.usda")
        run = self.simulate("--export", "vtp")
        self.check_error(2, ["needs a run"], "export", self.folder / "input" / "strap.obj", "--as", "metrics", "--out", "x")
        self.check_error(2, ["100"], "export", run, "--out", "x.glb", "--frames", "100:200")
        glb = self.folder / "a.glb"
        self.check_done("export", run, "--out", glb)
        before = glb.read_bytes()
        self.check_error(2, ["another name"], "export", glb, "--out", glb)
        self.assertEqual(glb.read_bytes(), before)
        glb.write_bytes(before[:len(before) // 2])
        self.check_error(1, ["a.glb", "byte"], "export", glb, "--out", "x.usda")
        self.assertFalse((self.folder / "x.usda").exists())


if __name__ == "__main__":
    unittest.main()
