#!/usr/bin/env python3
"""Writes the tables of docs/reproduction.md from what `fascicle reproduce` left.

    fascicle reproduce --data ../shared/data --out out/paper
    tools/reproduction_tables.py out/paper [--doc docs/reproduction.md] [--check]

Each table stands between <!-- table NAME --> and <!-- end -->. --check changes nothing and exits 1 when the document differs.
Standard library only.
"""
import argparse
import json
import math
import re
import sys
from pathlib import Path

DASH = "-"


def number(value, digits=3):
    """Significant digits without an exponent; a dash for what is not known."""
    if value is None:
        return DASH
    if value == 0:
        return "0"
    if abs(value) < 1e-4:
        return "<0.0001" if value > 0 else ">-0.0001"
    decimals = max(0, min(6, digits - 1 - math.floor(math.log10(abs(value)))))
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def move(value):
    """How far a number moved: with its sign, unless that is rounding."""
    if value is None or value == 0:
        return ""
    return f" ({number(abs(value)) if abs(value) < 1e-4 else ('+' if value > 0 else '') + number(value, 2)})"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def runs(results):
    for experiment in results["experiments"]:
        for run in experiment.get("runs", []):
            if "failed" not in run:
                yield experiment, run


def value(run, key, at):
    return run["metrics"].get(key, {}).get(at)


def methods_table(results):
    rows = []
    for experiment, run in runs(results):
        volume = run["metrics"]["volume_ratio"]
        off = 100 * max(abs(volume["least"] - 1), abs(volume["greatest"] - 1))
        degrees = 180 / math.pi
        dihedral = [degrees * v if v is not None else None
                    for v in (value(run, "dihedral_change_mean_rad", at) for at in ("flexed", "end"))]
        rows.append([experiment["key"], run["method"], str(run["frames"]), number(off),
                     number(value(run, "edge_extension_mean", "flexed"), 4), number(value(run, "edge_extension_p99", "flexed")),
                     number(value(run, "edge_extension_mean", "end"), 4), number(dihedral[0]), number(dihedral[1]),
                     number(value(run, "displacement_mean_mm", "end")), number(value(run, "penetrating_vertices", "greatest"))])
    return table(["experiment", "method", "frames", "volume off by at most, %", "mean edge at 100", "99th percentile at 100",
                  "mean edge at the end", "dihedral change at 100, deg", "at the end, deg", "displaced at the end, mm",
                  "most vertices in bone"], rows)


def findings_table(results):
    rows = [[finding["figure"] or DASH, experiment["key"], finding["verdict"], finding["text"]]
            for experiment in results["experiments"] for finding in experiment.get("findings", [])]
    return table(["figure", "experiment", "", "from the data"], rows)


def distances_table(results):
    rows = [[experiment["key"], run["method"], number(run["distance_to_reference_mm"]["mean"]),
             number(run["distance_to_reference_mm"]["max"])]
            for experiment, run in runs(results) if "distance_to_reference_mm" in run]
    if not rows:
        return "None: the method `fem` was not there."
    return table(["experiment", "method", "mean, mm", "greatest, mm"], rows)


def is_sweep(experiment):
    return experiment.get("motion") in ("hip adduction", "internal rotation")


def span(values):
    return [number(values["least"]), number(values["mean"]), number(values["greatest"])]


def ranges_table(results):
    """Beside Modenese & Kohout 2020, Table 2: over poses and fibres."""
    rows, models = [], []
    for experiment in results["experiments"]:
        shares = [share for share in experiment.get("moment_arms", []) if share.get("published_ranges")]
        for share in shares:
            models = [row["model"] for row in share["published_ranges"]]
            rows.append([experiment["key"], experiment["motion"], share["who"]] + span(share["poses_and_fibres_mm"]) +
                        [number(row["poses_inside_percent"]) for row in share["published_ranges"]])
        if shares and not experiment["key"].endswith("-chmd"):
            rows += [[experiment["key"], experiment["motion"], f"published: {row['model']}"] + span(row["arm_mm"]) + [DASH] * len(models)
                     for row in shares[0]["published_ranges"]]
    if not rows:
        return "None: no real data."
    return table(["experiment", "motion", "who", "least, mm", "mean, mm", "greatest, mm"] + [f"in {m}, %" for m in models], rows)


def arms_table(results):
    rows = [[experiment["key"], share["who"], number(share["poses_inside_percent"]), number(share["fibres_inside_percent"]),
             number(share["arm_mm"]["least"]), number(share["arm_mm"]["mean"]), number(share["arm_mm"]["greatest"])]
            for experiment in results["experiments"] if not is_sweep(experiment) for share in experiment.get("moment_arms", [])]
    return table(["experiment", "who", "poses inside, %", "poses and fibres inside, %", "least mean arm, mm", "mean, mm",
                  "greatest, mm"], rows)


def sensitivity_table(results):
    s = results["sensitivity"]
    if "left_out" in s:
        return f"Left out: {s['left_out']}."
    base = {v["variant"]: v for v in s["variants"]}
    rows = []
    for v in s["variants"]:
        cells = [v["variant"], v["held_against"], str(v["triangles"]), str(v["passes"])]
        if "failed" in v:
            rows.append(cells + [v["failed"]] + [DASH] * (len(s["quantities"]) - 1))
            continue
        for x, y in zip(v["values"], base[v["held_against"]]["values"]):
            moved = None if x is None or y is None else x - y
            cells.append(number(x, 5) + move(moved))
        rows.append(cells)
    return table(["variant", "held against", "triangles", "passes"] + s["quantities"], rows)


def dependences_table(results):
    s = results["sensitivity"]
    if "left_out" in s or not s["dependences"]:
        return "None."
    rows = [[f"`{d['parameter']}`", d["quantity"], d["variant"], number(d["effect"], 2), number(d["effect_at_base"], 2)]
            for d in s["dependences"]]
    return table(["parameter, lowered by a fifth", "quantity", "variant", "effect there", "effect at its base"], rows)


def speed_table(timings):
    published = {row["triangles"]: [number(row["paper_frames_per_second"], 4), number(row["public_program_frames_per_second"])]
                 for row in timings.get("published_speed", [])}
    rows = [[r["object"], r["method"], str(r["triangles"]), str(r["threads"]), str(r["passes"]), number(r["frames_per_second"])] +
            published.get(r["triangles"], [DASH, DASH]) for r in timings["speed"]]
    measured = {r["triangles"] for r in timings["speed"]}
    rows += [[f"{row['object']} (not here)", DASH, str(row["triangles"]), DASH, DASH, DASH] + published[row["triangles"]]
             for row in timings.get("published_speed", []) if row["triangles"] not in measured]
    text = table(["object", "method", "triangles", "threads", "passes", "frames/s", "paper", "public program"], rows)
    parts = [f"{c['method']} on {c['threads']} {'thread' if c['threads'] == 1 else 'threads'} {number(c['rho'])} ({c['objects']} objects)"
             for c in timings["rank_correlation"]]
    return text + "\n\nRank correlation (Spearman) of frames a second with triangles, -1 for the paper's five objects: " + "; ".join(parts) + "."


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="what `fascicle reproduce --out` wrote")
    parser.add_argument("--doc", type=Path, default=Path(__file__).resolve().parent.parent / "docs" / "reproduction.md")
    parser.add_argument("--check", action="store_true", help="change nothing; exit 1 when the document differs")
    options = parser.parse_args()
    results = json.loads((options.folder / "results.json").read_text(encoding="utf-8"))
    timings = json.loads((options.folder / "timings.json").read_text(encoding="utf-8"))
    if results["short"]:
        print(f"reproduction_tables: {options.folder} is a short form, no figures to keep", file=sys.stderr)
        return 1
    tables = {"methods": methods_table(results), "findings": findings_table(results), "distances": distances_table(results),
              "arms": arms_table(results), "ranges": ranges_table(results), "sensitivity": sensitivity_table(results),
              "dependences": dependences_table(results), "speed": speed_table(timings)}
    before = options.doc.read_text(encoding="utf-8")
    text = before
    for name, content in tables.items():
        pattern = re.compile(rf"(<!-- table {name} -->\n).*?(<!-- end -->)", re.DOTALL)
        if not pattern.search(text):
            print(f"reproduction_tables: {options.doc} has no table '{name}'", file=sys.stderr)
            return 1
        text = pattern.sub(lambda m: m.group(1) + content + "\n" + m.group(2), text)
    if options.check:
        print("same" if text == before else f"{options.doc} differs")
        return 0 if text == before else 1
    options.doc.write_text(text, encoding="utf-8")
    print(f"written to {options.doc}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
