#!/usr/bin/env python3
"""Opens the real editor in a virtual display: it draws, takes a key press, writes a picture and ends with 0; then a small piece
of work from the start page to a saved project.

Usage: window_smoke.py FASCICLE_EDITOR. Prints "fascicle-skip: reason" where there is no virtual display.
"""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LIMIT = 120  # seconds for anything


def skip(reason):
    print(f"fascicle-skip: {reason}")
    sys.exit(0)


def start_display():
    """Xvfb picks a free number itself and says which."""
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1400x900x24", "-nolisten", "tcp",
         "-noreset"], # or it starts anew when its first client goes, and the next may come meanwhile,
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    with os.fdopen(read_end) as numbers:
        number = numbers.readline().strip()
    if not number:
        server.kill()
        skip("Xvfb does not start")
    return server, f":{number}"


def wait_for(what, condition):
    end = time.time() + LIMIT
    while time.time() < end:
        result = condition()
        if result:
            return result
        time.sleep(0.2)
    sys.exit(f"waited {LIMIT} s for {what}")


def frames_and_exit(editor, environment, folder):
    done = subprocess.run([editor, "--scene", "cylinder", "--quit-after", "30"], env=environment, cwd=folder,
                          timeout=LIMIT, capture_output=True, text=True)
    assert done.returncode == 0, f"exit {done.returncode}: {done.stderr}"
    assert done.stderr == "", done.stderr


def key_and_picture(editor, environment, folder):
    def xdotool(*arguments):
        return subprocess.run(["xdotool", *arguments], env=environment, capture_output=True, text=True, timeout=LIMIT)

    program = subprocess.Popen([editor, "--scene", "cylinder"], env=environment, cwd=folder)
    try:
        window = wait_for("the window", lambda: xdotool("search", "--name", "cylinder - fascicle").stdout.split())[0]
        time.sleep(1)
        xdotool("windowfocus", "--sync", window)

        def picture():
            found = list(Path(folder).glob("cylinder_*.png"))
            if not found:  # a key before the first frame is lost, as a person's would be
                xdotool("keydown", "F12")
                time.sleep(0.2)
                xdotool("keyup", "F12")
                time.sleep(0.5)
            return found

        first = wait_for("the picture", picture)[0]
        head = wait_for("all of it", lambda: first.read_bytes()[:24])
        assert head[:8] == b"\x89PNG\r\n\x1a\n"
        width, height = struct.unpack(">II", head[16:24])
        assert 400 < width < 1400 and 200 < height < 900, (width, height)
        xdotool("keydown", "ctrl")
        xdotool("keydown", "q")
        time.sleep(0.2)
        xdotool("keyup", "q")
        xdotool("keyup", "ctrl")
        code = program.wait(LIMIT)
        assert code == 0, f"exit {code}"
    finally:
        if program.poll() is None:
            program.kill()


def workflow(editor, environment, folder):
    """Start page, a scene by a click, a parameter by a command, a marker, a project saved and simulated: what a person does."""
    user = Path(folder) / "user"
    environment = dict(environment, FASCICLE_USER=str(user))

    def xdotool(*arguments):
        return subprocess.run(["xdotool", *arguments], env=environment, capture_output=True, text=True, timeout=LIMIT)

    def press(*keys):
        for key in keys:
            xdotool("keydown", key)
        time.sleep(0.15)
        for key in reversed(keys):
            xdotool("keyup", key)
        time.sleep(0.25)

    def click(window, x, y):
        xdotool("mousemove", "--window", window, str(x), str(y))
        time.sleep(0.2)
        xdotool("mousedown", "1")
        time.sleep(0.15)
        xdotool("mouseup", "1")
        time.sleep(0.3)

    items = Path(folder) / "items.txt" # where the program says its widgets are
    program = subprocess.Popen([editor, "--start", "--write-items", str(items)], env=environment, cwd=folder)

    def place(name):
        def find():
            if items.exists():
                for line in items.read_text().splitlines():
                    key, x0, y0, x1, y1 = line.rsplit("\t", 4)
                    if key == name:
                        return (float(x0) + float(x1)) / 2, (float(y0) + float(y1)) / 2
            return None
        return wait_for(name, find)

    try:
        window = wait_for("the window", lambda: xdotool("search", "--name", "fascicle").stdout.split())[0]
        time.sleep(1)
        xdotool("windowfocus", "--sync", window)
        click(window, *place("start/scene/cylinder"))
        place("tree/strap")
        press("m") # a marker at the playhead
        click(window, *place("timeline/last"))
        press("ctrl", "s")
        place("save/save")
        click(window, *place("save/save"))
        saved = wait_for("the project", lambda: list(Path(folder).glob("*.fascicle")))[0]
        assert '"Marker 1"' in saved.read_text(), saved.read_text()[:400]
        press("ctrl", "q")
        code = program.wait(LIMIT)
        assert code == 0, f"exit {code}"
    finally:
        if program.poll() is None:
            program.kill()
    assert saved.name in (user / "recent.json").read_text()
    assert not list((user / "autosave").glob("*")), "a clean end leaves no copies"


def no_display(editor, folder):
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run([editor, "--scene", "cylinder"], env=environment, cwd=folder, timeout=LIMIT, capture_output=True, text=True)
    assert done.returncode == 1, done.returncode
    assert len(done.stderr.strip().splitlines()) == 1, done.stderr


def main():
    editor = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        no_display(editor, folder)
        for tool in ("Xvfb", "xdotool"):
            if shutil.which(tool) is None:
                skip(f"{tool} is not installed")
        server, display = start_display()
        try:
            environment = dict(os.environ, DISPLAY=display, FASCICLE_USER="")  # no copies of others' work are offered
            environment.pop("WAYLAND_DISPLAY", None)
            frames_and_exit(editor, environment, folder)
            key_and_picture(editor, environment, folder)
            with tempfile.TemporaryDirectory() as other:
                workflow(editor, environment, other)
        finally:
            server.terminate()
            server.wait()


if __name__ == "__main__":
    main()
