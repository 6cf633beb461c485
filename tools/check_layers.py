#!/usr/bin/env python3
"""Checks who includes whom. Exit 0 when every include is allowed, 1 with one line per offence.

The table is the law of docs/architecture.md: a module may include itself and the modules named in its row.
"""
import re
import sys
from pathlib import Path

CORE = ["base", "geometry", "motion", "solver", "anatomy", "scene"]
ALLOWED = {
    "base": [],
    "geometry": ["base"],
    "motion": ["base"],
    "solver": ["base", "geometry"],
    "anatomy": ["base", "geometry", "motion"],
    "scene": ["base", "geometry", "motion", "anatomy", "solver/parameters.hpp"],
    "simulation": CORE,
    "metrics": ["base", "geometry", "motion", "anatomy", "scene", "solver/parameters.hpp"],
    "io": ["base", "geometry", "motion", "anatomy", "scene", "metrics", "solver/parameters.hpp"],
    "document": ["base", "geometry", "motion", "anatomy", "scene", "io", "solver/parameters.hpp"],
    "bench": CORE + ["simulation", "metrics", "io"],
    "study": CORE + ["simulation", "metrics"],
    "render": ["base"],
    "view": ["base", "geometry", "motion", "anatomy", "scene", "metrics", "render", "solver/parameters.hpp"],
    "output": ["base", "geometry", "motion", "anatomy", "scene", "io", "metrics", "view", "render", "solver/parameters.hpp"],
    "reproduce": CORE + ["simulation", "metrics", "io", "view", "render", "output"],
    "editor": ["base", "geometry", "motion", "anatomy", "scene", "document", "io", "simulation", "metrics",
               "view", "render", "output", "study", "solver/parameters.hpp"],
    "app": None,  # wiring: everything
}
# Libraries that may appear only in some modules.
ONLY_IN = [
    (re.compile(r"^(GLFW/|GL/)"), {"render", "editor", "app"}),
    (re.compile(r"^(imgui|misc/cpp/imgui)"), {"render", "editor", "app"}),
    (re.compile(r"^glm/"), {"view", "render", "editor", "app"}),
    (re.compile(r"^nlohmann/"), {"io", "document", "bench", "reproduce", "app"}),
    (re.compile(r"^tbb/"), {"base"}),
    (re.compile(r"^(Bullet[A-Z]\w*/|LinearMath/|bt[A-Z])"), {"bench"}),
    (re.compile(r"^CLI/"), {"app"}),
    (re.compile(r"^pugixml"), {"io"}),
    (re.compile(r"^gif_lib"), {"io"}),
    (re.compile(r"^(tiny_obj_loader|stb_)"), {"io", "render"}),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def module_of(path, root):
    parts = path.relative_to(root).parts
    return parts[2] if parts[0] == "include" else parts[1]


def check_file(path, root):
    module = module_of(path, root)
    allowed = ALLOWED.get(module, [])
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        target = match.group(2)
        place = f"{path.relative_to(root)}:{number}"
        for pattern, modules in ONLY_IN:
            if pattern.match(target) and module not in modules:
                yield f"{place}: {module} must not include {target}; only {', '.join(sorted(modules))} may"
        name = target.removeprefix("fascicle/")
        other = name.split("/")[0]
        if "/" not in name or other not in ALLOWED or other == module or allowed is None:
            continue
        if other not in allowed and name not in allowed:
            yield f"{place}: {module} must not include {target}"
        if target == name and name.count("/") >= 1 and other != module and other not in ("render", "view", "output", "editor"):
            yield f"{place}: private header {target} of another module"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    files = [f for top in ("include/fascicle", "src") for f in sorted((root / top).rglob("*"))
             if f.suffix in (".hpp", ".cpp", ".inl")]
    offences = [o for f in files for o in check_file(f, root)]
    unknown = sorted({module_of(f, root) for f in files if len(f.relative_to(root).parts) > 2} - set(ALLOWED))
    offences += [f"module {m} is not in the layer table" for m in unknown]
    print("\n".join(offences) if offences else f"layers ok: {len(files)} files")
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
