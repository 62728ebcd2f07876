"""Rooms of glass and mirrors, whose things see each other."""

import math

from gltf_writer import DOWN, Gltf, Shape, box, lathe, plate, png, sphere, tube


def shell(g, w, d, h):
    """The walls of a room of half width w, half depth d and height h, and a floor of light and dark tiles."""
    white, red, blue = g.diffuse("white", (0.75, 0.74, 0.72)), g.diffuse("red", (0.6, 0.12, 0.1)), g.diffuse("blue", (0.12, 0.2, 0.55))
    dark = g.diffuse("dark", (0.15, 0.14, 0.13))
    for name, corners, material in (
            ("ceiling", ((-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d)), white),
            ("back", ((-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)), white),
            ("left", ((-w, 0, d), (-w, 0, -d), (-w, h, -d), (-w, h, d)), red),
            ("right", ((w, 0, -d), (w, 0, d), (w, h, d), (w, h, -d)), blue),
            ("front", ((w, 0, d), (-w, 0, d), (-w, h, d), (w, h, d)), white)):
        g.node(name, mesh=g.mesh(name, plate(*corners), material))
    for color, material in (("light", white), ("dark", dark)):
        tiles = Shape()
        n = 8
        for i in range(n):
            for j in range(n):
                if (i + j) % 2 != (color == "dark"):
                    continue
                x0, x1, z0, z1 = -w + 2 * w * i / n, -w + 2 * w * (i + 1) / n, -d + 2 * d * j / n, -d + 2 * d * (j + 1) / n
                tiles.quad((x0, 0, z1), (x1, 0, z1), (x1, 0, z0), (x0, 0, z0))
        g.node(color + " tiles", mesh=g.mesh(color + " tiles", tiles, material))


def transmitting(g, name, color, thickness, **volume):
    """Glass: a thin wall, or a solid if it has a thickness."""
    material = g.material(name, color, 0.0, 0.0)
    g.use("KHR_materials_transmission")
    extensions = g.json["materials"][material].setdefault("extensions", {})
    extensions["KHR_materials_transmission"] = {"transmissionFactor": 1.0}
    if thickness > 0:
        g.use("KHR_materials_volume")
        g.use("KHR_materials_ior")
        extensions["KHR_materials_volume"] = {"thicknessFactor": thickness, **volume}
        extensions["KHR_materials_ior"] = {"ior": 1.5}
    return material


def torus(across, thick):
    """A ring about the y axis."""
    def path(t):
        return [across * math.cos(2 * math.pi * t), 0.0, across * math.sin(2 * math.pi * t)]
    return tube(path, thick, 64, 24)


def glass():
    """Balls of glass and chrome, a block of green glass, a thin pane and a torus in a room with a lamp."""
    g = Gltf()
    shell(g, 1.6, 1.6, 2.2)
    ball = g.mesh("glass ball", sphere(96, 48), transmitting(g, "glass", (1.0, 1.0, 1.0), 1.0))
    g.node("glass ball", mesh=ball, translation=[-0.45, 0.35, 0.35], scale=[0.35, 0.35, 0.35])
    chrome = g.with_material("chrome ball", ball, g.material("chrome", (0.9, 0.9, 0.9), 1.0, 0.0))
    g.node("chrome ball", mesh=chrome, translation=[0.6, 0.4, -0.5], scale=[0.4, 0.4, 0.4])
    green = transmitting(g, "green glass", (1.0, 1.0, 1.0), 1.0, attenuationColor=[0.3, 0.8, 0.4], attenuationDistance=0.3)
    g.node("block", mesh=g.mesh("block", box(0.35, 0.001, 0.35, 0.65, 0.4, 0.65), green))
    g.node("pane", mesh=g.mesh("pane", plate((-1.3, 0.0, -0.3), (-0.6, 0.0, -0.6), (-0.6, 0.9, -0.6), (-1.3, 0.9, -0.3)),
                               transmitting(g, "pane", (0.9, 0.75, 0.4), 0.0)))
    g.node("torus", mesh=g.mesh("torus", torus(0.22, 0.07), g.material("copper", (0.8, 0.45, 0.3), 1.0, 0.12)), translation=[0.05, 0.071, 0.75])
    g.area_light("lamp", {"type": "rect", "color": [1.0, 0.95, 0.88], "intensity": 40.0, "size": 0.8, "rect": {"aspect": 1.0}},
                 translation=[0.0, 2.19, 0.0], rotation=DOWN)
    g.camera("main", [0.2, 1.0, 1.55], [0.0, 0.5, -0.2], 0.95)
    return g


# Places of a face on the unit sphere about the middle of the head, their widths across and up, and how far each stands out.
FEATURES = (((0.0, -0.04, 1.0), 0.13, 0.26, 0.16), ((0.0, -0.17, 1.0), 0.16, 0.1, 0.14),  # the nose and its tip
            ((0.34, 0.13, 0.93), 0.2, 0.13, -0.09), ((-0.34, 0.13, 0.93), 0.2, 0.13, -0.09),  # sockets of the eyes
            ((0.33, 0.11, 0.93), 0.1, 0.07, 0.07), ((-0.33, 0.11, 0.93), 0.1, 0.07, 0.07),  # the eyes
            ((0.0, 0.3, 0.95), 0.5, 0.09, 0.05), ((0.0, -0.4, 0.92), 0.22, 0.05, 0.05),  # the brow, the upper lip,
            ((0.0, -0.49, 0.88), 0.2, 0.05, 0.05), ((0.0, -0.78, 0.7), 0.26, 0.17, 0.12),  # the lower lip, the chin
            ((0.45, -0.2, 0.85), 0.25, 0.2, 0.03), ((-0.45, -0.2, 0.85), 0.25, 0.2, 0.03))  # the cheeks


def head():
    """A head of height 0.3 on a neck, whose face looks along +z."""
    def out(u, v):
        theta, phi = math.pi * (1 - v), 2 * math.pi * u
        x, y, z = math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi)
        r = 1.0
        for (fx, fy, fz), across, up, height in FEATURES:
            r += height * math.exp(-((x - fx) / across) ** 2 - ((y - fy) / up) ** 2) * (z > 0) * min(1.0, 2 * z)
        ear = math.exp(-((y + 0.02) / 0.2) ** 2 - ((z + 0.1) / 0.12) ** 2)
        narrow = 1 + 0.16 * y  # towards the chin
        return [0.098 * x * narrow * (r + 0.22 * ear), 0.145 * y * (1 + 0.05 * (r - 1)), 0.12 * z * (r - 0.06 * y * (z < 0))]

    def at(u, v):
        h = 1e-4
        du = [b - a for a, b in zip(out(u - h, v), out(u + h, v))]
        dv = [b - a for a, b in zip(out(u, max(v - h, 1e-3)), out(u, min(v + h, 1 - 1e-3)))]
        n = [du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2], du[0] * dv[1] - du[1] * dv[0]]
        return out(u, v), n if 0 < v < 1 else [0.0, 2 * v - 1, 0.0]
    s = Shape()
    s.grid(88, 64, at)
    return s


def still_life():
    """Balls of chrome and glass, a head, a box with a picture, a glossy torus and a glowing ball in a room with a lamp."""
    g = Gltf()
    shell(g, 1.6, 1.6, 2.2)
    ball = g.mesh("glass ball", sphere(96, 48), transmitting(g, "glass", (1.0, 1.0, 1.0), 1.0))
    g.node("glass ball", mesh=ball, translation=[-0.68, 0.3, 0.1], scale=[0.3, 0.3, 0.3])
    chrome = g.with_material("chrome ball", ball, g.material("chrome", (0.9, 0.9, 0.9), 1.0, 0.0))
    g.node("chrome ball", mesh=chrome, translation=[0.78, 0.38, -0.75], scale=[0.38, 0.38, 0.38])
    glowing = g.with_material("glowing ball", ball, g.material("glow", (0.0, 0.0, 0.0), emission=(9.0, 5.2, 2.2), specular=0.0))
    g.node("glowing ball", mesh=glowing, translation=[0.26, 0.1, 0.22], scale=[0.1, 0.1, 0.1])
    plaster = g.material("plaster", (0.78, 0.74, 0.68), 0.0, 0.5)
    g.node("head", mesh=g.mesh("head", head(), plaster), translation=[-0.1, 0.875, -0.7], rotation=[0.0, 0.13, 0.0, 0.9915], scale=[1.5, 1.5, 1.5])
    neck = lathe(lambda v: (0.08 + 0.12 * (1 - v) ** 4, 0.5 + 0.28 * v), 48, 16)
    g.node("neck", mesh=g.mesh("neck", neck, plaster), translation=[-0.1, 0.0, -0.74])
    g.node("plinth", mesh=g.mesh("plinth", box(-0.33, 0.0, -0.97, 0.13, 0.5, -0.51), g.diffuse("plinth", (0.45, 0.46, 0.48))))

    def blocks(x, y):
        ring = math.hypot((x % 16) - 7.5, (y % 16) - 7.5) < 5.2
        warm = (x // 16 + y // 16) % 2
        return ((225, 170, 60), (40, 75, 110))[warm] if ring else ((60, 40, 35), (215, 205, 185))[warm]
    picture = box(-0.2, 0.0, -0.2, 0.2, 0.4, 0.2)
    picture.texcoords = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)] * 6
    printed = g.diffuse("printed", (1.0, 1.0, 1.0))
    g.picture("blocks", png(64, 64, blocks), printed, "baseColorTexture")
    turn = math.radians(28) / 2
    g.node("box", mesh=g.mesh("box", picture, printed), translation=[0.68, 0.0, 0.05], rotation=[0.0, round(math.sin(turn), 6), 0.0, round(math.cos(turn), 6)])
    g.node("torus", mesh=g.mesh("torus", torus(0.2, 0.065), g.material("lacquer", (0.5, 0.03, 0.05), 0.0, 0.15)), translation=[-0.17, 0.066, 0.06])
    g.area_light("lamp", {"type": "rect", "color": [1.0, 0.95, 0.88], "intensity": 40.0, "size": 0.8, "rect": {"aspect": 1.0}},
                 translation=[0.0, 2.19, 0.0], rotation=DOWN)
    g.camera("main", [0.12, 1.0, 1.55], [0.03, 0.5, -0.2], 0.9)
    return g


SCENES = {"glass": glass, "still_life": still_life}
