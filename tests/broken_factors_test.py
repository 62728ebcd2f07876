#!/usr/bin/env python3
"""broken_factors_test.py PROGRAM: strange questions of view factors.

Lines of `steradian eval` with "from" and "to", sensors of `viewfactor points`, and files of `viewfactor verify`. Each has an error that
names the place, or a factor from 0 to 1 that is not above the open one. Each ends within seconds.
"""
import itertools
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

FLOOR, CEILING = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]
ROOM = """v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2\nv 4 0 2\nv 4 3 2\nv 0 3 2
f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 3 7 8 4\nf 2 6 7 3\n"""
NUMBER = "a factor"  # the answer of a question that is strange but has one


def ask(**keys):
    return json.dumps({"from": FLOOR, "to": CEILING, **keys})


def scaled(polygon, scale, shift=0.0):
    return [[scale * x + shift for x in v] for v in polygon]


# (line, words of the error)
LINES = [
    ('{"from": []', "error"),
    ('{"from": 3}', "from"),
    ('{"to": [[0,0,0],[1,0,0],[0,1,0]], "from": null}', "from"),
    (ask(to=[]), "to"),
    (ask(to=[[0, 0, 1]]), "to"),
    (ask(to=[[0, 0, 1], [1, 0, 1]]), "to"),
    (ask(to=[[0, 0], [1, 0], [0, 1]]), "3 numbers"),
    (ask(to=[[0, 0, 1], [1, 0, 1], [2, 0, 1]]), "no area"),
    (ask(to=[[0, 0, 1]] * 4), "to"),
    (ask(to=[[0, 0, 1], [1, 0, 1], [1, 1, 1.5], [0, 1, 1]]), "bent"),
    (ask(to=[[0, 0, "1"], [1, 0, 1], [0, 1, 1]]), "number"),
    (ask(to={"vertices": CEILING, "holes": 3}), "holes"),
    (ask(to={"vertices": CEILING, "holes": [[]]}), "holes"),
    (ask(to={"vertices": CEILING, "hole": []}), "unknown key"),
    (ask(to={"holes": []}), "vertices"),
    (ask(obstacles=3), "obstacles"),
    (ask(obstacles=[3]), "obstacles[0]"),
    (ask(obstacles=[CEILING, [[0, 0, 0]]]), "obstacles[1]"),
    (ask(obstacles=[[[0, 0, 0.5], [1, 1, 0.5], [1, 0, 0.5], [0, 1, 0.5]]]), "obstacles[0]"),
    (ask(obstacles=[{"vertices": FLOOR, "holes": [[[5, 5, 5], [6, 5, 5], [5, 6, 5]]]}]), "obstacles[0]"),
    (ask(eps=0), "eps"),
    (ask(eps=-1), "eps"),
    (ask(eps=1e-15), "eps"),
    (ask(eps="small"), "eps"),
    (ask(eps=None), "eps"),
    (ask(samples=5), "unknown key"),
    (ask(eps=1e-8)[:-1] + ', "eps": 1e-7}', "twice"),
    (ask().replace("[1, 0, 1]", "[NaN, 0, 1]"), "error"),
    (ask().replace("[1, 0, 1]", "[1e999, 0, 1]"), "error"),
    (ask(to=[[0, 0, 1e308], [0, 1, 1e308], [1e308, 1, 1e308]]), "error"),
    (ask(to=scaled(CEILING, 1e-200), **{"from": scaled(FLOOR, 1e-200)}), "error"),
    (ask(id=[1]), NUMBER),
    (ask(to=FLOOR), NUMBER),
    (ask(to=FLOOR[::-1]), NUMBER),
    (ask(to=CEILING[::-1]), NUMBER),
    (ask(to=[[0.5, 0, -0.5], [0.5, 1, -0.5], [0.5, 1, 0.5], [0.5, 0, 0.5]]), NUMBER),
    (ask(to=[[0, 0, 1], [0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1], [1, 0, 1]]), NUMBER),
    (ask(to=scaled(CEILING, 1, 1e9)), NUMBER),
    (ask(to=[[0, 0, 1e-12], [0, 1, 1e-12], [1, 1, 1e-12], [1, 0, 1e-12]]), NUMBER),
    (ask(obstacles=[FLOOR, CEILING]), NUMBER),
    (ask(obstacles=[FLOOR] * 30), NUMBER),
    (ask(obstacles=[scaled(FLOOR, 1, 0.5)] * 9), NUMBER),
]
LINES += [(ask(to=scaled(CEILING, s), **{"from": scaled(FLOOR, s)}), NUMBER) for s in (1e-6, 1e-3, 1e3, 1e6)]
LINES += [(ask(obstacles=[[[x, 0, h], [1, 0, h], [1, 1, h], [x, 1, h]]]), NUMBER)
          for x, h in itertools.product((0, 1e-9, 0.5), (0, 1e-13, 1e-9, 0.5, 1 - 1e-9, 1))]

# (text of the file of sensors, words of the error)
SENSORS = [
    ("", "no sensors"),
    ("x,y,z,nx,ny,nz\n", "no sensors"),
    ("# nothing\n\n", "no sensors"),
    ("1,1,1,0,0,1\n1,1,1,0,0\n", ":2"),
    ("1,1,1,0,0,0\n1,1,1,0,0,0\n", ":1"),
    ("1,1,1,0,0,1\n1,1,nan,0,0,1\n", ":2"),
    ("1,1,1,0,0,1\n1,1,inf,0,0,1\n", ":2"),
    ("1,1,1,0,0,1\nabc\n", ":2"),
    ("1,1,1,0,0,1\n1,1,1,0,0,1,7\n", ":2"),
    ("1,1,1,0,0,1\n1,1,1,0,0,1x\n", ":2"),
    ("1,1,1,0,0,1\n1;1;1;0;0;1\n", ":2"),
    ("1,1,1,0,0,1\n1e999,1,1,0,0,1\n", ":2"),
    ("1,1,1,0,0,1\n" + "9" * 100000 + "\n", ":2"),
    ("\x00\xff\xfe", "no sensors"),
    ("1,1,1,0,0,1", NUMBER),
    ("1 1 1 0 0 1\r\n", NUMBER),
    ("1,1,0,0,0,1\n0,0,0,0,0,1\n4,3,2,-1,-1,-1\n2,1.5,0,1e-200,0,1e200\n", NUMBER),
    ("1e9,1,1,-1,0,0\n1,1,1,1e-300,0,0\n", NUMBER),
]


def factor_is_wrong(answer):
    factor, bound = answer.get("view_factor"), answer.get("bound")
    return not (isinstance(factor, (int, float)) and 0 <= factor <= 1 and isinstance(bound, (int, float)) and bound >= 0)


def check_lines(program):
    wrong = []
    text = "\n".join(line for line, _ in LINES) + "\n"
    done = subprocess.run([program, "eval"], input=text, capture_output=True, text=True, timeout=120)
    answers = done.stdout.splitlines()
    if len(answers) != len(LINES):
        return [f"{len(LINES)} lines have {len(answers)} answers, status {done.returncode}"]
    for (line, words), text in zip(LINES, answers):
        answer = json.loads(text)
        bad = factor_is_wrong(answer) if words == NUMBER else words not in text or "error" not in answer
        if bad:
            wrong.append(f"{line[:200]}\n  expected {words}: {text[:300]}")
    # Obstacles at random: the factor is never above the open one, in either direction.
    rng = random.Random(7)
    number = lambda: round(rng.uniform(-0.5, 1.5) * 4) / 4 if rng.random() < 0.5 else rng.uniform(-0.5, 1.5)
    lines = []
    for _ in range(60):
        a, b, c = ([number() for _ in range(3)] for _ in range(3))
        obstacles = [[a, [x + u for x, u in zip(a, b)], [x + u + v for x, u, v in zip(a, b, c)], [x + v for x, v in zip(a, c)]]]
        lines.append(ask(obstacles=obstacles * rng.randint(1, 3), eps=1e-6))
    done = subprocess.run([program, "eval"], input="\n".join(lines) + "\n", capture_output=True, text=True, timeout=120)
    for line, text in zip(lines, done.stdout.splitlines()):
        answer = json.loads(text)
        if "error" not in answer and (factor_is_wrong(answer) or answer["view_factor"] > 0.1998248956983874 + 1e-6):
            wrong.append(f"{line[:300]}\n  {text[:200]}")
    return wrong


def run(command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=60)
    except subprocess.TimeoutExpired:
        return 124, "", "it does not end"
    return done.returncode, done.stdout, done.stderr


def check_sensors(program, folder):
    wrong = []
    room, sensors = folder / "room.obj", folder / "sensors.csv"
    for text, words in SENSORS:
        sensors.write_bytes(text.encode("latin-1"))
        status, out, err = run([program, "viewfactor", "points", str(room), str(sensors)])
        if words == NUMBER:
            rows = [[float(x) for x in line.split(",")] for line in out.splitlines()[1:]]
            bad = status != 0 or not rows or any(not (-1e-12 <= f <= 1 + 1e-12) for row in rows for f in row[6:])
            bad = bad or any(abs(sum(row[6:]) - 1) > 1e-9 for row in rows)
        else:
            bad = status != 1 or words not in err or "sensors.csv" not in err or out
        if bad:
            wrong.append(f"sensors {text[:80]!r}\n  expected {words}: status {status}, {(out + err)[:300]}")
    return wrong


def check_verify(program, folder):
    wrong = []
    good, broken = folder / "good.npz", folder / "broken.npz"
    status, _, err = run([program, "viewfactor", str(folder / "room.obj"), "-o", str(good)])
    if status != 0:
        return [f"the room has no factors: {err}"]
    content = good.read_bytes()
    rng = random.Random(3)
    files = [b"", b"PK", content[:30], content[: len(content) // 2], content[:-1], content + b"x", b"PK\x05\x06" + b"\0" * 18]
    for _ in range(30):
        damaged = bytearray(content)
        for _ in range(rng.randint(1, 4)):
            damaged[rng.randrange(len(damaged))] = rng.randrange(256)
        files.append(bytes(damaged))
    for number, content in enumerate(files):
        broken.write_bytes(content)
        status, out, err = run([program, "viewfactor", "verify", str(broken), "--pairs", "20"])
        # A byte that no reader looks at may change nothing; else an error that names the file, or pairs that are beyond.
        if not (status == 0 or (status == 1 and ("broken.npz" in err or "beyond" in out))):
            wrong.append(f"verify of damaged file {number}: status {status}, {(out + err)[:300]}")
    for arguments, words in [(["verify"], "verify"), (["verify", str(good), str(good)], "verify"), (["verify", str(good), "--pairs", "0"], "pairs"),
                             (["points", str(folder / "room.obj")], "points"), (["verify", str(folder / "none.npz")], "none.npz"),
                             (["points", str(folder / "room.obj"), str(folder / "none.csv")], "none.csv")]:
        status, out, err = run([program, "viewfactor", *arguments])
        if status not in (1, 2) or words not in err:
            wrong.append(f"{arguments}: status {status}, {(out + err)[:300]}")
    return wrong


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "room.obj").write_text(ROOM)
        wrong = check_lines(program) + check_sensors(program, folder) + check_verify(program, folder)
    for problem in wrong:
        print(problem)
    print(f"{len(LINES) + 60} lines, {len(SENSORS)} files of sensors and 43 calls of verify; {len(wrong)} are wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
