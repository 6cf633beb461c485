#!/usr/bin/env python3
"""Runs the published program's scenarios with the methods classic and xpbd and prints the tables of docs/classic.md.

    tools/classic_table.py --fascicle build/release/bin/fascicle --data ../shared/data --out out/classic

Needs the LHDL data (not part of the project). The reference rows are what the public program prints on the authors'
data, measured once without its viewer (docs/classic.md says how). Runs that are already in --out are read, not repeated.
"""
import argparse
import csv
import json
import math
import pathlib
import struct
import subprocess
import sys

# V/V0, mean edge, p99 edge, mean unsigned dihedral change (deg), mean displacement (mm); frames 50, 100, 200, 300.
FRAMES = (50, 100, 200, 300)
CASES = {
    "gluteus_maximus": ("gluteus maximus", "1218/326", (
        (.9959, 1.045, 1.46, 2.7, 15.9), (.9888, 1.105, 2.03, 4.3, 29.0),
        (1.0003, 1.005, 1.09, 1.9, 2.3), (1.0001, 1.003, 1.04, 1.2, 0.6))),
    "gluteus_maximus_fibres": ("gluteus maximus, fibres", "1218/326", (
        (.9979, 1.037, 1.46, 2.4, 13.7), (.9922, 1.095, 1.98, 3.7, 28.8),
        (1.0001, 1.007, 1.27, 1.9, 4.5), (1.0000, 1.004, 1.12, 1.4, 1.1))),
    "iliacus": ("iliacus", "3685/180", (
        (.9975, 1.019, 1.29, 2.8, 3.4), (.9956, 1.129, 4.32, 5.2, 6.9),
        (1.0052, 1.190, 8.85, 3.8, 1.4), (1.0047, 1.189, 9.10, 4.0, 1.4))),
    "squish_box": ("box between plates", "0/0", (
        (.9890, 1.011, 1.27, 13.1, None), (.3240, 1.205, 2.57, 22.8, None),
        (1.0016, .997, 1.18, 5.5, 8.7), (.9999, .996, 1.09, 2.7, 13.3))),
}
# Vertices inside pelvis + femur (winding number above 1/2), where they were counted.
INSIDE = {"iliacus": {100: "7+33", 200: "20+56", 300: "20+50"},
          "gluteus_maximus": {100: "7+2", 200: "7+2", 300: "7+2"}}
COLUMNS = ("volume_ratio", "edge_extension_mean", "edge_extension_p99", "dihedral_change_unsigned_mean_deg",
           "displacement_mean_mm")


def run(command):
    result = subprocess.run([str(part) for part in command], check=False)
    if result.returncode != 0:
        sys.exit(f"classic_table.py: exit code {result.returncode} from: {' '.join(map(str, command))}")


def read_obj(path):
    """Points as texts and triangles (from 0) of a triangle OBJ."""
    points, triangles = [], []
    for line in path.read_text().splitlines():
        word = line.split()
        if word[:1] == ["v"]:
            points.append(" ".join(word[1:4]))
        elif word[:1] == ["f"]:
            triangles.append([int(corner.split("/")[0]) - 1 for corner in word[1:]])
    return points, triangles


def read_vtk(path):
    """The same of legacy polydata, BINARY, version 3: POINTS n float, POLYGONS n size, big-endian."""
    data = path.read_bytes()

    def block(keyword, code, count_of):
        start = data.index(b"\n" + keyword + b" ") + 1
        end = data.index(b"\n", start)
        count = count_of([int(word) for word in data[start:end].split() if word.isdigit()])
        return struct.unpack_from(f">{count}{code}", data, end + 1)

    floats = block(b"POINTS", "f", lambda numbers: 3 * numbers[0])
    cells = block(b"POLYGONS", "i", lambda numbers: numbers[1])
    if any(size != 3 for size in cells[::4]):
        sys.exit(f"classic_table.py: {path}: expected triangles only")
    points = [" ".join(f"{c:.9g}" for c in floats[i:i + 3]) for i in range(0, len(floats), 3)]
    return points, [cells[i + 1:i + 4] for i in range(0, len(cells), 4)]


def program_pelvis(lhdl, out):
    """The program's pelvis held the sacrum (its voxels were 2.6 mm deep): both meshes in one OBJ."""
    joined = out / "pelvis.obj"
    if not joined.exists():
        points, triangles = read_obj(lhdl / "pelvis.obj")
        sacrum_points, sacrum_triangles = read_vtk(lhdl / "sacrum.vtk")
        triangles += [[corner + len(points) for corner in triangle] for triangle in sacrum_triangles]
        lines = ["v " + point for point in points + sacrum_points]
        lines += ["f " + " ".join(str(corner + 1) for corner in triangle) for triangle in triangles]
        joined.write_text("\n".join(lines) + "\n")
    return joined


def arguments(case, args, pelvis):
    lhdl = args.data / "lhdl"
    if case == "squish_box":
        return ["--scene", "squish-box"]
    muscle = "iliacus" if case == "iliacus" else "gluteus_maximus"
    command = ["--muscle", lhdl / f"{muscle}.vtk", "--bone", pelvis, "--moving-bone", lhdl / "femur.vtk",
               "--hinge", "146,238,-431;1,0,0", "--angle-deg", repr(-math.degrees(1.0)), "--phases", "100,100,100"]
    if case == "gluteus_maximus_fibres":
        command += ["--surface-fibres", f"{muscle}={lhdl / 'gluteus_maximus_surface_fibres.vtk'}"]
    return command


def simulate(case, method, args, pelvis):
    """Runs unless the folder is there; returns rows by frame and the summary. xpbd runs with its own defaults."""
    kind, *equations = method.split(":")
    folder = args.out / f"{case}_{method.replace(':', '_')}"
    if not (folder / "summary.json").exists():
        command = [args.fascicle, "simulate", *arguments(case, args, pelvis), "--method", kind, "--export", "csv",
                   "--quiet", "--out", folder]
        for value in equations:
            command += ["--set", f"classic.equations={value}"]
        run(command)
    with open(folder / "metrics.csv", newline="") as file:
        rows = {int(row["frame"]): row for row in csv.DictReader(file)}
    return rows, json.loads((folder / "summary.json").read_text())


def number(value, digits):
    return "-" if value is None or value == "" else f"{float(value):.{digits}f}"


def row_text(source, frame, values, inside):
    digits = (4, 3, 2, 1, 1)
    cells = [number(v, d) for v, d in zip(values, digits)]
    return f"| {source} | {frame} | " + " | ".join(cells) + f" | {inside} |"


def fixed_text(summary):
    counts = {a["bone"]: a["vertices"] for a in summary["muscles"][0]["attachments"]}
    return "/".join(str(counts.get(bone["name"], 0)) for bone in summary["bones"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fascicle", type=pathlib.Path, default=pathlib.Path("build/release/bin/fascicle"))
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path("../shared/data"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/classic"))
    parser.add_argument("--methods", default="classic,classic:meant,xpbd", help="comma-separated columns")
    parser.add_argument("--cases", default=",".join(CASES), help="comma-separated: " + ", ".join(CASES))
    args = parser.parse_args()
    if not (args.data / "lhdl").is_dir():
        sys.exit(f"classic_table.py: {args.data / 'lhdl'}: no such folder, expected the LHDL data")
    args.out.mkdir(parents=True, exist_ok=True)
    pelvis = program_pelvis(args.data / "lhdl", args.out)
    for case in args.cases.split(","):
        if case not in CASES:
            sys.exit(f"classic_table.py: no case '{case}', expected one of {', '.join(CASES)}")
        title, fixed, reference = CASES[case]
        runs = {method: simulate(case, method, args, pelvis) for method in args.methods.split(",")}
        seen = ", ".join(f"{method} {fixed_text(summary)}" for method, (_, summary) in runs.items())
        print(f"\n**{title}** (fixed or attached vertices: program {fixed}, {seen}; seconds of solving: "
              + ", ".join(f"{method} {summary['solve_seconds']:.1f}" for method, (_, summary) in runs.items()) + ")\n")
        print("| source | frame | V/V0 | mean edge | p99 edge | dihedral change, deg | displacement | inside bone |")
        print("| --- | --- | --- | --- | --- | --- | --- | --- |")
        for frame, values in zip(FRAMES, reference):
            print(row_text("program", frame, values, INSIDE.get(case, {}).get(frame, "-")))
            for method, (rows, _) in runs.items():
                row = rows[frame]
                print(row_text(method, frame, [row[c] for c in COLUMNS], row["penetrating_vertices"]))


if __name__ == "__main__":
    main()
