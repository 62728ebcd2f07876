#!/usr/bin/env python3
"""Makes the scenes of this folder: make_scenes.py FOLDER [gallery|hall|room ...]

Standard library only; the same bytes on every machine.
"""

import math
import os
import struct
import sys

import all_light_scenes
from gltf_writer import Gltf, Shape, box, lathe, looking, plate, png, rounded, sphere, tube

HALF = math.sqrt(0.5)
DOWN = [-HALF, 0.0, 0.0, HALF]        # rotations that turn a light's -Z: down,
TO_MINUS_X = [0.0, HALF, 0.0, HALF]   # to -x,
TO_PLUS_X = [0.0, -HALF, 0.0, HALF]   # to +x,
TO_PLUS_Z = [0.0, 1.0, 0.0, 0.0]      # to +z


def star(points, outer, inner):
    """A star in z = 0 that faces +z, ten triangles about its centre for five points."""
    s = Shape()
    center = s.vertex((0, 0, 0), (0, 0, 1))
    rim = []
    for k in range(2 * points):
        r, a = (inner if k % 2 else outer), math.pi / 2 + math.pi * k / points
        rim.append(s.vertex((r * math.cos(a), r * math.sin(a), 0), (0, 0, 1)))
    s.triangles = [(center, rim[k], rim[(k + 1) % len(rim)]) for k in range(len(rim))]
    return s


def gallery():
    g = Gltf()
    wall, side = g.diffuse("wall", (0.72, 0.69, 0.64)), g.diffuse("side wall", (0.45, 0.52, 0.56))
    floor = g.material("floor", (0.24, 0.17, 0.12), roughness=0.3)
    w, h, d = 4.0, 3.6, 4.0
    g.node("floor", mesh=g.mesh("floor", plate((-w, 0, 8), (w, 0, 8), (w, 0, -d), (-w, 0, -d)), floor))
    g.node("back wall", mesh=g.mesh("back wall", plate((-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)), wall))
    g.node("left wall", mesh=g.mesh("left wall", plate((-w, 0, 8), (-w, 0, -d), (-w, h, -d), (-w, h, 8)), side))
    g.node("right wall", mesh=g.mesh("right wall", plate((w, 0, -d), (w, 0, 8), (w, h, 8), (w, h, -d)), side))
    g.node("ceiling", mesh=g.mesh("ceiling", plate((-w, h, -d), (w, h, -d), (w, h, 8), (-w, h, 8)), wall))

    chalk = g.diffuse("plinth", (0.8, 0.78, 0.74))
    plinth = g.mesh("plinth", box(-0.35, 0, -0.35, 0.35, 0.8, 0.35), chalk)
    low = g.mesh("low plinth", box(-0.6, 0, -0.6, 0.6, 0.45, 0.6), chalk)
    for i, x in enumerate((-2.6, 2.6)):
        g.node("plinth %d" % (i + 1), mesh=plinth, translation=[x, 0.0, -1.6])
    g.node("low plinth", mesh=low, translation=[0.0, 0.0, -1.2])

    ball = g.mesh("gold ball", sphere(), g.material("gold", (0.95, 0.68, 0.28), 1.0, 0.15))
    copper = g.with_material("copper ball", ball, g.material("copper", (0.93, 0.55, 0.42), 1.0, 0.45))
    lacquer = g.with_material("lacquer ball", ball, g.material("red lacquer", (0.55, 0.03, 0.03), 0.0, 0.2))
    plaster = g.with_material("plaster ball", ball, g.diffuse("plaster", (0.75, 0.73, 0.7)))
    for name, mesh, x, y, z, r in (("gold ball", ball, 2.6, 1.15, -1.6, 0.35), ("copper ball", copper, 1.45, 0.4, 0.7, 0.4),
                                   ("lacquer ball", lacquer, -1.3, 0.3, 1.2, 0.3), ("plaster ball", plaster, -2.3, 0.45, 0.2, 0.45)):
        g.node(name, mesh=mesh, translation=[x, y, z], scale=[r, r, r])

    def vase(v):
        return 0.17 + 0.13 * math.sin(2.6 * math.pi * v * (1 - 0.35 * v)) * (1 - 0.4 * v), 0.9 * v
    g.node("vase", mesh=g.mesh("vase", lathe(vase, 56, 40), g.material("terracotta", (0.6, 0.27, 0.15), 0.0, 0.75)),
           translation=[-2.6, 0.8, -1.6])

    def knot(t):
        a = 2 * math.pi * t
        r = 0.36 + 0.15 * math.cos(3 * a)
        return [r * math.cos(2 * a), 0.15 * math.sin(3 * a), r * math.sin(2 * a)]
    g.node("knot", mesh=g.mesh("knot", tube(knot, 0.085, 288, 20), g.material("steel", (0.62, 0.64, 0.68), 1.0, 0.25)),
           translation=[0.0, 1.05, -1.2], rotation=[HALF, 0.0, 0.0, HALF])

    g.area_light("ceiling panel", {"type": "rect", "color": [1.0, 0.95, 0.88], "intensity": 6.0, "size": 0.8, "rect": {"aspect": 3.0}},
                 translation=[0.0, h - 0.02, -2.2], rotation=DOWN)
    g.node("star", translation=[0.0, 2.45, -d + 0.02],
           mesh=g.mesh("star", star(5, 0.72, 0.3), g.material("star", (0.0, 0.0, 0.0), emission=(9.0, 6.2, 2.6), specular=0.0)))
    g.area_light("disk", {"type": "disk", "color": [0.45, 0.68, 1.0], "intensity": 7.0, "size": 1.0},
                 translation=[-w + 0.02, 2.1, -2.3], rotation=TO_PLUS_X)
    g.area_light("lamp", {"type": "sphere", "color": [1.0, 0.55, 0.3], "intensity": 14.0, "size": 0.36},
                 translation=[2.45, 0.4, 0.5])
    g.camera("main", [0.35, 1.65, 6.6], [0.0, 1.25, -1.2], 0.62)
    return g


def morph():
    """A light whose outline changes in four seconds from a star into a disk and back, turns and changes colour, over a polished floor."""
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)), g.material("floor", (0.3, 0.28, 0.26), roughness=0.14)))
    g.node("wall", mesh=g.mesh("wall", plate((-6, 0, -1.6), (6, 0, -1.6), (6, 5, -1.6), (-6, 5, -1.6)), g.diffuse("wall", (0.6, 0.6, 0.62))))
    ball = g.mesh("ball", sphere(), g.material("copper", (0.93, 0.55, 0.42), 1.0, 0.35))
    g.node("ball", mesh=ball, translation=[-1.0, 0.4, 0.1], scale=[0.4, 0.4, 0.4])
    g.node("box", mesh=g.mesh("box", box(-0.3, 0, -0.3, 0.3, 0.7, 0.3), g.diffuse("chalk", (0.8, 0.78, 0.74))), translation=[1.0, 0.0, 0.0])

    # The star with four points on each edge; the morph takes each to the circle, at even steps of the angle.
    shape, steps, corners = Shape(), 4, []
    for k in range(10):
        r, a = (0.3 if k % 2 else 0.75), math.pi / 2 + math.pi * k / 5
        corners.append((r * math.cos(a), r * math.sin(a)))
    center, rim, moves = shape.vertex((0, 0, 0), (0, 0, 1)), [], [(0.0, 0.0, 0.0)]
    for k in range(10 * steps):
        (x0, y0), (x1, y1), s = corners[k // steps], corners[(k // steps + 1) % 10], k % steps / steps
        x, y, a = rounded(x0 + s * (x1 - x0)), rounded(y0 + s * (y1 - y0)), math.pi / 2 + 2 * math.pi * k / (10 * steps)
        rim.append(shape.vertex((x, y, 0), (0, 0, 1)))
        moves.append((rounded(0.6 * math.cos(a) - x), rounded(0.6 * math.sin(a) - y), 0.0))
    shape.triangles = [(center, rim[k], rim[(k + 1) % len(rim)]) for k in range(len(rim))]
    material = g.material("light", (0.0, 0.0, 0.0), emission=(9.0, 5.4, 1.8), specular=0.0)
    g.json["materials"][material]["doubleSided"] = True
    mesh = g.mesh("light", shape, material)
    low, high = ([f(v[i] for v in moves) for i in range(3)] for f in (min, max))
    g.json["meshes"][mesh]["primitives"][0]["targets"] = [{"POSITION": g.vectors(moves, min=low, max=high)}]
    g.json["meshes"][mesh]["weights"] = [0.0]
    tilt = math.radians(25)  # down, to the floor
    light = len(g.json["nodes"])
    g.node("light", mesh=mesh, translation=[0.0, 1.35, -0.9], rotation=[rounded(math.sin(tilt / 2)), 0.0, 0.0, rounded(math.cos(tilt / 2))])
    g.camera("main", [0.0, 1.9, 5.4], [0.0, 0.62, -0.3], 0.6)

    def floats(kind, rows):
        flat = [x for row in rows for x in row]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        return g.accessor(5126, kind, len(flat) // width, struct.pack("<%df" % len(flat), *flat),
                          **({"min": [min(flat)], "max": [max(flat)]} if kind == "SCALAR" else {}))

    g.use("KHR_animation_pointer")
    times = floats("SCALAR", [(0.0,), (2.0,), (4.0,)])
    turns = [tilt, tilt - 0.3, tilt]
    samplers = [{"input": times, "output": floats("SCALAR", [(0.0,)] * 3 + [(0.0,), (1.0,), (0.0,)] + [(0.0,)] * 3), "interpolation": "CUBICSPLINE"},
                {"input": times, "output": floats("VEC4", [(rounded(math.sin(t / 2)), 0.0, 0.0, rounded(math.cos(t / 2))) for t in turns])},
                {"input": times, "output": floats("VEC3", [(1.0, 0.6, 0.2), (0.35, 0.6, 1.0), (1.0, 0.6, 0.2)])}]
    color = "/materials/%d/emissiveFactor" % material
    g.json["animations"] = [{"name": "star to disk", "samplers": samplers, "channels": [
        {"sampler": 0, "target": {"node": light, "path": "weights"}}, {"sampler": 1, "target": {"node": light, "path": "rotation"}},
        {"sampler": 2, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": color}}}}]}]
    return g


def plane():
    g = Gltf()
    g.node("plane", mesh=g.mesh("plane", plate((-50, 0, 50), (50, 0, 50), (50, 0, -50), (-50, 0, -50)), g.diffuse("white", (0.8, 0.8, 0.8))))
    g.area_light("quad", {"type": "rect", "intensity": 1.0, "size": 1.5, "rect": {"aspect": 4.0 / 3.0}},
                 translation=[0.0, 1.0, -1.5], rotation=TO_PLUS_Z)
    g.camera("main", [0.0, 1.6, 6.0], [0.0, 0.7, 0.0], 0.785398163)
    return g


def floor(material, light_at=(0.0, 1.4, -2.0), facing=(0.0, 0.4, 0.0)):
    """A floor under a rectangle that leans over it, seen from 20 degrees up: what methods are compared on."""
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-20, 0, 20), (20, 0, 20), (20, 0, -20), (-20, 0, -20)), material(g)))
    g.area_light("panel", {"type": "rect", "intensity": 4.0, "size": 1.2, "rect": {"aspect": 2.0}}, matrix=looking(light_at, facing))
    angle, distance = math.radians(20), 6.0
    g.camera("main", [0.0, distance * math.sin(angle), distance * math.cos(angle)], [0.0, 0.0, 0.0], 0.7)
    return g


def diffuse_floor():
    return floor(lambda g: g.diffuse("white", (0.8, 0.8, 0.8)))


def glossy_floor():
    # alpha 0.09, F = 1
    return floor(lambda g: g.material("mirror", (1.0, 1.0, 1.0), 1.0, 0.3))


def window_color(u, v):
    """A leaded window: panes of five colours in a diagonal lattice, a bright disk, a ramp from side to side."""
    a, b = 6 * u + 3 * v, 6 * u - 3 * v
    if min(a % 1, 1 - a % 1, b % 1, 1 - b % 1) < 0.06:
        return 10, 10, 12
    if (2 * u - 1.3) ** 2 + (v - 0.4) ** 2 < 0.06:
        return 255, 244, 214
    panes = ((235, 60, 40), (250, 170, 50), (60, 160, 235), (70, 190, 90), (160, 80, 215))
    return tuple(int(c * (0.45 + 0.55 * u)) for c in panes[(3 * math.floor(a) + 7 * math.floor(b)) % 5])


ROUGHNESS_OF_STRIPS = (0.1, 0.2, 0.35, 0.5, 0.8)


def textured_floor(color=window_color, strips=ROUGHNESS_OF_STRIPS):
    """Strips of floor, rougher from left to right, before a standing textured panel."""
    g = Gltf()
    width = 5.0 / len(strips)
    for i, roughness in enumerate(strips):
        x = -2.5 + width * i
        g.node("strip %d" % (i + 1), mesh=g.mesh("strip %d" % (i + 1), plate((x, 0, 3), (x + width, 0, 3), (x + width, 0, -2), (x, 0, -2)),
                                                 g.material("roughness %g" % roughness, (0.9, 0.9, 0.9), 1.0, roughness)))
    panel = plate((-2.5, 0.1, -2), (2.5, 0.1, -2), (2.5, 1.9, -2), (-2.5, 1.9, -2))
    panel.texcoords = [(0, 1), (1, 1), (1, 0), (0, 0)]
    glass = g.material("window", (0.0, 0.0, 0.0), specular=0.0, emission=(2.0, 2.0, 2.0))
    g.picture("window", png(160, 64, lambda x, y: color((x + 0.5) / 160, (y + 0.5) / 64)), glass)
    g.node("window", mesh=g.mesh("window", panel, glass))
    g.camera("main", [0.0, 2.2, 6.0], [0.0, 0.45, -0.6], 0.62)
    g.camera("floor", [0.0, 2.2, 6.0], [0.0, 0.0, 1.6], 0.3)  # sees nothing but floor
    return g


def tubes():
    """Three tubes of light over a floor that grows rougher to the right, before a diffuse wall: one leans, one stands, one lies."""
    g = Gltf()
    widths = (0.15, 0.3, 0.5)
    for i, roughness in enumerate(widths):
        x = -3.0 + 2.0 * i
        g.node("strip %d" % (i + 1), mesh=g.mesh("strip %d" % (i + 1), plate((x, 0, 3), (x + 2, 0, 3), (x + 2, 0, -2), (x, 0, -2)),
                                                 g.material("roughness %g" % roughness, (0.5, 0.5, 0.52), 1.0, roughness)))
    g.node("wall", mesh=g.mesh("wall", plate((-3, 0, -2), (3, 0, -2), (3, 3, -2), (-3, 3, -2)), g.diffuse("wall", (0.7, 0.68, 0.64))))
    ball = g.mesh("ball", sphere(), g.diffuse("plaster", (0.75, 0.73, 0.7)))
    g.node("ball", mesh=ball, translation=[0.55, 0.35, -0.9], scale=[0.35, 0.35, 0.35])
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)  # half the angle of 60 degrees about z
    g.area_light("leaning", {"type": "capsule", "color": [1.0, 0.75, 0.5], "intensity": 14.0, "size": 0.1, "capsule": {"length": 1.8}},
                 translation=[-1.7, 1.1, -1.2], rotation=[0.0, 0.0, s, c])
    g.area_light("standing", {"type": "capsule", "color": [0.5, 0.7, 1.0], "intensity": 10.0, "size": 0.16, "capsule": {"length": 0.9}},
                 translation=[1.9, 0.65, -1.0], rotation=[0.0, 0.0, HALF, HALF])
    g.area_light("lying", {"type": "capsule", "color": [1.0, 0.95, 0.9], "intensity": 30.0, "size": 0.04, "capsule": {"length": 1.6}},
                 translation=[0.3, 1.9, -1.2])
    g.camera("main", [0.0, 1.5, 5.6], [0.0, 0.9, -0.6], 0.6)
    return g


def lobes():
    """Four strips of floor with lobes of their own, from left to right Phong, Phong sharper, Beckmann, GGX brushed across, before a star and two
    ellipsoids of light."""
    g = Gltf()
    kinds = (("phong 60", {"brdf": "phong", "exponent": 60, "albedo": 0.7}),
             ("phong 1000", {"brdf": "phong", "exponent": 1000, "albedo": 0.7}),
             ("beckmann", {"brdf": "beckmann", "alpha": 0.2}),
             ("brushed ggx", {"brdf": "ggx", "alpha_x": 0.4, "alpha_y": 0.06, "tangent": [1, 0, 0], "f0": 0.8}))
    for i, (name, lobe) in enumerate(kinds):
        x = -3.2 + 1.6 * i
        material = g.diffuse(name, (0.05, 0.05, 0.05))
        g.json["materials"][material]["extras"] = {"steradian": lobe}
        g.node(name, mesh=g.mesh(name, plate((x, 0, 3), (x + 1.58, 0, 3), (x + 1.58, 0, -2), (x, 0, -2)), material))
    g.node("star", mesh=g.mesh("star", star(5, 0.75, 0.3), g.material("star", (0.0, 0.0, 0.0), specular=0.0, emission=(6.0, 4.2, 2.0))), translation=[-1.6, 0.95, -1.6])
    g.area_light("egg", {"type": "sphere", "color": [0.5, 0.75, 1.0], "intensity": 6.0, "size": 1.0}, translation=[0.75, 0.85, -1.4],
                 scale=[0.5, 1.1, 0.5])
    g.area_light("disc", {"type": "sphere", "color": [0.7, 1.0, 0.6], "intensity": 6.0, "size": 1.0}, translation=[2.4, 0.75, -1.4],
                 scale=[1.1, 0.35, 0.6])
    g.camera("main", [0.0, 2.0, 6.2], [0.0, 0.35, -0.6], 0.6)
    return g


def ring():
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-9, 0, 6), (9, 0, 6), (9, 0, -9), (-9, 0, -9)), g.diffuse("floor", (0.7, 0.68, 0.65))))

    def band(u, v):
        # A ring of rounded rectangular section: what makes the heart-shaped light on the floor is its inner side.
        a, b = 2 * math.pi * u, 2 * math.pi * v
        c, s = math.cos(b), math.sin(b)
        x, y = math.copysign(abs(c) ** 0.35, c), math.copysign(abs(s) ** 0.35, s)
        n = (math.copysign(abs(c) ** 1.65, c) / 0.06, math.copysign(abs(s) ** 1.65, s) / 0.25)
        r = 0.9 - 0.06 * x
        return ((r * math.cos(a), 0.25 + 0.25 * y, r * math.sin(a)), (-n[0] * math.cos(a), n[1], -n[0] * math.sin(a)))
    s = Shape()
    s.grid(160, 48, band)
    g.node("ring", mesh=g.mesh("ring", s, g.material("gold", (0.95, 0.7, 0.32), 1.0, 0.2)))
    g.light("KHR_lights_punctual", "spot",
            {"type": "spot", "color": [1.0, 0.96, 0.9], "intensity": 120.0, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.45}},
            matrix=looking([2.6, 2.4, -1.2], [0.0, 0.1, 0.0]))
    g.camera("main", [-0.3, 2.6, 3.4], [0.0, 0.1, 0.1], 0.7)
    return g


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


def table(g, material, x, z, width, depth, height):
    """A table top on four legs."""
    leg, thick = 0.06, 0.04
    g.node("table top", mesh=g.mesh("table top", box(x - width / 2, height - thick, z - depth / 2, x + width / 2, height, z + depth / 2), material))
    for i, (sx, sz) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
        cx, cz = x + sx * (width / 2 - leg), z + sz * (depth / 2 - leg)
        g.node("leg %d" % i, mesh=g.mesh("leg %d" % i, box(cx - leg / 2, 0.0, cz - leg / 2, cx + leg / 2, height - thick, cz + leg / 2), material))


def room():
    """A room with furniture; the light comes through a window with bars."""
    g = Gltf()
    wall, wood = g.diffuse("wall", (0.75, 0.72, 0.68)), g.material("wood", (0.5, 0.3, 0.16), 0.0, 0.35)
    w, d, h, t = 2.2, 2.2, 2.5, 0.15  # half width, half depth, height, thickness
    g.node("floor", mesh=g.mesh("floor", plate((-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)), g.material("floor", (0.42, 0.34, 0.27), 0.0, 0.3)))
    g.node("ceiling", mesh=g.mesh("ceiling", box(-w - t, h, -d - t, w + t, h + t, d + t), wall))
    g.node("back", mesh=g.mesh("back", box(-w - t, 0.0, -d - t, w + t, h, -d), wall))
    g.node("left", mesh=g.mesh("left", box(-w - t, 0.0, -d, -w, h, d), wall))
    y0, y1, z0, z1 = 0.8, 2.0, -1.2, 0.6  # the window, in the wall at the right
    for name, corners in (("below", (0.0, -d, y0, d)), ("above", (y1, -d, h, d)), ("behind", (y0, -d, y1, z0)), ("before", (y0, z1, y1, d))):
        a, b, c, e = corners
        g.node("right " + name, mesh=g.mesh("right " + name, box(w, a, b, w + t, c, e), wall))
    bar, middle = 0.025, (z0 + z1) / 2
    g.node("bar", mesh=g.mesh("bar", box(w + 0.05, y0, middle - bar, w + 0.05 + 2 * bar, y1, middle + bar), wood))
    g.node("cross bar", mesh=g.mesh("cross bar", box(w + 0.05, 1.4 - bar, z0, w + 0.05 + 2 * bar, 1.4 + bar, z1), wood))
    table(g, wood, 0.5, -0.6, 1.4, 0.8, 0.75)
    ball = g.mesh("ball", sphere(64, 32), g.material("glaze", (0.15, 0.4, 0.42), 0.0, 0.2))
    g.node("ball", mesh=ball, translation=[0.75, 0.93, -0.6], scale=[0.18, 0.18, 0.18])
    g.node("book", mesh=g.mesh("book", box(0.0, 0.75, -0.85, 0.3, 0.81, -0.45), g.diffuse("cover", (0.6, 0.12, 0.1))))
    seat = g.diffuse("seat", (0.3, 0.35, 0.5))
    g.node("seat", mesh=g.mesh("seat", box(-0.95, 0.42, -0.85, -0.5, 0.47, -0.4), seat))
    g.node("chair back", mesh=g.mesh("chair back", box(-0.95, 0.47, -0.85, -0.91, 0.95, -0.4), seat))
    for i, (x, z) in enumerate(((-0.93, -0.83), (-0.52, -0.83), (-0.52, -0.42), (-0.93, -0.42))):
        g.node("chair leg %d" % i, mesh=g.mesh("chair leg %d" % i, box(x - 0.02, 0.0, z - 0.02, x + 0.02, 0.42, z + 0.02), seat))
    g.area_light("sky", {"type": "rect", "color": [0.85, 0.93, 1.0], "intensity": 110.0, "size": 2.2, "rect": {"aspect": 1.6}},
                 translation=[3.6, 2.1, -0.3], rotation=TO_MINUS_X)
    g.camera("main", [-0.9, 1.5, 3.9], [0.15, 0.75, -0.6], 0.75)
    return g


def office():
    """A room with a desk and twelve panels of one kind under its ceiling (docs/solve.md)."""
    g = Gltf()
    wall = g.diffuse("wall", (0.7, 0.7, 0.68))
    w, d, h = 3.0, 2.5, 2.8  # half width, half depth, height
    for name, corners, material in (
            ("floor", ((-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)), g.material("carpet", (0.3, 0.32, 0.36), 0.0, 0.6)),
            ("ceiling", ((-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d)), g.diffuse("ceiling", (0.8, 0.8, 0.8))),
            ("back", ((-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)), wall),
            ("left", ((-w, 0, d), (-w, 0, -d), (-w, h, -d), (-w, h, d)), wall),
            ("right", ((w, 0, -d), (w, 0, d), (w, h, d), (w, h, -d)), wall)):
        g.node(name, mesh=g.mesh(name, plate(*corners), material))
    table(g, g.material("wood", (0.5, 0.35, 0.2), 0.0, 0.4), 0.9, -0.6, 1.6, 0.8, 0.75)
    panel = g.lamp("panel", {"type": "rect", "color": [1.0, 0.97, 0.92], "intensity": 900.0, "size": 0.6})
    for i in range(12):
        panel(translation=[rounded(-2.25 + 1.5 * (i % 4)), h - 0.01, rounded(-1.6 + 1.6 * (i // 4))], rotation=[-0.7071068, 0, 0, 0.7071068])
    g.camera("main", [-0.6, 1.6, 5.9], [0.1, 1.2, 0.0], 0.65)
    return g


def glass():
    """Balls of glass and chrome, a block of green glass, a thin pane and a torus in a room with a lamp."""
    g = Gltf()
    w, d, h = 1.6, 1.6, 2.2
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

    def transmitting(name, color, thickness, **volume):
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
    ball = g.mesh("glass ball", sphere(96, 48), transmitting("glass", (1.0, 1.0, 1.0), 1.0))
    g.node("glass ball", mesh=ball, translation=[-0.45, 0.35, 0.35], scale=[0.35, 0.35, 0.35])
    chrome = g.with_material("chrome ball", ball, g.material("chrome", (0.9, 0.9, 0.9), 1.0, 0.0))
    g.node("chrome ball", mesh=chrome, translation=[0.6, 0.4, -0.5], scale=[0.4, 0.4, 0.4])
    green = transmitting("green glass", (1.0, 1.0, 1.0), 1.0, attenuationColor=[0.3, 0.8, 0.4], attenuationDistance=0.3)
    g.node("block", mesh=g.mesh("block", box(0.35, 0.001, 0.35, 0.65, 0.4, 0.65), green))
    g.node("pane", mesh=g.mesh("pane", plate((-1.3, 0.0, -0.3), (-0.6, 0.0, -0.6), (-0.6, 0.9, -0.6), (-1.3, 0.9, -0.3)),
                               transmitting("pane", (0.9, 0.75, 0.4), 0.0)))

    def ring_path(t):
        return [0.22 * math.cos(2 * math.pi * t), 0.0, 0.22 * math.sin(2 * math.pi * t)]
    g.node("torus", mesh=g.mesh("torus", tube(ring_path, 0.07, 64, 24), g.material("copper", (0.8, 0.45, 0.3), 1.0, 0.12)),
           translation=[0.05, 0.071, 0.75])
    g.area_light("lamp", {"type": "rect", "color": [1.0, 0.95, 0.88], "intensity": 40.0, "size": 0.8, "rect": {"aspect": 1.0}},
                 translation=[0.0, 2.19, 0.0], rotation=DOWN)
    g.camera("main", [0.2, 1.0, 1.55], [0.0, 0.5, -0.2], 0.95)
    return g


def lamp_shade():
    """A bulb in a cone that is open at both ends, on a table's edge of things to cast shadows."""
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-3, 0, 3), (3, 0, 3), (3, 0, -1.2), (-3, 0, -1.2)), g.diffuse("floor", (0.6, 0.55, 0.5))))
    g.node("wall", mesh=g.mesh("wall", plate((-3, 0, -1.2), (3, 0, -1.2), (3, 3, -1.2), (-3, 3, -1.2)), g.diffuse("wall", (0.7, 0.7, 0.72))))

    def shade(v):
        return 0.34 - 0.16 * v, 1.0 + 0.36 * v
    outside, inside = lathe(shade, 64, 1), Shape()
    inside.grid(64, 1, lambda u, v: (lambda r, y: ((0.985 * r * math.cos(2 * math.pi * u), y, 0.985 * r * math.sin(2 * math.pi * u)),
                                                  (-math.cos(2 * math.pi * u), -0.44, -math.sin(2 * math.pi * u))))(*shade(v)))
    cloth = g.diffuse("cloth", (0.8, 0.72, 0.55))
    g.node("shade", mesh=g.mesh("shade", outside, cloth))
    g.node("lining", mesh=g.mesh("lining", inside, cloth))
    metal = g.material("brass", (0.85, 0.65, 0.35), 1.0, 0.25)
    g.node("stand", mesh=g.mesh("stand", lathe(lambda v: (0.015, 0.02 + 1.05 * v), 24, 1), metal))
    g.node("foot", mesh=g.mesh("foot", lathe(lambda v: (0.16 * (1 - v) + 0.015 * v, 0.02 * v), 48, 1), metal))
    g.area_light("bulb", {"type": "sphere", "color": [1.0, 0.86, 0.66], "intensity": 400.0, "size": 0.14}, translation=[0.0, 1.16, 0.0])
    g.area_light("window", {"type": "rect", "color": [0.7, 0.8, 1.0], "intensity": 1.2, "size": 1.5}, matrix=looking([-2.4, 2.2, 1.8], [0.0, 0.8, 0.0]))
    g.node("ball", mesh=g.mesh("ball", sphere(64, 32), g.material("ball", (0.2, 0.3, 0.5), 0.0, 0.25)), translation=[0.5, 0.16, 0.3], scale=[0.16, 0.16, 0.16])
    g.node("box", mesh=g.mesh("box", box(-0.75, 0.0, 0.05, -0.45, 0.35, 0.35), g.diffuse("box", (0.55, 0.2, 0.15))))
    g.camera("main", [0.3, 1.25, 3.2], [0.0, 0.75, -0.1], 0.75)
    return g


def grille():
    """Thin bars before a light, and what they draw on a floor and a ball."""
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-3, 0, 2.5), (3, 0, 2.5), (3, 0, -2.5), (-3, 0, -2.5)), g.material("floor", (0.6, 0.6, 0.6), 0.0, 0.4)))
    iron = g.diffuse("iron", (0.1, 0.1, 0.1))
    for i in range(9):
        x = -0.8 + 0.2 * i
        g.node("bar %d" % i, mesh=g.mesh("bar %d" % i, box(x - 0.008, 1.3, -0.8, x + 0.008, 1.316, 0.8), iron))
        g.node("cross %d" % i, mesh=g.mesh("cross %d" % i, box(-0.8, 1.316, x - 0.008, 0.8, 1.332, x + 0.008), iron))
    g.node("ball", mesh=g.mesh("ball", sphere(96, 48), g.diffuse("ball", (0.8, 0.75, 0.7))), translation=[0.2, 0.35, 0.0], scale=[0.35, 0.35, 0.35])
    g.node("card", mesh=g.mesh("card", plate((-0.9, 0.0, -0.2), (-0.4, 0.0, -0.5), (-0.4, 0.6, -0.5), (-0.9, 0.6, -0.2)), g.diffuse("card", (0.7, 0.3, 0.2))))
    g.area_light("panel", {"type": "rect", "color": [1.0, 1.0, 1.0], "intensity": 60.0, "size": 0.5}, translation=[0.2, 2.6, 0.2], rotation=DOWN)
    g.camera("main", [0.0, 1.9, 3.4], [0.0, 0.35, 0.0], 0.7)
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


SCENES = {"glass": glass, "room": room, "office": office, "lamp_shade": lamp_shade, "grille": grille, "gallery": gallery, "morph": morph, "plane": plane, "diffuse_floor": diffuse_floor, "glossy_floor": glossy_floor, "textured_floor": textured_floor, "tubes": tubes, "lobes": lobes,
          "ring": ring, "arcade": arcade, "hall": hall, "stadium": stadium,
          **all_light_scenes.SCENES}


def main():
    if len(sys.argv) < 2 or any(name not in SCENES for name in sys.argv[2:]):
        sys.exit(__doc__.splitlines()[0])
    os.makedirs(sys.argv[1], exist_ok=True)
    for name in sys.argv[2:] or SCENES:
        SCENES[name]().write(os.path.join(sys.argv[1], name + ".glb"))


if __name__ == "__main__":
    main()
