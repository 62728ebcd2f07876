#!/usr/bin/env python3
"""Drives the window of `steradian view` by scripts, under Xvfb, and looks at what it shows and saves.

usage: view_test.py PROGRAM SCENES OUT      OUT/*.png are the screenshots; exit 77 where there is no window or no Xvfb
"""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
from png_files import read_png  # noqa: E402

PROGRAM, SCENES, OUT = (Path(a).resolve() for a in sys.argv[1:4])


def pixels(path):
    """Width, height and the rows of a PNG."""
    rows = read_png(path)
    return len(rows[0]) // 3, len(rows), rows


def play(scene, events, *options, **variables):
    script = OUT / "script.jsonl"
    script.write_text("".join(json.dumps(e) + "\n" for e in events + [{"quit": True}]))
    done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 800x600x24", PROGRAM, "view", scene, "--script", script, *options],
                          cwd=OUT, capture_output=True, text=True, timeout=240, env={**os.environ, **variables})
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr


def worst(a, b):
    """The largest difference of two PNGs of one size, in steps of 8 bits."""
    (width, height, rows), (*size, others) = pixels(OUT / a), pixels(OUT / b)
    assert [width, height] == size, (a, b)
    return max(abs(x - y) for p, q in zip(rows, others) for x, y in zip(p, q))


def render(scene, to, *options):
    subprocess.run([PROGRAM, "render", scene, "-o", to, *options], check=True, capture_output=True, cwd=OUT)


def space():
    """A light is picked and dragged, changed and undone; what is shown, saved and rendered again is one picture."""
    said = play(SCENES / "diffuse_floor.glb", [
        {"wait": "picture"}, {"time": "first picture"}, {"wait": "settled"}, {"shot": "space-first.png"},
        {"select": "panel"}, {"drag": "right", "from": [250, 150], "to": [260, 140]}, {"wheel": 1, "at": [200, 100]},
        {"key": "L"}, {"set": "intensity", "value": 2}, {"set": "color", "value": [1, 0.3, 0.1]}, {"wait": "settled"},
        {"shot": "space-light.png"}, {"key": "2"}, {"shot": "space-rings.png"}, {"key": "1"}, {"key": "Escape"}, {"wait": "settled"},
        {"shot": "space-rest.png"}, {"picture": "space.exr"}, {"picture": "space.png"}, {"save": "space.glb"},
        {"key": "Ctrl+Z"}, {"key": "Ctrl+Z"}, {"key": "Ctrl+Z"}, {"key": "Home"}, {"wait": "settled"}, {"shot": "space-undone.png"},
    ], "--size", "400x225", "--exposure", "0", "--panel", "off")
    print(said.strip())
    assert pixels(OUT / "space-rest.png") == pixels(OUT / "space.png"), "the window shows what the picture's file holds"
    assert pixels(OUT / "space-light.png") != pixels(OUT / "space-rest.png"), "handles are drawn"
    assert pixels(OUT / "space-undone.png") == pixels(OUT / "space-first.png"), "undone, it is as it was"
    render("space.glb", "again.exr", "--size", "400x225", "--bounces", "all")
    said = subprocess.run([PROGRAM, "diff", "space.exr", "again.exr"], cwd=OUT, capture_output=True, text=True)
    print("saved scene, rendered:", said.stdout.strip())
    render("space.glb", "again.png", "--size", "400x225", "--exposure", "0", "--bounces", "all")
    assert pixels(OUT / "again.png") == pixels(OUT / "space.png"), "the saved scene renders to what was seen"


def plane():
    """A lamp of a drawing is dragged and resized, and saved."""
    play(SCENES / "plane" / "lamps.svg", [
        {"wait": "settled"}, {"shot": "plane-first.png"}, {"drag": "left", "from": [81, 75], "to": [200, 60], "steps": 20},
        {"wheel": 3, "at": [200, 60]}, {"set": "color", "value": [0.2, 1.5, 0.4]}, {"wait": "settled"}, {"shot": "plane-lamp.png"},
        {"key": "Escape"}, {"wait": "settled"}, {"shot": "plane-rest.png"}, {"save": "plane.svg"}, {"picture": "plane.png"},
    ], "--size", "400x250", "--panel", "off")
    assert pixels(OUT / "plane-rest.png") == pixels(OUT / "plane.png")
    assert pixels(OUT / "plane-rest.png") != pixels(OUT / "plane-first.png")
    render("plane.svg", "plane-again.png", "--size", "400x250")
    off = worst("plane-again.png", "plane.png")
    print("saved drawing, rendered: off by", off, "of 255 at most")
    assert off <= 1


def polygon():
    """A corner of a polygon light is drawn out in the picture; a lobe and a tone curve are chosen; a reference grows beside it."""
    above = {"drag": "left", "from": [20, 20], "to": [20, 60]}
    first = [{"wait": "picture"}, {"set": "add", "value": "polygon"}, {"set": "position", "value": [0, 0.5, 1]}, above, above, {"wait": "settled"}]
    play(SCENES / "diffuse_floor.glb", first + [{"shot": "corner-before.png"}], "--size", "400x225", "--exposure", "0", "--panel", "off")
    corners = squares(OUT / "corner-before.png")
    assert len(corners) == 5, corners
    x, y = corners[0]
    middle = [sum(c[i] for c in corners) / len(corners) for i in (0, 1)]
    out = [round(x + 0.4 * (x - middle[0])), round(y + 0.4 * (y - middle[1]))]
    play(SCENES / "diffuse_floor.glb", first + [
        {"drag": "left", "from": [x, y], "to": out}, {"wait": "settled"}, {"shot": "corner-after.png"}, {"key": "Escape"},
        {"set": "material", "value": 0}, {"set": "lobe", "value": "phong"}, {"set": "tone", "value": "filmic"}, {"wait": "settled"},
        {"shot": "corner-lobe.png"}, {"picture": "corner.png"}, {"save": "corner.glb"},
        {"set": "beside", "value": "reference"}, {"key": "C"}, {"wait": 1}, {"shot": "corner-split.png"},
    ], "--size", "400x225", "--exposure", "0", "--panel", "off")
    moved = squares(OUT / "corner-after.png")
    print("corner", (x, y), "dragged to", out, "is seen at", min(moved, key=lambda c: abs(c[0] - out[0]) + abs(c[1] - out[1])))
    assert any(abs(c[0] - out[0]) <= 2 and abs(c[1] - out[1]) <= 2 for c in moved), (out, moved)
    assert pixels(OUT / "corner-lobe.png") == pixels(OUT / "corner.png"), "the tone curve of the window is the file's"
    render("corner.glb", "corner-again.png", "--size", "400x225", "--exposure", "0", "--tone", "filmic", "--bounces", "all")
    assert pixels(OUT / "corner-again.png") == pixels(OUT / "corner.png")
    assert sum(map(sum, pixels(OUT / "corner.png")[2])) > 20 * 3 * 400 * 225, "and there is something to be seen"


def squares(path):
    """Middles of the bright squares that mark corners: 8 x 8 pixels of one of two colours within a darker rim."""
    width, height, rows = pixels(path)
    found = []
    for y in range(1, height - 9):
        row = rows[y]
        for x in range(1, width - 9):
            a = row[3 * x:3 * x + 3]
            if not (a[0] > 200 and a[1] > 180 and a[2] < 190 and a[0] - a[2] > 40):
                continue
            block = [rows[y + j][3 * x:3 * x + 24] for j in range(8)]
            if all(b == a * 8 for b in block) and rows[y - 1][3 * x:3 * x + 3] != a and row[3 * x - 3:3 * x] != a:
                found.append((x + 4, y + 4))
    return found


def paint():
    """A stroke of a wanted brightness sets the power of the lamp, as one step of undo; the saved scene has it."""
    play(SCENES / "diffuse_floor.glb", [
        {"wait": "settled"}, {"picture": "paint-first.exr"}, {"key": "P"}, {"set": "brush", "value": 10}, {"set": "wanted", "value": 3},
        {"drag": "left", "from": [150, 180], "to": [250, 180]}, {"wait": "settled"}, {"shot": "paint-strokes.png"},
        {"picture": "paint.exr"}, {"save": "paint.glb"}, {"key": "Ctrl+Z"}, {"wait": "settled"}, {"picture": "paint-undone.exr"},
        {"key": "Backspace"}, {"key": "P"}, {"wait": "settled"}, {"shot": "paint-rest.png"},
    ], "--size", "400x225", "--exposure", "0", "--panel", "off", "--bounces", "0")
    assert pixels(OUT / "paint-strokes.png") != pixels(OUT / "paint-rest.png"), "strokes are drawn"

    def same(a, b):
        return subprocess.run([PROGRAM, "diff", a, b, "--fail-above", "max=0"], cwd=OUT, capture_output=True).returncode == 0
    assert same("paint-first.exr", "paint-undone.exr"), "one step takes the fit back"
    assert not same("paint-first.exr", "paint.exr"), "the fit changes the light"
    render("paint.glb", "paint-again.exr", "--size", "400x225")
    assert same("paint.exr", "paint-again.exr"), "the saved scene has the fitted light"


def moving():
    """A drawing that moves by itself, at two moments and played."""
    play(SCENES / "plane" / "carousel.svg", [
        {"wait": "settled"}, {"shot": "moving-0.png"}, {"set": "time", "value": 1}, {"wait": "settled"}, {"shot": "moving-1.png"},
        {"key": "Space"}, {"wait": 1}, {"key": "Space"}, {"wait": "settled"}, {"shot": "moving-played.png"},
    ], "--size", "320x200", "--panel", "off")
    render(SCENES / "plane" / "carousel.svg", "moving-####.png", "--frames", "0..1", "--fps", "1", "--size", "320x200")
    for frame in (0, 1):
        assert pixels(OUT / f"moving-{frame}.png") == pixels(OUT / f"moving-000{frame}.png"), frame
    assert pixels(OUT / "moving-played.png") != pixels(OUT / "moving-1.png")


def closed():
    """Closed while a picture is in the making: quit is what a window manager asks for."""
    play(SCENES / "diffuse_floor.glb", [{"wait": "picture"}, {"drag": "left", "from": [50, 50], "to": [90, 60]}, {"minimise": True}, {"wait": 0.1}],
         "--size", "200x120")


def life():
    """Resized, minimised, restored, another scene opened, help and panel, split screen, error map; what is wrong is said."""
    play(SCENES / "glossy_floor.glb", [
        {"wait": "settled"}, {"resize": [500, 300]}, {"wait": "settled"}, {"shot": "life-larger.png"}, {"minimise": True}, {"wait": 0.2},
        {"restore": True}, {"wait": 0.2}, {"key": "F1"}, {"shot": "life-help.png"}, {"key": "F1"},
        {"set": "beside", "value": "ltc"}, {"key": "C"}, {"wait": "settled"}, {"shot": "life-split.png"},
        {"key": "M"}, {"set": "white_at", "value": 0.02}, {"wait": "settled"}, {"shot": "life-map.png"}, {"key": "M"}, {"key": "C"},
        {"open": str(SCENES / "diffuse_floor.glb")}, {"wait": "settled"}, {"shot": "life-other.png"},
        {"open": "/nowhere.glb"}, {"wait": 0.1}, {"shot": "life-wrong.png"}, {"key": "Tab"}, {"shot": "life-panel.png"},
    ], "--size", "400x225", "--panel", "off", "--record", "recorded.jsonl")
    assert pixels(OUT / "life-larger.png")[:2] == (500, 300)
    assert pixels(OUT / "life-other.png") != pixels(OUT / "life-larger.png")
    assert pixels(OUT / "life-wrong.png") != pixels(OUT / "life-other.png"), "the window says what is wrong"
    recorded = [json.loads(line) for line in (OUT / "recorded.jsonl").read_text().splitlines()]
    assert {"key": "F1"} in recorded


def swapchain():
    """With a device the window is shown by Vulkan, pixel for pixel as by OpenGL, resized and minimised; the validation layer is silent."""
    for backend, screen, *options in (("cpu", "OpenGL", "--bounces", "0"), ("vulkan", "Vulkan, ")):
        said = play(SCENES / "glossy_floor.glb", [
            {"wait": "settled"}, {"time": "start"}, {"select": "panel"}, {"wait": 0.2}, {"shot": f"{backend}-start.png"},
            {"drag": "left", "from": [200, 40], "to": [230, 60]}, {"key": "F1"}, {"wait": "settled"}, {"shot": f"{backend}-help.png"},
            {"key": "F1"}, {"resize": [500, 300]}, {"wait": 0.3}, {"wait": "settled"}, {"shot": f"{backend}-larger.png"},
            {"minimise": True}, {"wait": 0.2}, {"restore": True}, {"wait": 0.2}, {"resize": [300, 200]}, {"wait": 0.3}, {"key": "Escape"},
            {"wait": "settled"}, {"shot": f"{backend}-rest.png"}, {"picture": f"{backend}-rest-picture.png"}, {"time": "end"},
        ], "--size", "400x225", "--method", "ltc-compact", "--shadows", "off", "--exposure", "0", "--panel", "off", "--backend", backend,
            *options, VK_INSTANCE_LAYERS="VK_LAYER_KHRONOS_validation",
            VK_LAYER_ENABLES="VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT")
        print(said.strip())
        assert said.count(f"window by {screen}") == 2, "the back end's own screen shows the window from start to end"
        assert len(said.splitlines()) == 2, "the validation layer is silent"
        assert pixels(OUT / f"{backend}-rest.png") == pixels(OUT / f"{backend}-rest-picture.png"), "the window shows the picture"
    for shot in ("start", "help", "larger", "rest"):
        off = worst(f"vulkan-{shot}.png", f"cpu-{shot}.png")
        print(f"{shot}: Vulkan and OpenGL differ by", off, "of 255 at most")
        assert off <= 1
    assert pixels(OUT / "vulkan-larger.png")[:2] == (500, 300)


def lost():
    """A device that is lost where it renders or shows: the window says so, and goes on by OpenGL; the CPU renders the same picture."""
    size = ("--size", "320x180", "--method", "ltc-compact", "--shadows", "off")
    render(SCENES / "glossy_floor.glb", "lost-cpu.exr", *size)
    render(SCENES / "glossy_floor.glb", "lost-cpu.png", *size, "--exposure", "0")
    for fault, renders in (("vkWaitForFences:1", "cpu"), ("render:1", "cpu"), ("vkCreateSwapchainKHR:1", "vulkan"), ("vkQueuePresentKHR:2", "vulkan")):
        faulty = {"VK_LAYER_PATH": str(OUT.parent / "faulty_device"), "VK_INSTANCE_LAYERS": "VK_LAYER_STERADIAN_faulty_device",
                  "STERADIAN_FAULT": fault}
        said = play(SCENES / "glossy_floor.glb", [
            {"wait": "settled"}, {"wait": 0.2}, {"shot": "lost.png"}, {"picture": "lost.exr"}, {"time": fault},
        ], *size, "--exposure", "0", "--panel", "off", "--backend", "vulkan", **faulty)
        print(said.strip())
        assert "window by OpenGL" in said, "the window goes on"
        assert renders == "cpu" or "warning: the window is shown by OpenGL: Vulkan device" in said, "the terminal says why"
        differs = subprocess.run([PROGRAM, "diff", "lost.exr", "lost-cpu.exr"], cwd=OUT, capture_output=True, text=True).stdout
        assert ("max          0 " in differs) == (renders == "cpu"), differs
        assert renders == "vulkan" or worst("lost.png", "lost-cpu.png") > 1, "the window says that the device was lost"


def main():
    help_text = subprocess.run([PROGRAM, "view", str(SCENES / "plane.glb")], capture_output=True, text=True,
                               env={k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")})
    assert help_text.returncode == 1
    if "built without a window" in help_text.stderr or not shutil.which("xvfb-run"):
        print("no window, or no Xvfb")
        sys.exit(77)
    assert "no window can be opened" in help_text.stderr and "render" in help_text.stderr, help_text.stderr
    OUT.mkdir(parents=True, exist_ok=True)
    space()
    polygon()
    plane()
    paint()
    moving()
    life()
    swapchain()
    lost()
    closed()


main()
