#!/usr/bin/env python3
"""How a large scene goes: many muscles along a chain of bones, made here, then loaded, simulated and drawn by the real program.

    tools/load_scene.py --program build/release/src/app/fascicle                      1.5 million triangles, 10 frames
    tools/load_scene.py --program ... --triangles 100000 --muscles 4 --bones 3        a smaller one

Bones are ellipsoids with bumps, end to end with gaps of 4 mm; the second half of them turns about the middle gap. Muscles are
spindles that lie on two neighbouring bones, on four sides in turn. Prints seconds, seconds of a processor (several threads count each; other programs do not) and peak memory of every command. Python's
standard library only.
"""
import argparse
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BONE_RADIUS, BONE_HALF, GAP = 16.0, 48.0, 4.0
PITCH = 2 * BONE_HALF + GAP  # from the middle of a bone to that of the next, mm


def rings_for(triangles):
    """(rings, sides) of a round surface of about that many triangles: 2 * sides * (rings - 1)."""
    sides = max(6, round(math.sqrt(triangles / 4)))
    return max(4, round(triangles / (2 * sides)) + 1), sides


def write_round(path, triangles, point):
    """A closed surface as OBJ; point(t, a): place at t in (0, 1) from pole to pole and angle a."""
    rings, sides = rings_for(triangles)
    count = 0
    with open(path, "w", encoding="ascii") as out:
        rows = [0.0] + [(i + 0.5) / rings for i in range(rings)] + [1.0]
        for i, t in enumerate(rows):
            for j in range(1 if i in (0, rings + 1) else sides):
                out.write("v %.5f %.5f %.5f\n" % point(t, 2 * math.pi * j / sides))
        first, last = 1, 2 + rings * sides
        ring = lambda i, j: 2 + i * sides + j % sides
        for j in range(sides):
            out.write(f"f {first} {ring(0, j + 1)} {ring(0, j)}\nf {last} {ring(rings - 1, j)} {ring(rings - 1, j + 1)}\n")
            count += 2
        for i in range(rings - 1):
            for j in range(sides):
                a, b, c, d = ring(i, j), ring(i, j + 1), ring(i + 1, j), ring(i + 1, j + 1)
                out.write(f"f {a} {b} {d}\nf {a} {d} {c}\n")
                count += 2
    return count


def bone_radius(z):
    """Of the chain's bones without bumps at height z from the middle of one, 0 beyond its ends."""
    return BONE_RADIUS * math.sqrt(max(0.0, 1 - (z / BONE_HALF) ** 2))


def write_bone(path, triangles, number):
    def point(t, a):
        z, r = -BONE_HALF * math.cos(math.pi * t), BONE_RADIUS * math.sin(math.pi * t)
        r *= 1 + 0.02 * math.sin(5 * a + number) * math.sin(9 * math.pi * t)
        return r * math.cos(a), r * math.sin(a), z + number * PITCH
    return write_round(path, triangles, point)


def write_muscle(path, triangles, number, joint):
    """From the middle of bone `joint` to that of the next, 0.3 mm off their bumps at the ends."""
    side = math.pi / 2 * (number % 4)
    thick, half = 7.0, 0.5 * PITCH
    off = BONE_RADIUS * 1.02 + thick + 0.3

    def point(t, a):
        along = -half * math.cos(math.pi * t)
        r = thick * math.sin(math.pi * t) ** 0.5
        out, across = off + r * math.cos(a) - (thick - r), 0.8 * r * math.sin(a)
        x = out * math.cos(side) - across * math.sin(side)
        y = out * math.sin(side) + across * math.cos(side)
        return x, y, (joint + 0.5) * PITCH + along
    return write_round(path, triangles, point)


def write_scene(folder, muscles, bones, triangles):
    """Writes the meshes; returns the SOURCE options and the number of triangles."""
    folder.mkdir(parents=True, exist_ok=True)
    per_bone, per_muscle = int(0.68 * triangles / bones), int(0.32 * triangles / muscles)
    total, options = 0, []
    for b in range(bones):
        file = folder / f"bone_{b:02d}.obj"
        total += write_bone(file, per_bone, b)
        options += ["--bone" if b < bones // 2 else "--moving-bone", str(file)]
    for m in range(muscles):
        file = folder / f"muscle_{m:02d}.obj"
        total += write_muscle(file, per_muscle, m, (m * (bones - 1)) // muscles)
        options += ["--muscle", str(file)]
    centre = (bones // 2 - 0.5) * PITCH
    return options + ["--units", "mm", "--hinge", f"0,0,{centre};1,0,0", "--angle-deg", "5"], total


def run(name, command, limit_gb, environment):
    """One command with its memory bounded; prints and returns what it took."""
    def bound():
        import resource
        if limit_gb:
            size = int(limit_gb * (1 << 30))
            resource.setrlimit(resource.RLIMIT_AS, (size, size))

    start = time.time()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=bound,
                               env={**os.environ, **environment})
    output, errors = process.stdout.read(), process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    process.stdout.close()
    process.stderr.close()
    took = {"step": name, "seconds": round(time.time() - start, 2),
            "processor_seconds": round(usage.ru_utime + usage.ru_stime, 2), "peak_mb": round(usage.ru_maxrss / 1024, 1)}
    if process.returncode != 0:
        sys.exit(f"{name}: exit code {process.returncode}: {errors or output[-500:]}")
    print(f"{name:28} {took['seconds']:9.2f} s {took['processor_seconds']:9.2f} s of a processor {took['peak_mb']:9.0f} MB",
          flush=True)
    return took


def measure(program, folder, muscles=20, bones=12, triangles=1_500_000, frames=10, limit_gb=4.0, draws=True):
    """Everything: a list of {step, seconds, peak_mb}, and the summary of the run."""
    source, total = write_scene(folder / "scene", muscles, bones, triangles)
    print(f"{muscles} muscles, {bones} bones, {total} triangles, {frames} frames; at most {limit_gb} GB each", flush=True)
    cache = {"FASCICLE_CACHE": str(folder / "cache")}
    shutil.rmtree(folder / "cache", ignore_errors=True) # of an earlier time, with --keep
    meshes = [option for option in source if option.endswith(".obj")]
    simulate = [program, "simulate", *source, "--phases", f"{frames},0,0", "--export", "vtp", "--quiet", "--out"]
    steps = [run("info, every mesh", [program, "info", *meshes], limit_gb, cache),
             run("simulate, cache cold", [*simulate, str(folder / "run")], limit_gb, cache)]
    summary = json.loads((folder / "run" / "summary.json").read_text())
    print(f"    prepared in {summary['prepare_seconds']:.2f} s, {summary['fps_median']:.2f} frames/s", flush=True)
    steps.append(run("simulate, cache warm", [*simulate, str(folder / "run")], limit_gb, cache))
    if draws:
        picture = [program, "render", str(folder / "run"), "--frame", str(frames), "--size", "1280x800", "--quiet", "--out"]
        steps += [run("render, viewport", [*picture, str(folder / "view.png")], limit_gb, cache),
                  run("render, whole editor", [*picture, str(folder / "editor.png"), "--ui"], limit_gb, cache)]
    return steps, summary


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--program", required=True, help="the command line program, fascicle")
    options.add_argument("--muscles", type=int, default=20)
    options.add_argument("--bones", type=int, default=12)
    options.add_argument("--triangles", type=int, default=1_500_000)
    options.add_argument("--frames", type=int, default=10)
    options.add_argument("--limit-gb", type=float, default=4.0, help="address space of every command; 0: no limit")
    options.add_argument("--keep", metavar="DIR", help="leave everything there")
    given = options.parse_args()
    if given.muscles < 1 or given.bones < 2 or given.triangles < 1000 or given.frames < 1:
        options.error("at least 1 muscle, 2 bones, 1000 triangles and 1 frame")
    with tempfile.TemporaryDirectory(prefix="fascicle load ") as temporary:
        measure(given.program, Path(given.keep or temporary), given.muscles, given.bones, given.triangles, given.frames,
                given.limit_gb)


if __name__ == "__main__":
    main()
