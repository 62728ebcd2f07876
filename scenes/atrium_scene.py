"""An atrium of 250,000 triangles: two storeys of arcades about a court, in the sun, with the kinds of things of the Sponza scene."""

import math

from gltf_writer import HALF, Gltf, Shape, box, lathe, looking, plate, rounded, tube
from large_scenes import arch

BAY, BAYS = 2.4, 9           # of an arcade: a column stands at each end of a bay
HALF_COURT, AISLE = 3.6, 3.0  # half of the court's width, and the depth of the aisles
FLOOR, TOP = 4.5, 9.0        # heights of the upper floor and of the walls
FRONT = BAY * BAYS / 2


def merged(shapes):
    """One shape of several, each with the place that it is moved to."""
    s = Shape()
    for part, at in shapes:
        first = len(s.positions)
        s.positions += [[rounded(c + d) for c, d in zip(p, at)] for p in part.positions]
        s.normals += part.normals
        s.triangles += [tuple(first + i for i in t) for t in part.triangles]
    return s


def tiles(columns, rows, size, gap, height):
    """Tiles with sloped sides, on y = 0: the court's floor."""
    s = Shape()
    for i in range(columns):
        for j in range(rows):
            x, z = size * (i - columns / 2), size * (j - rows / 2)
            a, b, c, d = x + gap, x + size - gap, z + gap, z + size - gap
            e = 2 * gap
            low = [(a, 0.0, d), (b, 0.0, d), (b, 0.0, c), (a, 0.0, c)]
            high = [(a + e, height, d - e), (b - e, height, d - e), (b - e, height, c + e), (a + e, height, c + e)]
            s.quad(*high)
            for k in range(4):
                s.quad(low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k])
    return s


def curtain(folds, width, height, columns, rows):
    """Cloth that hangs from y = 0 in z = 0, faces +z, and is gathered at two thirds of its height."""
    def point(u, v):
        y = -height * (1 - v)
        gathered = 1 - 0.35 * math.exp(-((v - 0.35) / 0.18) ** 2)
        swing = 0.05 + 0.05 * (1 - v)
        a = 2 * math.pi * folds * u
        return [width * (u - 0.5) * gathered, y, swing * math.sin(a + 0.6 * math.sin(3 * v)) + 0.02 * math.sin(2.3 * a + 5 * v)]

    def at(u, v):
        h = 1e-4
        du = [b - a for a, b in zip(point(u - h, v), point(u + h, v))]
        dv = [b - a for a, b in zip(point(u, v - h), point(u, v + h))]
        return point(u, v), [du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2], du[0] * dv[1] - du[1] * dv[0]]
    s = Shape()
    s.grid(columns, rows, at)
    return s


def plant(leaves, segments):
    """Bent blades that grow from the origin, in a spiral."""
    s = Shape()
    for k in range(leaves):
        turn = 2.399963 * k  # the golden angle
        reach, rise = 0.25 + 0.35 * (k + 1) / leaves, 0.75 - 0.45 * (k + 1) / leaves
        c, d = math.cos(turn), math.sin(turn)

        def at(u, v, c=c, d=d, reach=reach, rise=rise):
            r, y = reach * v, rise * (2 * v - v * v) - 0.25 * v ** 3
            side = 0.11 * (u - 0.5) * math.sin(math.pi * min(0.12 + 0.88 * v, 1.0))
            slope = (2 * rise * (1 - v) - 0.75 * v * v) / reach
            return (r * c - side * d, y, r * d + side * c), (-slope * c, 1.0, -slope * d)
        s.grid(2, segments, at)
    return s


def lantern(links):
    """A lamp's brass body below a chain; its top is the origin."""
    def link(turned):
        def path(t):
            a = 2 * math.pi * t
            x, y = 0.022 * math.cos(a), 0.04 * math.sin(a)
            return [0.0, y, x] if turned else [x, y, 0.0]
        return tube(path, 0.007, 16, 8)

    def body(v):
        return 0.02 + 0.16 * math.sin(math.pi * (0.06 + 0.88 * v)) ** 0.7, 0.5 * v - 0.5
    parts = [(link(k % 2 == 1), (0.0, -0.04 - 0.066 * k, 0.0)) for k in range(links)]
    return merged(parts + [(lathe(body, 24, 16), (0.0, -0.066 * links, 0.0))])


def add_arcades(g, stone, marble):
    """The columns, arches, galleries and balustrades of both long sides and of both ends."""
    def profile(height, radius):
        return lambda v: (radius - 0.15 * radius * v + 0.45 * radius * (math.exp(-(v / 0.04) ** 2) + math.exp(-((v - 1) / 0.05) ** 2)), height * v)
    low = g.mesh("column", lathe(profile(2.8, 0.26), 48, 16, flutes=16, depth=0.08), marble)
    high = g.mesh("upper column", lathe(profile(2.2, 0.19), 32, 12), stone)
    block = g.mesh("block", box(-0.4, -0.12, -0.4, 0.4, 0.0, 0.4), stone)
    panel = g.mesh("arch", arch(BAY, 1.5, 0.9, 0.5, 24), stone)
    baluster = lathe(lambda v: (0.035 + 0.03 * math.sin(math.pi * v) * (1.4 - v), 0.7 * v), 12, 10)
    railing = g.mesh("railing", merged([(baluster, (0.3 * (k - 3.5), 0.0, 0.0)) for k in range(8)] +
                                       [(box(-BAY / 2, 0.7, -0.09, BAY / 2, 0.82, 0.09), (0.0, 0.0, 0.0))]), marble)
    dentils = g.mesh("dentils", merged([(box(-0.07, -0.14, -0.3, 0.07, 0.0, 0.3), (0.24 * (k - 4.5), 0.0, 0.0)) for k in range(10)]), stone)
    along = [(x, FRONT - BAY * i, x, FRONT - BAY * (i + 0.5), i < BAYS) for x in (-HALF_COURT, HALF_COURT) for i in range(BAYS + 1)]
    across = [(BAY * (i - 1.5), z, BAY * (i - 1), z, i < 3) for z in (-FRONT, FRONT) for i in range(4)]
    for row, turn in ((along, [0.0, HALF, 0.0, HALF]), (across, [0.0, 0.0, 0.0, 1.0])):
        for x, z, mx, mz, bay in row:
            x, z, mx, mz = (rounded(c) for c in (x, z, mx, mz))
            if row is along or abs(x) < HALF_COURT - 0.1:
                g.node("column", mesh=low, translation=[x, 0.0, z])
                g.node("head", mesh=block, translation=[x, 2.92, z])
                g.node("upper column", mesh=high, translation=[x, FLOOR, z])
                g.node("upper head", mesh=block, translation=[x, FLOOR + 2.32, z])
            if bay:
                g.node("arch", mesh=panel, translation=[mx, 2.92, mz], rotation=turn)
                g.node("upper arch", mesh=panel, translation=[mx, FLOOR + 2.32, mz], rotation=turn)
                g.node("railing", mesh=railing, translation=[mx, FLOOR, mz], rotation=turn)
                g.node("dentils", mesh=dentils, translation=[mx, FLOOR - 0.06, mz], rotation=turn)


def add_walls(g, stone, floor):
    """The floor, the galleries, the outer walls and the roofs of the aisles."""
    x, z = HALF_COURT + AISLE, FRONT + AISLE
    g.node("ground", mesh=g.mesh("ground", plate((-x, -0.01, z), (x, -0.01, z), (x, -0.01, -z), (-x, -0.01, -z)), stone))
    g.node("tiles", mesh=g.mesh("tiles", tiles(22, 46, 0.6, 0.004, 0.006), floor))
    for name, corners in (("left", ((-x, 0, z), (-x, 0, -z), (-x, TOP, -z), (-x, TOP, z))), ("right", ((x, 0, -z), (x, 0, z), (x, TOP, z), (x, TOP, -z))),
                          ("far", ((-x, 0, -z), (x, 0, -z), (x, TOP, -z), (-x, TOP, -z))), ("near", ((x, 0, z), (-x, 0, z), (-x, TOP, z), (x, TOP, z)))):
        g.node(name + " wall", mesh=g.mesh(name + " wall", plate(*corners), stone))
    for level, y in (("gallery", FLOOR - 0.08), ("roof", TOP - 0.2)):
        for name, (x0, x1, z0, z1) in (("left", (-x, 0.25 - HALF_COURT, -z, z)), ("right", (HALF_COURT - 0.25, x, -z, z)),
                                       ("far", (-HALF_COURT, HALF_COURT, -z, 0.25 - FRONT)), ("near", (-HALF_COURT, HALF_COURT, FRONT - 0.25, z))):
            g.node(level + " " + name, mesh=g.mesh(level + " " + name, box(x0, y, z0, x1, y + 0.08, z1), stone))


def atrium():
    g = Gltf()
    stone, marble = g.diffuse("stone", (0.71, 0.66, 0.58)), g.material("marble", (0.78, 0.75, 0.70), 0.0, 0.35)
    brass = g.material("brass", (0.90, 0.70, 0.40), 1.0, 0.3)
    add_walls(g, stone, g.material("polished tiles", (0.44, 0.40, 0.36), 0.0, 0.2))
    add_arcades(g, stone, marble)
    cloth = curtain(7, 1.9, 2.7, 80, 40)
    dyes = [g.diffuse(name, color) for name, color in (("red cloth", (0.62, 0.08, 0.06)), ("green cloth", (0.10, 0.40, 0.12)), ("blue cloth", (0.08, 0.16, 0.55)))]
    first = g.mesh("curtain", cloth, dyes[0])
    curtains = [first] + [g.with_material("curtain %d" % i, first, dyes[i]) for i in (1, 2)]
    for i in range(5):
        for side, turn in ((-1.0, HALF), (1.0, -HALF)):
            g.node("curtain", mesh=curtains[(i + (side > 0)) % 3], translation=[rounded(side * HALF_COURT), 2.85, rounded(FRONT - BAY * (2 * i + 0.5))],
                   rotation=[0.0, turn, 0.0, HALF])
    vase = g.mesh("vase", lathe(lambda v: (0.06 + 0.34 * math.sin(math.pi * (0.12 + 0.76 * v)) ** 1.4, 0.7 * v), 40, 24), brass)
    green = g.mesh("plant", plant(48, 10), g.material("leaf", (0.10, 0.30, 0.07), 0.0, 0.45))
    hanging = g.mesh("lantern", lantern(14), brass)
    for i in range(4):
        for x in (-2.5, 2.5):
            z = rounded(FRONT - BAY * (2 * i + 1.5))
            g.node("vase", mesh=vase, translation=[x, 0.006, z])
            g.node("plant", mesh=green, translation=[x, 0.6, z])
            g.node("lantern", mesh=hanging, translation=[rounded(x * 2.0), FLOOR - 0.08, z])
    g.light("KHR_lights_punctual", "sun",
            {"type": "spot", "color": [1.0, 0.92, 0.78], "intensity": 16000.0, "spot": {"innerConeAngle": 0.26, "outerConeAngle": 0.30}},
            matrix=looking([8.0, 24.0, 5.0], [-1.2, 0.0, -2.5]))
    g.area_light("sky", {"type": "rect", "color": [0.55, 0.72, 1.0], "intensity": 1.4, "size": 7.0, "rect": {"aspect": 3.0}},
                 translation=[0.0, 9.4, 0.0], rotation=[-0.5, 0.5, 0.5, 0.5])
    g.camera("main", [1.3, 1.8, 9.4], [-0.6, 2.6, -4.0], 0.95)
    return g


SCENES = {"atrium": atrium}
