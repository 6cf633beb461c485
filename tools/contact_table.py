#!/usr/bin/env python3
"""Runs muscles among moving bones and prints a table of how well contact held: what is inside a bone, whether the muscle
kept its volume, how far it was stretched, and whether it came back to rest.

    tools/contact_table.py --fascicle build/release/bin/fascicle --data ../shared/data --out out/contact

Needs the LHDL data (not part of the project) but for the cases squish_box and hip. Runs that are already in --out are read,
not repeated; delete a folder to run it again. Figures outside of the limits (see `limits` below) stand in asterisks and are
listed at the end; the exit code is then 1, unless --no-limits is given. A '-' is a figure that the program does not write.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

FITTED, PUBLISHED = "143.86,243.37,-432.53", "146,238,-431"
MUSCLES = ("iliacus", "gluteus_maximus")
FRAMES = 300
# Of one case and muscle: name, heading, digits. The name is also that of its limit.
COLUMNS = (("vertices", "vertices inside", 0), ("centroids", "centroids inside", 0), ("centroid_mm", "deepest centroid mm", 3),
           ("muscle_overlap_mm", "muscles overlap mm", 3), ("volume", "volume error", 5), ("p99", "edge p99", 3),
           ("end_rms", "end rms mm", 3), ("end_largest", "end largest mm", 2), ("contact_share", "contact share", 2))


def limits(case, muscle, substeps):
    """Largest value allowed, by column: in every case nothing inside of bones; stretch and the way back where the bones
    stay apart and turn as slowly as people do."""
    table = {"vertices": 0, "centroid_mm": 0.3 if case.endswith(("_fast", "_120")) else 0.1}
    if case == "squish_box":
        return {**table, "end_rms": 0.5}
    table.update({"muscle_overlap_mm": 0.3, "volume": 0.001})
    if case in (*MUSCLES, *(f"{m}_auto" for m in MUSCLES), "both", "hip"):
        table.update({"p99": 1.2 if muscle == "iliacus" else 1.6, "end_rms": 0.1 if substeps >= 10 else 0.5, "end_largest": 2.0})
    return table


# Motions. Each is for 300 frames; others are scaled to args.frames, but for those that are fast on purpose.

def phases(args, out, back):
    """--phases: out and back as they are for 300 frames, or scaled."""
    out, back = (max(1, round(n * args.frames / FRAMES)) for n in (out, back))
    return [out, back, max(0, args.frames - out - back)]


def fast_phases(args, count):
    return [count, count, max(0, args.frames - 2 * count)]


def hinge(numbers, centre=FITTED, degrees=-57.29578):
    return ["--hinge", f"{centre};1,0,0", "--angle-deg", repr(degrees), "--phases", ",".join(map(str, numbers))]


def write_motion(args, name, header, rows):
    folder = args.out / "motions"
    folder.mkdir(exist_ok=True)
    path = folder / f"{name}_{args.frames}.csv"
    path.write_text(header + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
    return ["--motion", path]


def turns(args, name, angles):
    """Motion of the femur: angles(share of the motion) -> flexion, abduction in degrees. The leg is a right one, LPS."""
    rows = []
    for frame in range(1, args.frames + 1):
        flexion, abduction = angles(frame / args.frames)
        rows += [[frame, "femur", FITTED, "1,0,0", repr(-flexion)], [frame, "femur", FITTED, "0,1,0", repr(abduction)]]
    return write_motion(args, name, "frame,bone,cx,cy,cz,ax,ay,az,angle_deg", rows)


def between(share, keys):
    """Linear between (share, value) keys."""
    for (a, from_value), (b, to_value) in zip(keys, keys[1:]):
        if share <= b:
            return from_value + (to_value - from_value) * (share - a) / (b - a)
    return keys[-1][1]


def abduction(share):
    """30 degrees out, back, 15 degrees in, back, rest."""
    return 0.0, between(share, ((0, 0), (0.25, 30), (0.5, 0), (0.625, -15), (0.75, 0)))


def circumduction(share):
    """Flexed by 40 degrees, once around a cone of 20 degrees, back, rest."""
    size = 20 * between(share, ((0, 0), (1 / 6, 1), (2 / 3, 1), (5 / 6, 0)))
    round_angle = 2 * math.pi * between(share, ((0, 0), (1 / 6, 0), (2 / 3, 1)))
    return size * (1 + math.cos(round_angle)), size * math.sin(round_angle)


def embedded(args, name, key):
    """An embedded scene; its own motion has 300 frames, a shorter one is written as a table of `key` rows."""
    if args.frames == FRAMES:
        return ["--scene", name]
    out, back, _ = phases(args, 100, 100)
    header, row, rest = key
    rows = [[out, *row], [out + back, *rest]] + ([[args.frames, *rest]] if args.frames > out + back else [])
    return ["--scene", name, *write_motion(args, name, header, rows)]


PLATE = ("frame,bone," + ",".join(f"m{i}{j}" for i in range(3) for j in range(4)),
         ["plate_top", "1,0,0,0,0,1,0,-90,0,0,1,0"], ["plate_top", "1,0,0,0,0,1,0,0,0,0,1,0"])
LEG = ("frame,bone,cx,cy,cz,ax,ay,az,angle_deg", ["femur", "0,0,0,1,0,0,-57.29577951308232"],
       ["femur", "0,0,0,1,0,0,0"])


def meshes(args, muscles, motion, outlines=True):
    lhdl = args.data / "lhdl"
    options = ["--bone", lhdl / "pelvis.obj", "--moving-bone", lhdl / "femur.vtk", *motion]
    for muscle in muscles:
        options += ["--muscle", lhdl / f"{muscle}.vtk"]
        if outlines:
            options += ["--attachments", f"{muscle}={lhdl / (muscle + '_attachments.csv')}"]
    return options


def cases(args):
    """Name -> what to add to `fascicle simulate`."""
    table = {}
    for muscle in MUSCLES:
        plain = hinge(phases(args, 100, 100))
        published = hinge(phases(args, 100, 100), PUBLISHED)
        for name, motion, outlines in (
                ("", plain, True), ("_auto", plain, False),
                ("_published", published, True), ("_published_auto", published, False),
                ("_fast", hinge(fast_phases(args, 10)), True),
                ("_120", hinge(phases(args, 100, 100), degrees=-120), True),
                ("_120_fast", hinge(fast_phases(args, 21), degrees=-120), True),
                ("_abduction", turns(args, "abduction", abduction), True),
                ("_circumduction", turns(args, "circumduction", circumduction), True)):
            table[muscle + name] = meshes(args, [muscle], motion, outlines)
    table["both"] = meshes(args, MUSCLES, hinge(phases(args, 100, 100)))
    table["squish_box"] = embedded(args, "squish-box", PLATE)
    table["hip"] = embedded(args, "hip", LEG)
    return table


def simulate(args, case, options, substeps):
    """Folder of the run; makes it when it is not there."""
    folder = args.out / f"{case}_n{substeps}_f{args.frames}"
    summary = folder / "summary.json"
    if summary.exists() and json.loads(summary.read_text())["state"] == "finished":
        return folder
    command = [args.fascicle, "simulate", *options, "--iterations", substeps, "--export", "csv", "--quiet", "--out", folder]
    for value in args.set:
        command += ["--set", value]
    if args.threads:
        command += ["--threads", args.threads]
    result = subprocess.run([str(part) for part in command], check=False, stdout=subprocess.DEVNULL)
    if result.returncode != 0:
        sys.exit(f"contact_table.py: exit code {result.returncode} from: {' '.join(map(str, command))}")
    return folder


def figures(folder):
    """Muscle -> column -> value, None where the run does not tell. nan where a figure is not a number, so that no limit holds."""
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "metrics.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    stages = summary.get("stage_seconds", {})
    total, contact = sum(stages.values()), sum(s for name, s in stages.items() if name.startswith(("contact", "samples")))
    result = {}
    for muscle in dict.fromkeys(row["muscle"] for row in rows):
        mine = [row for row in rows if row["muscle"] == muscle]

        def worst(key, change=lambda x: x):
            if key not in mine[0]:
                return None
            values = [change(float(row[key])) for row in mine]
            return math.nan if any(math.isnan(x) for x in values) else max(values)

        result[muscle] = {
            "vertices": worst("penetrating_vertices"), "centroids": worst("penetrating_centroids"),
            "centroid_mm": worst("centroid_penetration_max_mm"), "muscle_overlap_mm": worst("muscle_overlap_mm"),
            "volume": worst("volume_ratio", lambda x: abs(x - 1)), "p99": worst("edge_extension_p99"),
            "end_rms": float(mine[-1]["displacement_rms_mm"]), "end_largest": float(mine[-1]["displacement_max_mm"]),
            "contact_share": contact / total if total > 0 else None}
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fascicle", type=pathlib.Path, default=pathlib.Path("build/release/bin/fascicle"))
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path("../shared/data"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/contact"))
    parser.add_argument("--cases", help="comma-separated; default: all. 'list' prints their names")
    parser.add_argument("--substeps", default="3,10", help="comma-separated")
    parser.add_argument("--frames", type=int, default=FRAMES, help="of a run; the limits are meant for 300")
    parser.add_argument("--threads", type=int, help="default: that of the program")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a parameter of every run; use an --out of its own")
    parser.add_argument("--no-limits", action="store_true", help="only print")
    args = parser.parse_args()
    if args.frames < 3:
        parser.error("--frames: expected 3 or more")
    args.out.mkdir(parents=True, exist_ok=True)
    table = cases(args)
    if args.cases == "list":
        sys.exit(print("\n".join(table)))
    wanted = args.cases.split(",") if args.cases else list(table)
    for case in wanted:
        if case not in table:
            parser.error(f"--cases: there is no case '{case}'; expected some of {', '.join(table)}")
        if "--scene" not in table[case] and not (args.data / "lhdl").is_dir():
            sys.exit(f"contact_table.py: {args.data / 'lhdl'}: no such folder, expected the LHDL data")
    print("| case | substeps | " + " | ".join(heading for _, heading, _ in COLUMNS) + " |")
    print("| --- " * (2 + len(COLUMNS)) + "|")
    broken = []
    for case in wanted:
        for substeps in map(int, args.substeps.split(",")):
            found = figures(simulate(args, case, table[case], substeps))
            for muscle, values in found.items():
                name = case if len(found) == 1 else f"{case}: {muscle}"
                allowed = {} if args.no_limits else limits(case, muscle, substeps)
                cells = []
                for key, heading, digits in COLUMNS:
                    value = values[key]
                    text = "-" if value is None else f"{value:.{digits}f}"
                    if value is not None and key in allowed and not value <= allowed[key]:
                        broken.append(f"{name}, {substeps} substeps: {heading} {text}, expected at most {allowed[key]}")
                        text = f"**{text}**"
                    cells.append(text)
                print(f"| {name} | {substeps} | " + " | ".join(cells) + " |", flush=True)
    for line in broken:
        print(f"contact_table.py: {line}", file=sys.stderr)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
