#!/usr/bin/env python3
"""broken_questions_test.py PROGRAM SCENES: questions of `steradian solve` that cannot be answered.

Each ends within seconds, with exit status 1 and messages that name the place, or with an answer that states what is not met. Nothing is
written after an error.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ZONE = {"center": [0.9, 0.75, -0.6], "x": [0.75, 0, 0], "y": [0, 0, 0.35], "grid": [4, 2]}
LUX = {"zone": ZONE, "lux": {"min": 450, "max": 550}}
POWER = {"light": "panel*", "power": True}
ANSWERED = "answered"  # exit status 0 or 3, and the words in the output


def fit(**keys):
    return {"fit": [{"light": "panel 1", **keys}], "targets": [LUX]}


def target(**keys):
    return {"fit": [POWER], "targets": [keys]}


def zone(**keys):
    return target(zone={**ZONE, **keys}, lux={"min": 450})


# (question, words of the message). A text is the bytes of the file.
QUESTIONS = [
    ("", "JSON"),
    ("[", "JSON"),
    ("[]", "expected an object"),
    ("{}", "nothing to fit"),
    ('{"fit": [{"light": "panel*", "power": {"max": NaN}}]}', "JSON"),
    ('{"fit": [{"light": "panel*", "power": {"max": 1e999}}]}', "JSON"),
    ('{"fit": ' + "[" * 5000 + "]" * 5000 + "}", "JSON"),
    ('{"fit": [{"light": "panel*", "light": "panel 1", "power": true}]}', "twice"),
    ("\x00\xff{", "JSON"),
    ({"fit": [], "targets": [LUX]}, "nothing to fit"),
    ({"fit": [POWER], "targets": []}, "no target"),
    ({"fit": [POWER]}, "no target"),
    ({"targets": [LUX]}, "nothing to fit"),
    ({"fit": POWER, "targets": [LUX]}, "expected a list"),
    ({"fit": [POWER], "targets": [LUX], "fits": []}, "unknown key"),
    ({"fit": [POWER], "targets": [LUX], "least": "light"}, "least"),
    ({"fit": [7], "targets": [LUX]}, "expected an object"),
    (fit(), "nothing to fit"),
    (fit(power=False), "false"),
    (fit(power="all"), "expected"),
    (fit(power={"max": -1}), "negative"),
    (fit(power={"min": 5, "max": 1}), "min is above max"),
    (fit(power={"least": 5}), "unknown key"),
    (fit(power=True, color=True), "color"),
    (fit(power={"min": 1e300, "max": 1e308}), "outside of its range"),
    (fit(position={"min": [1, 2, 3], "max": [0, 0, 0]}), "min is above max"),
    (fit(position={"min": [90, 90, 90]}), "outside of its range"),
    (fit(position={"min": [1, 2]}), "3 numbers"),
    ({"fit": [{"material": "granite", "albedo": True}], "targets": [LUX]}, "no material is named"),
    ({"fit": [{"material": "wood", "power": True}], "targets": [LUX]}, "unknown key"),
    ({"fit": [{"material": "wood"}], "targets": [LUX]}, "nothing of it is free"),
    ({"fit": [{"material": "wood", "albedo": {"max": 0.01}}], "targets": [LUX]}, "outside of its range"),
    ({"fit": [{"material": "wood", "albedo": True}], "targets": [LUX]}, "no target sees light on the material"),
    (fit(rotation={"max_degrees": -3}), "negative"),
    (fit(size={"min": 5, "max": 6}), "outside of its range"),
    (fit(vertices=True), "the file has a rectangle"),
    (fit(vertices={"max": -1}), "negative"),
    (fit(vertices={"least": 1}), "unknown key"),
    (fit(vertices=True, size=True), "the file has a rectangle"),
    (fit(power=True, keep=-1), "negative"),
    (fit(roughness=True), "unknown key"),
    ({"fit": [{"light": "pannel", "power": True}], "targets": [LUX]}, "no light is named"),
    ({"fit": [{"light": 3, "power": True}], "targets": [LUX]}, "expected"),
    ({"fit": [POWER, POWER], "targets": [LUX]}, "fitted twice"),
    ({"fit": [POWER], "targets": [LUX], "tie": [{"lights": ["panel 1"]}]}, "tie"),
    ({"fit": [POWER], "targets": [LUX], "tie": [{"lights": ["panel 1", "panel 2"], "mirror": {"point": [0, 0, 0], "normal": [0, 0, 0]}}]}, "zero"),
    ({"fit": [POWER], "targets": [LUX], "tie": [{"lights": []}]}, "tie"),
    (target(lux={"min": 5}), "target"),
    (target(zone=ZONE), "lux"),
    (target(zone=ZONE, lux={}), "asks for nothing"),
    (target(zone=ZONE, lux={"min": 5, "max": 1}), "min is above max"),
    (target(zone=ZONE, lux={"uniformity": 2}), "above 1"),
    (target(zone=ZONE, lux={"min": -5}), "negative"),
    (target(zone=ZONE, lux={"min": 5}, weight=-1), "must be above 0"),
    (target(zone=ZONE, lux={"min": 5}, picture="none.exr"), "target"),
    (zone(x=[0, 0, 1]), "parallel"),
    (zone(x=[0, 0, 0]), "parallel"),
    (zone(grid=[0, 4]), "1"),
    (zone(grid=[4]), "expected"),
    (zone(grid=[1000, 1001]), "1000"),
    (zone(grid=[1e18, 2]), "expected an integer"),
    (target(points=[], normal=[0, 1, 0], lux={"min": 5}), "point"),
    (target(points=[[0, 1]], normal=[0, 1, 0], lux={"min": 5}), "3 numbers"),
    (target(points=[[0, 1, 0]], normal=[0, 0, 0], lux={"min": 5}), "zero"),
    (target(points=[[0, 1, 0]], normal="up", lux={"min": 5}), "normal"),
    (target(points=[[0, 1, 0]], lux={"min": 5}), "fewer"),
    (target(mesh="nothing like it", grid=0.5, lux={"min": 5}), "no mesh"),
    (target(mesh="*", grid=0, lux={"min": 5}), "grid"),
    (target(mesh="*", grid=1e-9, lux={"min": 5}), "200000"),
    (target(picture="missing.exr"), "missing.exr"),
    (target(picture="text.exr"), "text.exr"),
    (target(picture="wanted.exr", camera="nobody"), "no camera"),
    (target(picture="wanted.exr", mask="small.png"), "resample the mask"),
    (target(picture="wanted.exr", mask="missing.png"), "missing.png"),
    (target(picture="wanted.exr", mask="black.exr"), "no pixel"),
    (target(picture="wanted.exr", space="cubic"), "cubic"),
    (target(picture="wanted.exr", part="shiny"), "shiny"),
    (target(picture="infinite.hdr"), "no target sees"),
    (target(picture="black.exr"), "the picture is black"),
    (target(paint="black.exr", part="specular", radiance=[1, 1, 1]), "the picture is black"),
    (target(paint="wanted.exr", radiance=[-1, 0, 0]), "negative"),
    # Unreachable values, and parameters without effect: statements.
    (target(zone={**ZONE, "grid": [4, 4]}, lux={"min": 1e9}), ANSWERED, "16 points outside"),
    ({"fit": [{"light": "panel*", "power": {"max": 1}}], "targets": [LUX], "least": "power"}, "outside of its range"),
    ({"fit": [{"light": "panel 1", "power": {"max": 9000}}], "targets": [LUX], "least": "power"}, ANSWERED, "no powers satisfy"),
    ({"fit": [{"light": "panel 1", "rotation": True, "power": True}],
      "targets": [{"points": [[0, -1 - i, 0] for i in range(6)], "normal": [0, -1, 0], "lux": {"min": 5}}]}, "no target sees"),
]


def main():
    program, scenes = sys.argv[1], Path(sys.argv[2])
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        render = [program, "render", str(scenes / "office.glb"), "--size"]
        subprocess.run([*render, "32x18", "-o", str(folder / "wanted.exr")], check=True, capture_output=True)
        subprocess.run([*render, "8x8", "-o", str(folder / "small.png")], check=True, capture_output=True)
        (folder / "text.exr").write_text("a text")
        # A picture of 32 x 18 pixels in the format of Radiance, of one colour: black, and beyond the range of what a fit can use.
        header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 18 +X 32\n"
        (folder / "black.hdr").write_bytes(header.encode() + bytes([0, 0, 0, 0]) * 32 * 18)
        (folder / "infinite.hdr").write_bytes(header.encode() + bytes([255, 255, 255, 255]) * 32 * 18)
        for number, (question, *words) in enumerate(QUESTIONS):
            text = question if isinstance(question, str) else json.dumps(question).replace("black.exr", "black.hdr")
            spec, output = folder / f"{number}.json", folder / f"{number}.glb"
            spec.write_bytes(text.encode("latin-1"))
            try:
                done = subprocess.run([program, "solve", str(scenes / "office.glb"), "--spec", str(spec), "-o", str(output)],
                                      capture_output=True, text=True, errors="replace", timeout=60)
            except subprocess.TimeoutExpired:
                wrong.append((number, text[:200], "it does not end"))
                continue
            answered = words[0] == ANSWERED
            said = done.stdout + done.stderr if answered else done.stderr
            good = done.returncode in ((0, 3) if answered else (1, 2)) and words[-1] in said and output.exists() == answered
            if not good:
                wrong.append((number, text[:200], f"status {done.returncode}: {said[-300:]}"))
    for number, text, problem in wrong:
        print(f"question {number}: {text}\n  {problem}")
    print(f"{len(QUESTIONS)} broken questions, {len(wrong)} answered wrongly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
