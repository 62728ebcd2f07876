"""Scenes that judge all the light between surfaces: a Cornell box, a furnished room and a colonnade under the sun."""

import math

from gltf_writer import DOWN, Gltf, Shape, box, lathe, looking, plate, rounded, sphere

PALE = (0.73, 0.73, 0.73)


def turned(angle, x, y, z):
    """Translation and rotation about y of a node, in degrees."""
    half = math.radians(angle) / 2
    return {"translation": [rounded(x), rounded(y), rounded(z)], "rotation": [0.0, rounded(math.sin(half)), 0.0, rounded(math.cos(half))]}


def cornell():
    """The box of Cornell, 5.5 m wide and open in front, with two turned boxes."""
    g, w = Gltf(), 2.75
    white, red, green = g.diffuse("white", PALE), g.diffuse("red", (0.63, 0.065, 0.05)), g.diffuse("green", (0.14, 0.45, 0.091))
    for name, material, corners in (("floor", white, ((-w, 0, w), (w, 0, w), (w, 0, -w), (-w, 0, -w))),
                                    ("ceiling", white, ((-w, 5.5, -w), (w, 5.5, -w), (w, 5.5, w), (-w, 5.5, w))),
                                    ("back", white, ((-w, 0, -w), (w, 0, -w), (w, 5.5, -w), (-w, 5.5, -w))),
                                    ("left", red, ((-w, 0, w), (-w, 0, -w), (-w, 5.5, -w), (-w, 5.5, w))),
                                    ("right", green, ((w, 0, -w), (w, 0, w), (w, 5.5, w), (w, 5.5, -w)))):
        g.node(name, mesh=g.mesh(name, plate(*corners), material))
    for name, height, angle, x, z in (("tall box", 3.3, 17.0, -0.92, -0.75), ("short box", 1.65, -17.0, 0.92, 1.05)):
        g.node(name, mesh=g.mesh(name, box(-0.825, 0, -0.825, 0.825, height, 0.825), white), **turned(angle, x, 0, z))
    g.area_light("lamp", {"type": "rect", "color": [1.0, 0.8, 0.5], "intensity": 17.0, "size": 1.05, "rect": {"aspect": 1.238}},
                 translation=[0.0, 5.49, 0.0], rotation=DOWN)
    g.camera("main", [0.0, 2.75, 10.2], [0.0, 2.75, 0.0], 0.69)
    return g


def cushion(width, height, depth, n):
    """A box with round edges: a superellipsoid of exponents 0.3."""
    def power(x):
        return math.copysign(abs(x) ** 0.3, x)

    def at(u, v):
        theta, phi = math.pi * (v - 0.5), 2 * math.pi * u
        c, s = math.cos(theta), math.sin(theta)
        p = (power(c) * power(math.sin(phi)), power(s), power(c) * power(math.cos(phi)))
        q = [math.copysign(abs(t) ** (2 / 0.3 - 1), t) for t in p]
        return ([p[0] * width / 2, p[1] * height / 2, p[2] * depth / 2], [q[0] / width, q[1] / height, q[2] / depth])
    s = Shape()
    s.grid(2 * n, n, at)
    return s


def bar(a, b, radius, columns=12):
    """A round bar from a to b, without ends."""
    def path(t):
        return [a[i] + t * (b[i] - a[i]) for i in range(3)]
    axis = [b[i] - a[i] for i in range(3)]
    least = min(range(3), key=lambda i: abs(axis[i]))
    other = [1.0 if i == least else 0.0 for i in range(3)]

    def cross(p, q):
        return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]

    def unit(p):
        length = math.sqrt(sum(c * c for c in p))
        return [c / length for c in p]
    e = unit(cross(axis, other))
    f = unit(cross(axis, e))
    s = Shape()

    def at(u, v):
        n = [math.cos(2 * math.pi * u) * e[i] + math.sin(2 * math.pi * u) * f[i] for i in range(3)]
        return [path(v)[i] + radius * n[i] for i in range(3)], n
    s.grid(columns, 4, at)
    return s


def joined(shapes):
    s = Shape()
    for one in shapes:
        first = len(s.positions)
        s.positions += one.positions
        s.normals += one.normals
        s.triangles += [tuple(first + i for i in t) for t in one.triangles]
    return s


def chair():
    """A chair of round bars with a thin seat."""
    parts = [box(-0.21, 0.43, -0.21, 0.21, 0.46, 0.21)]
    for x in (-0.19, 0.19):
        parts += [bar((x, 0, 0.19), (x, 0.43, 0.19), 0.018), bar((x, 0, -0.19), (x, 0.95, -0.24), 0.018)]
        parts += [bar((x, 0.2, -0.2), (x, 0.2, 0.19), 0.01)]
    parts += [bar((-0.19, y, z), (0.19, y, z), 0.012) for y, z in ((0.92, -0.238), (0.7, -0.222), (0.25, 0.19))]
    parts += [bar((x, 0.46, -0.2), (x, 0.92, -0.238), 0.008) for x in (-0.12, -0.06, 0.0, 0.06, 0.12)]
    return joined(parts)


def leaves(stems, seed):
    """Bent leaves about stems: four triangles a leaf."""
    s, state = Shape(), seed

    def chance():
        nonlocal state
        state = (1103515245 * state + 12345) % 2147483648
        return state / 2147483648
    for _ in range(stems):
        around, out, up, size = 2 * math.pi * chance(), 0.05 + 0.3 * chance(), 0.45 + 0.75 * chance(), 0.10 + 0.12 * chance()
        c, d = math.cos(around), math.sin(around)
        droop = 0.3 * size + 0.5 * size * chance()
        middle = [out * c, up, out * d]
        tip = [(out + size) * c, up - droop, (out + size) * d]
        bend = [(out + size / 2) * c, up + 0.02, (out + size / 2) * d]
        wide = size * 0.22
        a, b = ([bend[0] + k * wide * -d, bend[1] - 0.015, bend[2] + k * wide * c] for k in (-1, 1))
        for triangle in ((middle, bend, a), (middle, b, bend), (bend, tip, a), (bend, b, tip)):
            u = [triangle[1][i] - triangle[0][i] for i in range(3)]
            v = [triangle[2][i] - triangle[0][i] for i in range(3)]
            n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            s.triangles.append(tuple(s.vertex(p, n) for p in triangle))
    return s


def furnished():
    """A furnished room of 64,000 triangles: table and chairs, a shelf with books, a sofa, a lamp with a shade, two plants."""
    g = Gltf()
    wall, wood = g.diffuse("wall", (0.78, 0.76, 0.72)), g.diffuse("wood", (0.45, 0.29, 0.17))
    w, d, h = 2.6, 2.1, 2.6  # half width, half depth, height
    y0, y1, x0, x1 = 0.9, 2.1, -1.2, 1.0  # the window, in the wall behind
    for name, material, corners in (("floor", g.diffuse("floor", (0.48, 0.36, 0.25)), ((-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d))),
                                    ("ceiling", wall, ((-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d))),
                                    ("left", wall, ((-w, 0, d), (-w, 0, -d), (-w, h, -d), (-w, h, d))),
                                    ("right", wall, ((w, 0, -d), (w, 0, d), (w, h, d), (w, h, -d))),
                                    ("front", wall, ((w, 0, d), (-w, 0, d), (-w, h, d), (w, h, d))),
                                    ("below the window", wall, ((-w, 0, -d), (w, 0, -d), (w, y0, -d), (-w, y0, -d))),
                                    ("above the window", wall, ((-w, y1, -d), (w, y1, -d), (w, h, -d), (-w, h, -d))),
                                    ("left of the window", wall, ((-w, y0, -d), (x0, y0, -d), (x0, y1, -d), (-w, y1, -d))),
                                    ("right of the window", wall, ((x1, y0, -d), (w, y0, -d), (w, y1, -d), (x1, y1, -d)))):
        g.node(name, mesh=g.mesh(name, plate(*corners), material))
    g.area_light("sky", {"type": "rect", "color": [0.8, 0.9, 1.0], "intensity": 60.0, "size": 1.2, "rect": {"aspect": 11 / 6}},
                 translation=[-0.1, 1.5, -2.11], rotation=[0.0, 1.0, 0.0, 0.0])

    top = lathe(lambda v: (0.6 * (1 - abs(2 * v - 1) ** 8) ** 0.125, 0.71 + 0.04 * v), 96, 8)
    feet = joined([bar((0.42 * c, 0, 0.42 * s), (0.3 * c, 0.71, 0.3 * s), 0.028, 24)
                   for c, s in ((math.cos(a), math.sin(a)) for a in (0.8, 2.37, 3.94, 5.51))])
    g.node("table top", mesh=g.mesh("table top", top, wood), translation=[0.75, 0.0, -0.35])
    g.node("table feet", mesh=g.mesh("table feet", feet, wood), translation=[0.75, 0.0, -0.35])
    seat = g.mesh("chair", chair(), g.diffuse("beech", (0.62, 0.47, 0.3)))
    for i, angle in enumerate((15.0, 100.0, 192.0, 281.0)):
        a = math.radians(angle)
        g.node("chair %d" % i, mesh=seat, **turned(angle + 180, 0.75 + 0.72 * math.sin(a), 0, -0.35 + 0.72 * math.cos(a)))
    bowl = lathe(lambda v: (0.03 + 0.13 * math.sin(1.5 * v), 0.75 + 0.08 * v * v), 64, 24)
    g.node("bowl", mesh=g.mesh("bowl", bowl, g.diffuse("glaze", (0.25, 0.45, 0.5))), translation=[0.7, 0.0, -0.3])

    g.node("shelf", mesh=g.mesh("shelf", joined([box(-0.02, 0, -0.6, 0.0, 1.9, 0.6), box(0, 0, -0.6, 0.28, 1.9, -0.58), box(0, 0, 0.58, 0.28, 1.9, 0.6)] +
                                                [box(0, y, -0.58, 0.28, y + 0.02, 0.58) for y in (0.05, 0.42, 0.79, 1.16, 1.53, 1.88)]), wood),
           translation=[-2.57, 0.0, -0.9])
    covers = [g.diffuse("cover %d" % i, c) for i, c in enumerate(((0.55, 0.13, 0.1), (0.12, 0.2, 0.42), (0.7, 0.62, 0.45), (0.16, 0.33, 0.2)))]
    books = [[] for _ in covers]
    for row, y in enumerate((0.07, 0.44, 0.81, 1.18, 1.55)):
        z, k = -0.57, 0
        while z < 0.42:
            thick, tall, deep = 0.018 + 0.006 * ((5 * k + 3 * row) % 5), 0.2 + 0.025 * ((7 * k + row) % 4), 0.16 + 0.02 * ((3 * k + row) % 3)
            books[(k + 2 * row) % 4].append(box(0.01, y, z, 0.01 + deep, y + tall, z + thick))
            z += thick + 0.002
            k += 1
    for i, shapes in enumerate(books):
        g.node("books %d" % i, mesh=g.mesh("books %d" % i, joined(shapes), covers[i]), translation=[-2.57, 0.0, -0.9])

    cloth = g.diffuse("cloth", (0.33, 0.38, 0.42))
    big, back, arm = (g.mesh(name, cushion(*size, n), cloth) for name, size, n in
                      (("seat", (0.8, 0.24, 0.75), 35), ("back", (0.8, 0.5, 0.24), 35), ("arm", (0.2, 0.55, 0.85), 35)))
    for i in range(2):
        g.node("seat %d" % i, mesh=big, translation=[-0.95 + 0.8 * i, 0.32, 1.55])
        g.node("back %d" % i, mesh=back, translation=[-0.95 + 0.8 * i, 0.62, 1.93])
        g.node("arm %d" % i, mesh=arm, translation=[-1.45 + 1.8 * i, 0.33, 1.6])
    g.node("sofa base", mesh=g.mesh("sofa base", box(-1.35, 0.06, 1.25, 0.25, 0.2, 2.0), cloth))

    metal = g.diffuse("stand", (0.3, 0.3, 0.32))
    g.node("stand", mesh=g.mesh("stand", bar((0, 0.02, 0), (0, 1.5, 0), 0.012, 24), metal), translation=[0.75, 0.0, 1.7])
    g.node("foot", mesh=g.mesh("foot", lathe(lambda v: (0.16 * (1 - v) + 0.012, 0.025 * v), 64, 4), metal), translation=[0.75, 0.0, 1.7])
    for name, side in (("shade", 1.0), ("lining", 0.985)):
        shade = lathe(lambda v: (side * (0.24 - 0.09 * v), 1.4 + 0.3 * v), 96, 8)
        if name == "lining":
            shade.triangles = [(a, c, b) for a, b, c in shade.triangles]
            shade.normals = [[-c for c in n] for n in shade.normals]
        g.node(name, mesh=g.mesh(name, shade, g.diffuse(name, (0.8, 0.74, 0.6))), translation=[0.75, 0.0, 1.7])
    g.area_light("bulb", {"type": "sphere", "color": [1.0, 0.78, 0.5], "intensity": 900.0, "size": 0.09}, translation=[0.75, 1.56, 1.7])

    pot = lathe(lambda v: (0.13 + 0.05 * v, 0.3 * v), 64, 24)
    green, clay = g.diffuse("leaf", (0.1, 0.27, 0.07)), g.diffuse("clay", (0.5, 0.25, 0.15))
    for i, (x, z) in enumerate(((-2.0, 0.9), (2.0, -1.5))):
        g.node("pot %d" % i, mesh=g.mesh("pot %d" % i, pot, clay), translation=[x, 0.0, z])
        g.node("earth %d" % i, mesh=g.mesh("earth %d" % i, lathe(lambda v: (0.172 * (1 - v), 0.27 + 0.02 * v), 64, 2), clay), translation=[x, 0.0, z])
        g.node("plant %d" % i, mesh=g.mesh("plant %d" % i, leaves(1100, 7 + i), green), translation=[x, 0.0, z])
    g.camera("main", [2.2, 1.55, 1.9], [-0.7, 0.75, -0.9], 1.0)
    g.camera("shelf", [-0.6, 1.2, -0.9], [-2.6, 0.9, -0.9], 0.8)
    return g


def colonnade():
    """A row of fluted columns before a wall, in the sun; the sky comes from --environment sky."""
    g = Gltf()
    stone = g.diffuse("stone", (0.74, 0.68, 0.58))

    def profile(v):
        base = 0.1 * math.exp(-(v / 0.03) ** 2) + 0.12 * math.exp(-((v - 1) / 0.035) ** 2)
        return 0.36 - 0.06 * v + base, 3.6 * v
    column = g.mesh("column", lathe(profile, 96, 32, flutes=16, depth=0.08), stone)
    block = g.mesh("block", box(-0.55, -0.15, -0.55, 0.55, 0.0, 0.55), stone)
    for i in range(7):
        x = -6.6 + 2.2 * i
        g.node("column %d" % i, mesh=column, translation=[rounded(x), 0.3, 0.0])
        g.node("foot %d" % i, mesh=block, translation=[rounded(x), 0.3, 0.0])
        g.node("head %d" % i, mesh=block, translation=[rounded(x), 4.05, 0.0])
    for name, corners in (("beam", (-7.6, 4.05, -0.55, 7.6, 4.9, 0.55)), ("steps", (-8.2, 0.0, -4.0, 8.2, 0.15, 1.0)),
                          ("wall", (-7.6, 0.15, -4.0, 7.6, 4.9, -3.6)), ("roof", (-7.9, 4.9, -4.2, 7.9, 5.2, 0.8))):
        g.node(name, mesh=g.mesh(name, box(*corners), stone))
    g.node("ground", mesh=g.mesh("ground", plate((-30, 0, 30), (30, 0, 30), (30, 0, -30), (-30, 0, -30)), g.diffuse("gravel", (0.45, 0.4, 0.33))))
    g.light("KHR_lights_punctual", "sun", {"type": "directional", "color": [1.0, 0.93, 0.82], "intensity": 12.0},
            matrix=looking([5.0, 6.0, 7.0], [0.0, 0.0, 0.0]))
    g.camera("main", [-8.5, 1.7, 7.0], [0.5, 2.2, -1.2], 0.85)
    return g


SCENES = {"cornell": cornell, "furnished": furnished, "colonnade": colonnade}
