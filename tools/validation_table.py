#!/usr/bin/env python3
"""Runs hip muscles with fibres through a flexion and prints fibre lengths and moment arms beside published ones
(docs/validation.md).

    tools/validation_table.py --fascicle build/release/bin/fascicle --data ../shared/data --out out/validation

Needs the LHDL data (not part of the project). Runs that are already in --out are read, not repeated.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys

MUSCLES = ("iliacus", "gluteus_maximus")
ANGLES = (20, 40, 57)
# Modenese & Kohout 2020: ratio of fibre length to that at 0 degrees at 20, 40 and 58 degrees, (mean, min, max) over 100 fibres,
# from their published result files; rest length mean (sd), mm.
LENGTHS = {"iliacus": (182, 24, ((.94, .90, .96), (.87, .81, .93), (.83, .74, .90))),
           "gluteus_maximus": (220, 23, ((1.10, 1.06, 1.13), (1.19, 1.11, 1.24), (1.26, 1.15, 1.31)))}
# Flexion arms, mm, over -10 to 60 degrees: min, max, mean of 100 fibres, lines, and Blemker & Delp 2005 (their Table 2).
ARMS = {"iliacus": (("100 fibres", 13, 46, 30), ("lines", 26, 33, 31), ("Blemker & Delp 2005", 19, 51, 30)),
        "gluteus_maximus": (("100 fibres", -92, -19, -57), ("lines", -77, -29, -55), ("Blemker & Delp 2005", -72, -9, -42))}
# Literature bounds at 0, 20, 40 and 57 degrees, mm, as digitised by them; extension arms with a minus here.
BOUNDS = {"iliacus": ((0, 20.1, 31.5), (20, 19.1, 34.5), (40, 22.4, 43.0), (57, 26.2, 50.2)),
          "gluteus_maximus": ((0, -66.2, -9.4), (20, -71.2, -16.5), (40, -71.6, -17.3), (57, -68.9, -14.8))}


def simulate(args, muscle, method, tone):
    folder = args.out / f"{muscle}_{method}_tone{tone}"
    if not (folder / "summary.json").exists():
        lhdl = args.data / "lhdl"
        command = [args.fascicle, "simulate", "--muscle", lhdl / f"{muscle}.vtk", "--bone", lhdl / "pelvis.obj",
                   "--moving-bone", lhdl / "femur.vtk", "--attachments", f"{muscle}={lhdl / (muscle + '_attachments.csv')}",
                   "--hinge", "143.86,243.37,-432.53;1,0,0", "--angle-deg", repr(-math.degrees(1.0)),
                   "--phases", "100,100,100", "--set", f"fibres.method={method}", "--set", f"solver.tone={tone}",
                   "--quiet", "--out", folder]
        if method == "chmd":
            command += ["--surface-fibres", f"{muscle}={lhdl / (muscle + '_surface_fibres.vtk')}"]
        result = subprocess.run([str(part) for part in command], check=False, stdout=subprocess.DEVNULL)
        if result.returncode != 0:
            sys.exit(f"validation_table.py: exit code {result.returncode} from: {' '.join(map(str, command))}")
    with open(folder / "fibres.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    frames = {}
    for row in rows:
        frames.setdefault(int(row["frame"]), []).append((float(row["length_mm"]), float(row["moment_arm_mm"])))
    return frames


def mean(values):
    return sum(values) / len(values)


def frame_at(degrees):
    return round(100 * math.radians(degrees))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fascicle", type=pathlib.Path, default=pathlib.Path("build/release/bin/fascicle"))
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path("../shared/data"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/validation"))
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    runs = [(m, method, tone) for m in MUSCLES for method in ("kukacka", "streamlines", "chmd") for tone in (1, 0)
            if (method != "chmd" or m == "gluteus_maximus") and (tone == 1 or method == "kukacka")]
    results = {run: simulate(args, *run) for run in runs}
    print("| muscle | fibres | tone | rest length mm (sd) | ratio at 20 deg (min to max) | at 40 deg | at 57 deg |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for muscle in MUSCLES:
        for run in (r for r in runs if r[0] == muscle):
            frames = results[run]
            rest = [length for length, _ in frames[0]]
            sd = math.sqrt(sum((x - mean(rest)) ** 2 for x in rest) / (len(rest) - 1))
            cells = []
            for degrees in ANGLES:
                now = [length for length, _ in frames[frame_at(degrees)]]
                ratios = [a / b for a, b in zip(now, rest)]
                cells.append(f"{mean(now) / mean(rest):.2f} ({min(ratios):.2f} to {max(ratios):.2f})")
            print(f"| {muscle} | {run[1]} | {run[2]} | {mean(rest):.0f} ({sd:.0f}) | " + " | ".join(cells) + " |")
        length, sd, ratios = LENGTHS[muscle]
        print(f"| {muscle} | Modenese & Kohout 2020 | | {length} ({sd}) | " +
              " | ".join(f"{m:.2f} ({low:.2f} to {high:.2f})" for m, low, high in ratios) + " |")
    print()
    print("| muscle | fibres | tone | arm mm, mean over 0 to 57 deg | smallest to largest | at 0 deg | 20 | 40 | 57 |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    outside = []
    for muscle in MUSCLES:
        for run in (r for r in runs if r[0] == muscle):
            frames = results[run]
            means = [mean([arm for _, arm in frames[k]]) for k in range(1, 101)]
            every = [arm for k in range(1, 101) for _, arm in frames[k]]
            at = [means[max(0, min(99, frame_at(d) - 1))] for d in (0, *ANGLES)]
            print(f"| {muscle} | {run[1]} | {run[2]} | {mean(means):.1f} | {min(every):.0f} to {max(every):.0f} | " +
                  " | ".join(f"{a:.1f}" for a in at) + " |")
            low, high = min(a[1] for a in ARMS[muscle]), max(a[2] for a in ARMS[muscle])
            if not low <= mean(means) <= high:
                outside.append(f"{muscle}, {run[1]}, tone {run[2]}: mean arm {mean(means):.1f} mm outside of {low} to {high}")
            for (degrees, lower, upper), arm in zip(BOUNDS[muscle], at):
                if not lower <= arm <= upper:
                    outside.append(f"{muscle}, {run[1]}, tone {run[2]}: {arm:.1f} mm at {degrees} deg, literature {lower} to {upper}")
        for name, low, high, middle in ARMS[muscle]:
            print(f"| {muscle} | {name} | | {middle} | {low} to {high} | | | | |")
        print(f"| {muscle} | literature, digitised | | | | " + " | ".join(f"{low:.0f} to {high:.0f}" for _, low, high in BOUNDS[muscle]) + " |")
    print()
    for line in outside:
        print(f"outside: {line}")


if __name__ == "__main__":
    main()
