#!/usr/bin/env python3
"""Makes the scenes of this folder: make_scenes.py FOLDER [gallery|hall|room ...]

Standard library only; the same bytes on every machine.
"""

import math
import os
import struct
import sys

import all_light_scenes
import atrium_scene
import glass_scenes
import large_scenes
import neon_scene
from gltf_writer import DOWN, HALF, TO_MINUS_X, TO_PLUS_X, TO_PLUS_Z, Gltf, Shape, box, lathe, looking, plate, png, rounded, sphere, tube

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


SCENES = {"room": room, "office": office, "lamp_shade": lamp_shade, "grille": grille, "gallery": gallery, "morph": morph, "plane": plane, "diffuse_floor": diffuse_floor, "glossy_floor": glossy_floor, "textured_floor": textured_floor, "tubes": tubes, "lobes": lobes,
          "ring": ring, **all_light_scenes.SCENES, **atrium_scene.SCENES, **glass_scenes.SCENES, **large_scenes.SCENES, **neon_scene.SCENES}


def main():
    if len(sys.argv) < 2 or any(name not in SCENES for name in sys.argv[2:]):
        sys.exit(__doc__.splitlines()[0])
    os.makedirs(sys.argv[1], exist_ok=True)
    for name in sys.argv[2:] or SCENES:
        SCENES[name]().write(os.path.join(sys.argv[1], name + ".glb"))


if __name__ == "__main__":
    main()
