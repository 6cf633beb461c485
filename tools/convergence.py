#!/usr/bin/env python3
"""Runs real muscles with few and many substeps, with and without the coarse correction, and prints the tables of
docs/convergence.md: how far the shapes are from the settled ones, and how long they took.

    tools/convergence.py --fascicle build/release/bin/fascicle --data ../shared/data --out out/convergence

Needs the LHDL data (not part of the project). Runs that are already in --out are read, not repeated; delete a folder to
run it again. The settled shapes are those of the plain solver with --settled substeps (200 takes some minutes a muscle).
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

FRAMES = (50, 100)
MUSCLES = ("iliacus", "gluteus_maximus")


def simulate(args, muscle, substeps, clusters, kernel, back=0):
    """Folder of the run; makes it when it is not there."""
    folder = args.out / f"{muscle}_{kernel}_n{substeps}_c{clusters}_b{back}"
    summary = folder / "summary.json"
    if summary.exists() and json.loads(summary.read_text())["state"] == "finished":
        return folder
    lhdl = args.data / "lhdl"
    command = [args.fascicle, "simulate", "--muscle", lhdl / f"{muscle}.vtk", "--bone", lhdl / "pelvis.obj",
               "--moving-bone", lhdl / "femur.vtk", "--attachments", f"{muscle}={lhdl / (muscle + '_attachments.csv')}",
               "--hinge", "143.86,243.37,-432.53;1,0,0", "--angle-deg", repr(-math.degrees(1.0)),
               "--phases", f"100,{back},{back}", "--iterations", substeps, "--set", f"solver.coarse={clusters}",
               "--set", f"solver.kernel={kernel}", "--export", "vtp,csv", "--every", 50, "--quiet", "--out", folder]
    result = subprocess.run([str(part) for part in command], check=False, stdout=subprocess.DEVNULL)
    if result.returncode != 0:
        sys.exit(f"convergence.py: exit code {result.returncode} from: {' '.join(map(str, command))}")
    return folder


def points(folder, muscle, frame):
    """Positions of a frame file (ascii VTP): x, y, z of every vertex in one list."""
    text = (folder / "frames" / f"{muscle}.{frame:04d}.vtp").read_text()
    block = text[text.index("<Points>"):text.index("</Points>")]
    return [float(word) for word in block[block.index(">", block.index("<DataArray")) + 1:].split("<")[0].split()]


def distance(a, b):
    """rms and largest distance of vertices."""
    squares = [sum((a[i + k] - b[i + k]) ** 2 for k in range(3)) for i in range(0, len(a), 3)]
    return math.sqrt(sum(squares) / len(squares)), math.sqrt(max(squares))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fascicle", type=pathlib.Path, default=pathlib.Path("build/release/bin/fascicle"))
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path("../shared/data"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/convergence"))
    parser.add_argument("--settled", type=int, default=200, help="substeps of the settled shape (200 at most)")
    parser.add_argument("--substeps", default="3,10", help="comma-separated")
    parser.add_argument("--clusters", default="0,100,200", help="values of solver.coarse, comma-separated; 0 is off")
    parser.add_argument("--kernel", default="fast", choices=("fast", "reference"), help="of the rows; settled: reference")
    parser.add_argument("--muscles", default=",".join(MUSCLES), help="comma-separated")
    args = parser.parse_args()
    if not (args.data / "lhdl").is_dir():
        sys.exit(f"convergence.py: {args.data / 'lhdl'}: no such folder")
    args.out.mkdir(parents=True, exist_ok=True)
    print("| muscle | substeps | clusters | rms, largest frame 50 | frame 100 | volume error | edge p99 | frames/s |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for muscle in args.muscles.split(","):
        settled = simulate(args, muscle, args.settled, 0, "reference")
        shapes = {frame: points(settled, muscle, frame) for frame in FRAMES}
        for substeps in args.substeps.split(","):
            for clusters in args.clusters.split(","):
                folder = simulate(args, muscle, substeps, clusters, args.kernel)
                with open(folder / "metrics.csv", newline="") as file:
                    rows = {int(row["frame"]): row for row in csv.DictReader(file)}
                errors = [distance(points(folder, muscle, frame), shapes[frame]) for frame in FRAMES]
                summary = json.loads((folder / "summary.json").read_text())
                seconds = summary["solve_seconds"]
                volume = max(abs(float(row["volume_ratio"]) - 1) for row in rows.values())
                print(f"| {muscle} | {substeps} | {clusters} | "
                      + " | ".join(f"{rms:.3f}, {largest:.2f}" for rms, largest in errors)
                      + f" | {100 * volume:.4f} % | {float(rows[100]['edge_extension_p99']):.3f}"
                      + f" | {100 / seconds:.0f} |", flush=True)


if __name__ == "__main__":
    main()
