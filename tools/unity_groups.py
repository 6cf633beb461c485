#!/usr/bin/env python3
"""Which sources CMake may compile as one: groups of neighbours in which no name of an anonymous namespace occurs twice.

  tools/unity_groups.py FILE...     prints "FILE<tab>GROUP" a line; a file alone in its group is left out
  tools/unity_groups.py --check     whether it still finds the names that clang-format leaves at the beginning of a line

Run when the build is configured (FASCICLE_UNITY): most of what a file costs is reading headers, which a group reads once."""
import re
import sys
import tempfile
from pathlib import Path

MOST_FILES, MOST_BYTES = 10, 60_000  # a group: enough to save, small enough for many cores

# One of a single line has no comment at its end.
ANONYMOUS = re.compile(r"^namespace \{\n([^\n]*\n(?=\}$)|.*?^(?=\} // namespace$))", re.S | re.M)
# What stands at the beginning of a line of such a namespace, as clang-format leaves it: a type, a function or a constant.
TYPE = re.compile(r"^(?:struct|class|enum(?: class)?|using|namespace)\s+(\w+)")
OTHER = re.compile(r"^[A-Za-z_][\w:<>,&*\s\[\]()]*?[\s&*]([A-Za-z_]\w*)\s*(?:\(|=|\{|\[|;)")


def names_of(text):
    """Names that a file declares for itself, and macros."""
    names = set(re.findall(r"^#define\s+(\w+)", text, re.M))
    for block in ANONYMOUS.findall(text):
        for line in block.splitlines():
            found = TYPE.match(line) or OTHER.match(line)
            if found:
                names.add(found.group(1))
    names.update(re.findall(r"^(?:static|using) (?:constexpr |const )?(?:namespace )?(\w+) =", text, re.M))
    return names


def calls_of(text):
    """Names that are called as they stand: they may mean something of a header that the name in another file would hide or rival."""
    return set(re.findall(r"(?<![\w.>:])([A-Za-z_]\w*)\s*\(", text))


def groups(files):
    """Neighbours together as long as they fit and agree; a later file may fill an earlier group of its folder. Files that open other
    namespaces to themselves do not agree: what is found there would be found twice."""
    made = []
    for file in files:
        text = Path(file).read_text(encoding="utf-8")
        names, calls = names_of(text), calls_of(text)
        kin = (Path(file).parent, frozenset(re.findall(r"^using namespace .*", text, re.M)))
        for group in made:
            if (group["kin"] == kin and len(group["files"]) < MOST_FILES
                    and group["bytes"] + len(text) <= MOST_BYTES and not group["names"] & (names | calls)
                    and not group["calls"] & names):
                break
        else:
            group = {"kin": kin, "files": [], "names": set(), "calls": set(), "bytes": 0}
            made.append(group)
        group["files"].append(file)
        group["names"] |= names
        group["calls"] |= calls
        group["bytes"] += len(text)
    return [group["files"] for group in made]


def check():
    text = """#define LIMIT 3
using namespace fascicle;
namespace fascicle {
namespace {
constexpr const char* popup_name = "Load";
}
namespace {

struct Panel {
    int inner = 0;
};
template <class F>
std::vector<std::string> texts_of(const F& f,
                                  int more) {
    int local = helper(f) + f.member() + other::scoped(1);
}
const Vec3 up{0, 0, 1};
using Clock = std::chrono::steady_clock;
enum class Mode { one };
double table[3];

} // namespace
int outside() { return 1; }
"""
    names = {"LIMIT", "popup_name", "Panel", "texts_of", "up", "Clock", "Mode", "table"}
    assert names_of(text) == names, names_of(text) ^ names
    calls = calls_of(text)
    assert "helper" in calls and not calls & {"member", "scoped"}, calls
    with tempfile.TemporaryDirectory() as folder:
        def file(name, body):
            path = Path(folder) / name
            path.write_text(body)
            return str(path)
        own = [file(f"{c}.cpp", f"namespace {{\nint f_{c}() {{\n    return 1;\n}}\n}} // namespace\n") for c in "abc"]
        twice = file("d.cpp", "namespace {\nint f_a = 2;\n}\n")
        caller = file("e.cpp", "int g() {\n    return f_b();\n}\n")  # of a header, it may be
        opened = file("f.cpp", "using namespace std;\n")
        made = groups([*own, twice, caller, opened])
        assert made == [own, [twice, caller], [opened]], made


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        check()
        sys.exit(0)
    for number, files in enumerate(groups(sys.argv[1:])):
        for file in files if len(files) > 1 else []:
            print(f"{file}\t{number}")
