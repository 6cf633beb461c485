#!/usr/bin/env python3
"""Checks what `fascicle reproduce` left: whole, readable without a network, no run failed, every figure told in a sentence.

    tools/check_report.py build/ci-report

Prints what it saw, or what is wrong and exits 1. tests/app/test_reproduce.py uses it, too. Standard library only.
"""
import base64
import csv
import json
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

ALWAYS = {"report.html", "results.json", "timings.json", "curves.csv"}
NAMESPACE = re.compile(r"\{.*\}")


def tag(element):
    return NAMESPACE.sub("", element.tag)


def text_of(element):
    return " ".join("".join(element.itertext()).split())


def check_page(page):
    """Faults of the page as lines of text, and the number of plots and pictures."""
    faults = []
    root = xml.fromstring(page.replace("<!DOCTYPE html>", ""))
    plots = pictures = 0
    for element in root.iter():
        for name, value in element.attrib.items():
            if NAMESPACE.sub("", name) in ("href", "src", "srcset", "action") and not value.startswith("data:image/png;base64,"):
                faults.append(f"refers to '{value[:60]}'")
        if tag(element) in ("script", "link", "iframe", "object"):
            faults.append(f"has a <{tag(element)}>")
        if tag(element) == "style" and re.search(r"url\(|@import", element.text or ""):
            faults.append("its style refers to other files")
        if tag(element) == "img":
            pictures += 1
            if not base64.b64decode(element.get("src").partition(",")[2]).startswith(b"\x89PNG\r\n\x1a\n"):
                faults.append(f"the picture '{element.get('alt')}' is no PNG")
        if tag(element) == "figure":
            kinds = [tag(child) for child in element]
            caption = text_of(element[-1]) if kinds and kinds[-1] == "figcaption" else ""
            if "svg" in kinds:
                plots += 1
                verdicts = [e for e in element[-1].iter() if (e.get("class") or "").startswith("verdict")]
                if not verdicts or not caption.endswith("."):
                    faults.append(f"the plot '{caption[:60]}' has no sentence from the data")
            elif not caption:
                faults.append("a picture has no caption")
    for words in (text for e in root.iter() if tag(e) not in ("style", "svg") for text in (e.text, e.tail) if text):
        if number := re.search(r"\b(nan|inf)\b|\d[eE][-+]?\d", words):
            faults.append(f"'{number.group(0)}' in '{' '.join(words.split())[:80]}'")
    return faults, plots, pictures


def figures_told(page):
    return {int(n) for group in re.findall(r"<b>Fig\. ([\d, ]+)</b>", page) for n in group.split(",")}


def check_results(results, names):
    faults = []
    done = [e for e in results["experiments"] if "left_out" not in e]
    if not done:
        faults.append("no experiment was run")
    for experiment in done:
        key, runs = experiment["key"], experiment["runs"]
        faults += [f"{key}, {run['method']}: {run['failed']}" for run in runs if "failed" in run]
        methods = [run["method"] for run in runs]
        if len(methods) > 1 and methods != results["methods"]:
            faults.append(f"{key}: ran {methods}, not {results['methods']}")
        for run in runs:
            if run.get("fibres") and f"fibre_lengths-{key}-{run['method']}.csv" not in names:
                faults.append(f"{key}, {run['method']}: no table of fibre lengths")
    failed = [v for v in results["sensitivity"].get("variants", []) if "failed" in v]
    return faults + [f"sensitivity, {v['variant']}: {v['failed']}" for v in failed]


def check_folder(folder):
    """Faults, and a line that says what is there."""
    folder = Path(folder)
    names = {path.name for path in folder.iterdir() if path.is_file()}
    if missing := sorted(ALWAYS - names):
        return [f"there is no {name}" for name in missing], ""
    results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    page = (folder / "report.html").read_text(encoding="utf-8")
    faults, plots, pictures = check_page(page)
    faults += check_results(results, names)
    done = [e for e in results["experiments"] if "left_out" not in e]
    wanted = {int(n) for e in done if "published" not in e["key"] for n in e["figures"].split(",") if n}
    if untold := sorted(wanted - figures_told(page)):
        faults.append(f"nothing is said of figures {untold}")
    for name in sorted(n for n in names if n.endswith(".csv")):
        with open(folder / name, newline="", encoding="utf-8") as lines:
            widths = {len(row) for row in csv.reader(lines)}
        if len(widths) != 1:
            faults.append(f"{name} has rows of {sorted(widths)} cells")
    runs = sum(len(e["runs"]) for e in done)
    return faults, (f"{len(done)} experiments, {runs} runs, {len(results['methods'])} methods, {plots} plots, {pictures} pictures, "
                    f"{len(page) / 1e6:.1f} MB, data: {results['data']}")


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    faults, summary = check_folder(sys.argv[1])
    for fault in faults:
        print(f"check_report: {sys.argv[1]}: {fault}", file=sys.stderr)
    if not faults:
        print(summary)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
