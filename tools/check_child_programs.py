#!/usr/bin/env python3
"""Checks that other programs are started with an argument vector, never through a shell, and only where it is meant.

Exit 0 when all is well, 1 with one line per offence. A name in a file that somebody else wrote must never be read by a shell.
"""
import re
import sys
from pathlib import Path

# Whatever reads a command line as text, and what searches the present folder or $PATH for us.
SHELLS = re.compile(r"(?<![\w.>])(?:std::|::)?(system|popen|wordexp|execl|execle|execlp|execvp|execvpe|posix_spawnp)\s*\(")
STARTS = re.compile(r"(?<![\w.>])(?:std::|::)?(posix_spawn|execv|execve|execveat|fexecve|fork|vfork|clone)\s*\(")
ALLOWED = {"src/io/video_encoder.cpp"}  # ffmpeg, by its whole path
LIBRARIES = re.compile(r'#\s*include\s*[<"](?:boost/process|tinyfiledialogs|portable-file-dialogs|nfd)')


def without_comments(text):
    """Comments and texts blanked out, lines kept."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()) if not m.group().startswith('"') else '""', text)


def offences(name, text):
    found = []
    for number, (line, raw) in enumerate(zip(without_comments(text).split("\n"), text.split("\n")), 1):
        if SHELLS.search(line):
            found.append(f"{name}:{number}: {SHELLS.search(line).group(1)}: start programs with an argument vector and a whole path")
        if STARTS.search(line) and name not in ALLOWED:
            found.append(f"{name}:{number}: {STARTS.search(line).group(1)}: only {', '.join(sorted(ALLOWED))} starts programs")
        if LIBRARIES.search(raw):
            found.append(f"{name}:{number}: a library that starts programs through a shell")
    return found


def main():
    # The check itself: what it must find, and what it must not.
    for bad in ('system("ls");', "x = ::popen(a, b);", "std::system (text);", "execlp(a, b);", "fork();"):
        if not offences("src/x.cpp", bad):
            print(f"this check no longer finds {bad}")
            return 1
    for good in ("// system(x)", 'say("system(x)");', "my_system(x);", "solar.system(x);", "coordinate_system(3);"):
        if offences("src/x.cpp", good):
            print(f"this check takes offence at {good}")
            return 1
    root = Path(__file__).resolve().parent.parent
    found = []
    for folder in ("src", "include"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp", ".h", ".c", ".in"):
                found += offences(str(path.relative_to(root)), path.read_text(encoding="utf-8"))
    print("\n".join(found) if found else "no program is started through a shell")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
