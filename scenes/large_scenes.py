"""Large scenes: a colonnade and a nave of fine meshes, and a stadium under 10,000 lights."""

import math

from gltf_writer import DOWN, HALF, TO_PLUS_X, Gltf, Shape, box, lathe, looking, plate, rounded, sphere


def arch(width, height, radius, depth, segments):
    """A wall panel over a half-round opening; its opening's centre is the origin."""
    s = Shape()
    half = width / 2

    def inner(k):
        a = math.pi * k / segments
        return radius * math.cos(a), radius * math.sin(a)

    def outer(k):
        return half - width * k / segments, height
    for k in range(segments):
        (ax, ay), (bx, by), (cx, cy), (dx, dy) = inner(k), inner(k + 1), outer(k + 1), outer(k)
        z = depth / 2
        s.quad((ax, ay, z), (dx, dy, z), (cx, cy, z), (bx, by, z))
        s.quad((bx, by, -z), (cx, cy, -z), (dx, dy, -z), (ax, ay, -z))
        s.quad((ax, ay, -z), (ax, ay, z), (bx, by, z), (bx, by, -z))
        s.quad((cx, cy, -z), (cx, cy, z), (dx, dy, z), (dx, dy, -z))
    z, right, left = depth / 2, (half, radius), (-half, -radius)
    for (x0, y0), (x1, y1), (x2, y2) in (((right[1], 0), (right[0], 0), (half, height)), ((left[0], 0), (left[1], 0), (-half, height))):
        s.quad((x0, y0, z), (x1, y1, z), (x2, y2, z), (x2, y2, z))  # the corner between the opening's foot and the panel's
        s.quad((x1, y1, -z), (x0, y0, -z), (x2, y2, -z), (x2, y2, -z))
    s.triangles = [t for t in s.triangles if len({tuple(s.positions[k]) for k in t}) == 3]
    return s


def arcade():
    g = Gltf()
    stone, step = g.diffuse("stone", (0.74, 0.66, 0.54)), 2.4

    def profile(v):
        base = 0.10 * math.exp(-(v / 0.03) ** 2) + 0.12 * math.exp(-((v - 1) / 0.035) ** 2)
        return 0.3 - 0.05 * v + base, 3.2 * v
    column = g.mesh("column", lathe(profile, 96, 48, flutes=16, depth=0.08), g.material("marble", (0.8, 0.77, 0.72), 0.0, 0.35))
    cap = g.mesh("block", box(-0.45, -0.12, -0.45, 0.45, 0.0, 0.45), stone)
    panel = g.mesh("arch", arch(step, 1.5, 0.85, 0.6, 48), stone)
    for row, x in enumerate((-2.2, 2.2)):
        for i in range(14):
            z = 3.0 - step * i
            g.node("column %d.%d" % (row, i), mesh=column, translation=[x, 0.12, rounded(z)])
            g.node("foot %d.%d" % (row, i), mesh=cap, translation=[x, 0.12, rounded(z)])
            g.node("head %d.%d" % (row, i), mesh=cap, translation=[x, 3.44, rounded(z)])
            if i < 13:
                g.node("arch %d.%d" % (row, i), mesh=panel, translation=[x, 3.44, rounded(z - step / 2)], rotation=[0.0, HALF, 0.0, HALF])
    g.node("floor", mesh=g.mesh("floor", plate((-9, 0, 8), (9, 0, 8), (9, 0, -32), (-9, 0, -32)), g.material("floor", (0.4, 0.36, 0.32), 0.0, 0.4)))
    g.node("ceiling", mesh=g.mesh("ceiling", plate((-2.5, 4.94, -30), (2.5, 4.94, -30), (2.5, 4.94, 5), (-2.5, 4.94, 5)), stone))
    g.node("end wall", mesh=g.mesh("end wall", plate((-9, 0, -31), (9, 0, -31), (9, 6, -31), (-9, 6, -31)), stone))
    g.area_light("evening sky", {"type": "rect", "color": [1.0, 0.62, 0.34], "intensity": 9.0, "size": 5.0, "rect": {"aspect": 6.0}},
                 translation=[-9.0, 4.5, -12.0], rotation=TO_PLUS_X)
    for i in range(4):
        g.area_light("lantern %d" % (i + 1), {"type": "sphere", "color": [1.0, 0.8, 0.55], "intensity": 30.0, "size": 0.3},
                     translation=[0.0, 3.6, rounded(-1.8 - 7.2 * i)])
    g.camera("main", [0.9, 1.7, 6.5], [-0.2, 1.9, -6.0], 0.85)
    return g


def hall():
    """A nave of two storeys with a polished floor, brass columns and vessels, and curtains; sun through an open roof."""
    g = Gltf()
    stone = g.diffuse("stone", (0.72, 0.68, 0.60))
    brass = g.material("brass", (0.90, 0.70, 0.40), 1.0, 0.3)
    column = lathe(lambda v: (0.26 - 0.04 * v + 0.10 * math.exp(-(v / 0.05) ** 2) + 0.10 * math.exp(-((v - 1) / 0.05) ** 2), 2.9 * v), 32, 20)
    below, above = g.mesh("column", column, brass), g.mesh("upper column", column, stone)
    panel = g.mesh("arch", arch(2.4, 1.4, 0.85, 0.5, 20), stone)
    vessel = g.mesh("vessel", lathe(lambda v: (0.05 + 0.42 * math.sin(math.pi * (0.12 + 0.80 * v)) ** 1.5, 0.8 * v), 40, 24), brass)
    for row, x in enumerate((-3.0, 3.0)):
        for i in range(8):
            z = rounded(3.6 - 2.4 * i)
            g.node("column %d.%d" % (row, i), mesh=below, translation=[x, 0.0, z])
            g.node("upper column %d.%d" % (row, i), mesh=above, translation=[x, 4.5, z], scale=[0.8, 0.8, 0.8])
            if i < 7:
                g.node("arch %d.%d" % (row, i), mesh=panel, translation=[x, 2.9, rounded(z - 1.2)], rotation=[0.0, HALF, 0.0, HALF])
                g.node("upper arch %d.%d" % (row, i), mesh=panel, translation=[x, 6.82, rounded(z - 1.2)], rotation=[0.0, HALF, 0.0, HALF])
            if i % 2 == 1 and i < 7:
                g.node("vessel %d.%d" % (row, i), mesh=vessel, translation=[rounded(0.55 * x), 0.0, rounded(z - 1.2)])
    g.node("gallery left", mesh=g.mesh("gallery left", box(-5.5, 4.3, -14.0, -2.75, 4.5, 4.5), stone))
    g.node("gallery right", mesh=g.mesh("gallery right", box(2.75, 4.3, -14.0, 5.5, 4.5, 4.5), stone))
    for name, color, x, z in (("red", (0.65, 0.08, 0.06), -2.70, 2.4), ("green", (0.10, 0.42, 0.12), 2.70, 0.0), ("blue", (0.08, 0.16, 0.55), -2.70, -2.4)):
        s = Shape()

        def fold(u, v, x=x, z=z):
            a = 10 * math.pi * u
            side = 1.0 if x < 0 else -1.0
            along = side * (1.7 * (0.5 - u))
            slope = 0.06 * 10 * math.pi * math.cos(a) / 1.7
            return (x + side * 0.06 * math.sin(a), 4.2 - 3.2 * (1 - v), z - 1.2 + along), (side, 0.0, side * slope)
        s.grid(80, 2, fold)
        g.node("curtain " + name, mesh=g.mesh("curtain " + name, s, g.diffuse(name, color)))
    walls = ((("floor"), g.material("floor", (0.45, 0.42, 0.38), 0.0, 0.2), ((-5.5, 0, 6), (5.5, 0, 6), (5.5, 0, -15), (-5.5, 0, -15))),
             (("left wall"), stone, ((-5.5, 0, 6), (-5.5, 0, -15), (-5.5, 9, -15), (-5.5, 9, 6))),
             (("right wall"), stone, ((5.5, 0, -15), (5.5, 0, 6), (5.5, 9, 6), (5.5, 9, -15))),
             (("end wall"), stone, ((-5.5, 0, -15), (5.5, 0, -15), (5.5, 9, -15), (-5.5, 9, -15))))
    for name, material, corners in walls:
        g.node(name, mesh=g.mesh(name, plate(*corners), material))
    g.light("KHR_lights_punctual", "sun",
            {"type": "spot", "color": [1.0, 0.92, 0.78], "intensity": 9000.0, "spot": {"innerConeAngle": 0.22, "outerConeAngle": 0.27}},
            matrix=looking([5.5, 17.0, 2.0], [-0.6, 0.0, -4.5]))
    g.area_light("sky", {"type": "rect", "color": [0.55, 0.72, 1.0], "intensity": 1.2, "size": 5.0, "rect": {"aspect": 3.0}},
                 translation=[0.0, 9.2, -5.0], rotation=DOWN)
    g.camera("main", [1.2, 1.75, 5.6], [-0.35, 1.9, -6.0], 0.9)
    return g


def facing(direction):
    """The rotation that turns a light's -Z along a direction, its x level."""
    length = math.sqrt(sum(c * c for c in direction))
    x, y, z = (c / length for c in direction)
    yaw, pitch = math.atan2(-x, -z), math.asin(max(-1.0, min(1.0, y)))
    sy, cy, sp, cp = math.sin(yaw / 2), math.cos(yaw / 2), math.sin(pitch / 2), math.cos(pitch / 2)
    return [rounded(c) for c in (cy * sp, sy * cp, -sy * sp, cy * cp)]


def stadium():
    """A stadium at night: 10,000 lamps, of which 2,400 under the roof, 6,600 along the steps and 1,000 boards around the pitch."""
    g = Gltf()
    grass = [g.diffuse("grass %d" % i, c) for i, c in enumerate(((0.10, 0.26, 0.07), (0.13, 0.32, 0.09)))]
    white, concrete, track = g.diffuse("line", (0.75, 0.75, 0.72)), g.diffuse("concrete", (0.30, 0.30, 0.32)), g.diffuse("track", (0.32, 0.13, 0.09))

    def ellipse(k, a):
        """Terrace k of 15, at the angle a."""
        return (66.0 + 2.4 * k) * math.cos(a), (47.0 + 2.4 * k) * math.sin(a)

    g.node("track", mesh=g.mesh("track", plate((-80, -0.02, 60), (80, -0.02, 60), (80, -0.02, -60), (-80, -0.02, -60)), track))
    for i in range(14):
        x = -52.5 + 7.5 * i
        g.node("grass", mesh=g.mesh("grass", plate((x, 0, 34), (x + 7.5, 0, 34), (x + 7.5, 0, -34), (x, 0, -34)), grass[i % 2]))
    lines = Shape()
    for x0, x1, z0, z1 in ((-52.5, 52.5, -34, -33.8), (-52.5, 52.5, 33.8, 34), (-52.5, -52.3, -34, 34), (52.3, 52.5, -34, 34), (-0.1, 0.1, -34, 34),
                           (-36, -35.8, -20, 20), (35.8, 36, -20, 20), (-52.5, -36, -20.2, -20), (-52.5, -36, 20, 20.2), (36, 52.5, -20.2, -20),
                           (36, 52.5, 20, 20.2)):
        lines.quad((x0, 0.01, z1), (x1, 0.01, z1), (x1, 0.01, z0), (x0, 0.01, z0))
    circle = 72
    for i in range(circle):
        a, b = 2 * math.pi * i / circle, 2 * math.pi * (i + 1) / circle
        p = [(r * math.cos(t), 0.01, -r * math.sin(t)) for r, t in ((9.05, a), (9.25, a), (9.25, b), (9.05, b))]
        lines.quad(*p)
    g.node("lines", mesh=g.mesh("lines", lines, white))

    # Treads and risers: level, then up, from the pitch outwards; a wall behind the last.
    steps, columns, rows = Shape(), 120, 15
    for k in range(rows):
        y = 1.5 + 1.6 * k
        for i in range(columns):
            a, b = 2 * math.pi * i / columns, 2 * math.pi * (i + 1) / columns
            (x0, z0), (x1, z1), (x2, z2), (x3, z3) = ellipse(k, a), ellipse(k, b), ellipse(k + 1, b), ellipse(k + 1, a)
            low = 0.0 if k == 0 else y - 1.6
            steps.quad((x0, low, z0), (x1, low, z1), (x1, y, z1), (x0, y, z0))
            steps.quad((x0, y, z0), (x1, y, z1), (x2, y, z2), (x3, y, z3))
            if k == rows - 1:
                steps.quad((x3, y, z3), (x2, y, z2), (x2, 29.0, z2), (x3, 29.0, z3))
    g.node("steps", mesh=g.mesh("steps", steps, concrete))
    backs = Shape()  # of the boards
    for x0, x1, z0, z1 in ((-52, 52, 37.1, 37.3), (-52, 52, -37.3, -37.1), (-56.3, -56.1, -36, 36), (56.1, 56.3, -36, 36)):
        part = box(x0, 0.0, z0, x1, 0.95, z1)
        first = len(backs.positions)
        backs.positions += part.positions
        backs.normals += part.normals
        backs.triangles += [tuple(first + i for i in t) for t in part.triangles]
    g.node("backs", mesh=g.mesh("backs", backs, white))

    roof = [g.lamp("roof", {"type": "rect", "color": c, "intensity": 4500.0, "size": 0.5, "rect": {"aspect": 1.0}}) for c in
            ([1.0, 0.93, 0.84], [0.84, 0.92, 1.0])]
    for i in range(2400):
        a, row = 2 * math.pi * (i // 3) / 800, i % 3
        x, z = ellipse(12.5 - row, a)
        aim = (0.55 * x * (0.2 + 0.8 * (i % 7) / 6) - x, -31.0, 0.45 * z * (0.2 + 0.8 * (i % 5) / 4) - z)
        roof[i // 300 % 2](translation=[rounded(x), 33.5, rounded(z)], rotation=facing(aim))
    colors = ([1.0, 0.36, 0.06], [1.0, 0.70, 0.28], [0.10, 0.30, 1.0], [0.80, 0.12, 0.75])
    step = [g.lamp("step", {"type": "rect", "color": c, "intensity": 5200.0, "size": 0.12, "rect": {"aspect": 3.0}}) for c in colors]
    for i in range(6600):
        k, n = 1 + i // 471, i % 471
        a = 2 * math.pi * (n + 0.5 * (k % 2)) / 471
        x, z = ellipse(k - 0.02, a)
        step[int(8 * a / (2 * math.pi)) % 4](translation=[rounded(x), rounded(1.5 + 1.6 * (k - 1) + 1.1), rounded(z)], rotation=facing((-x, -40.0, -z * 1.4)))
    board = [g.lamp("board", {"type": "rect", "color": c, "intensity": 260.0, "size": 0.8, "rect": {"aspect": 0.6}}) for c in
             ([0.1, 0.7, 1.0], [1.0, 0.25, 0.15], [0.95, 0.95, 0.9], [0.3, 1.0, 0.35])]
    for i in range(1000):
        long = i < 600
        t = ((i % 300 + 0.5) / 300 if long else (i - 600) % 200 / 200 + 0.0025) * 2 - 1
        side = 1.0 if (i < 300 if long else i < 800) else -1.0
        x, z = (52.0 * t, 37.0 * side) if long else (56.0 * side, 36.0 * t)
        board[i // 25 % 4](translation=[rounded(x), 0.5, rounded(z)], rotation=facing((0, -0.1, -side) if long else (-side, -0.1, 0)))
    g.camera("main", [30.0, 27.0, 74.0], [-9.0, 3.0, -8.0], 0.8)
    g.camera("pitch", [-20.0, 1.7, 20.0], [20.0, 6.0, -20.0], 0.9)
    return g


SCENES = {"arcade": arcade, "hall": hall, "stadium": stadium}
