"""A neon sign over a bust: extruded letters with a bevel and a bent tube, closed meshes that shine evenly."""

import math

from gltf_writer import Gltf, Shape, lathe, plate


def cross2(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def triangles_of(outline):
    """Cuts ears off a simple counter-clockwise outline."""
    left, result = list(range(len(outline))), []
    while len(left) > 3:
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            p, q, r = outline[a], outline[b], outline[c]
            inside = any(min(cross2(p, q, outline[k]), cross2(q, r, outline[k]), cross2(r, p, outline[k])) >= 0
                         for k in left if k not in (a, b, c))
            if cross2(p, q, r) > 0 and not inside:
                result.append((a, b, c))
                del left[i]
                break
    return result + [tuple(left)]


def inset(outline, width):
    """The outline moved to its left by a width."""
    def normal(a, b):
        dx, dy = b[0] - a[0], b[1] - a[1]
        size = math.hypot(dx, dy)
        return -dy / size, dx / size
    result = []
    for i, p in enumerate(outline):
        m, n = normal(outline[i - 1], p), normal(p, outline[(i + 1) % len(outline)])
        scale = width / (1 + m[0] * n[0] + m[1] * n[1])
        result.append((p[0] + scale * (m[0] + n[0]), p[1] + scale * (m[1] + n[1])))
    return result


def ellipse(center, x, y, segments):
    """Counter-clockwise; clockwise if y is negative."""
    return [(center[0] + x * math.cos(2 * math.pi * k / segments), center[1] + y * math.sin(2 * math.pi * k / segments))
            for k in range(segments)]


# The outline of a letter of height 1, its holes, and its width.
LETTERS = {
    "N": ([[(0, 0), (.2, 0), (.2, .64), (.52, 0), (.72, 0), (.72, 1), (.52, 1), (.52, .36), (.2, 1), (0, 1)]], 0.72),
    "E": ([[(0, 0), (.6, 0), (.6, .2), (.2, .2), (.2, .4), (.5, .4), (.5, .6), (.2, .6), (.2, .8), (.6, .8), (.6, 1), (0, 1)]], 0.6),
    "O": ([ellipse((0.42, 0.5), 0.42, 0.5, 48), ellipse((0.42, 0.5), 0.22, -0.3, 48)], 0.84),
}


def add_letter(shape, contours, depth, bevel):
    """Extrudes the contours of a letter from z = -depth / 2 to depth / 2, with a bevel on both faces."""
    inner = [inset(c, bevel) for c in contours]
    if len(contours) == 1:
        faces = [[inner[0][k] for k in t] for t in triangles_of(inner[0])]
    else:  # a ring: the hole's corners run the other way
        outer, hole = inner[0], [inner[1][-k] for k in range(len(inner[1]))]
        faces = []
        for k in range(len(outer)):
            m = (k + 1) % len(outer)
            faces += [[outer[k], outer[m], hole[m]], [outer[k], hole[m], hole[k]]]
    front = depth / 2
    for z, turn in ((front, 1), (-front, -1)):
        for face in faces:
            i = [shape.vertex((p[0], p[1], z), (0, 0, turn)) for p in face[::turn]]
            shape.triangles.append(tuple(i))
    for contour, inset_contour in zip(contours, inner):
        for k in range(len(contour)):
            m = (k + 1) % len(contour)
            (ax, ay), (bx, by), (cx, cy), (dx, dy) = contour[k], contour[m], inset_contour[m], inset_contour[k]
            z = front - bevel
            shape.quad((ax, ay, -z), (bx, by, -z), (bx, by, z), (ax, ay, z))
            shape.quad((ax, ay, z), (bx, by, z), (cx, cy, front), (dx, dy, front))
            shape.quad((dx, dy, -front), (cx, cy, -front), (bx, by, -z), (ax, ay, -z))


def sign(text, height, depth, bevel, gap):
    s, x = Shape(), 0.0
    width = sum(LETTERS[c][1] for c in text) + gap * (len(text) - 1)
    for c in text:
        contours, advance = LETTERS[c]
        placed = [[((p[0] + x - width / 2) * height, p[1] * height) for p in contour] for contour in contours]
        add_letter(s, placed, depth, bevel)
        x += advance + gap
    return s


def bent_tube(path, radius, columns, rows):
    """A closed tube about a path in z = 0, with round ends."""
    def ring(p, along, r):
        n = (-along[1], along[0])
        return [(p[0] + r * n[0] * math.cos(a), p[1] + r * n[1] * math.cos(a), r * math.sin(a))
                for a in (2 * math.pi * k / rows for k in range(rows))]
    rings, steps = [], 3
    for i in range(columns + 1):
        t, h = i / columns, 1e-4
        (ax, ay), (bx, by) = path(t - h), path(t + h)
        size = math.hypot(bx - ax, by - ay)
        along, p = ((bx - ax) / size, (by - ay) / size), path(t)
        turn = -1 if i == 0 else 1
        ends = [ring((p[0] + turn * radius * math.sin(a) * along[0], p[1] + turn * radius * math.sin(a) * along[1]), along, radius * math.cos(a))
                for a in (math.pi / 2 * k / steps for k in range(1, steps))]
        pole = (p[0] + turn * radius * along[0], p[1] + turn * radius * along[1], 0.0)
        if i == 0:
            rings += [[pole] * rows] + ends[::-1]
        rings.append(ring(p, along, radius))
        if i == columns:
            rings += ends + [[pole] * rows]
    s = Shape()
    for a, b in zip(rings, rings[1:]):
        for k in range(rows):
            m = (k + 1) % rows
            corners = [p for p, before in ((a[k], None), (a[m], a[k]), (b[m], None), (b[k], b[m])) if p != before]
            s.quad(*(corners + corners[2:])[:4])
            if len(corners) == 3:
                del s.triangles[-1]
    return s


def neon():
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-4, 0, 5), (4, 0, 5), (4, 0, -1), (-4, 0, -1)), g.material("floor", (0.3, 0.28, 0.27), roughness=0.35)))
    g.node("wall", mesh=g.mesh("wall", plate((-4, 0, -1), (4, 0, -1), (4, 4, -1), (-4, 4, -1)), g.diffuse("wall", (0.62, 0.6, 0.6))))
    glow = g.material("sign", (0.0, 0.0, 0.0), emission=(9.0, 2.2, 3.4), specular=0.0)
    g.node("sign", mesh=g.mesh("sign", sign("NEON", 0.5, 0.09, 0.018, 0.16), glow), translation=[0.0, 1.95, 0.5])

    def wave(t):
        x = 1.1 * (2 * t - 1)
        return x, 0.14 * math.sin(3 * math.pi * t) + 0.05 * x
    blue = g.material("tube", (0.0, 0.0, 0.0), emission=(1.4, 5.0, 9.0), specular=0.0)
    g.node("tube", mesh=g.mesh("tube", bent_tube(wave, 0.03, 24, 8), blue), translation=[0.0, 1.72, 0.62])

    def head(v):
        y = 1.15 * v
        neck = 0.30 * math.exp(-((v - 0.02) / 0.16) ** 2)
        skull = math.sqrt(max(0.0, 1 - ((v - 0.68) / 0.32) ** 2)) if v > 0.36 else 0.0
        return max(0.105 + neck, 0.24 * skull) if v < 0.93 else 0.24 * skull, y
    g.node("bust", mesh=g.mesh("bust", lathe(head, 72, 56), g.material("plaster", (0.75, 0.72, 0.68), 0.0, 0.5)), translation=[0.0, 0.35, 0.1],
           scale=[0.92, 1.0, 1.0])
    g.node("plinth", mesh=g.mesh("plinth", lathe(lambda v: (0.46, 0.35 * v), 48, 1), g.diffuse("plinth", (0.5, 0.5, 0.52))), translation=[0.0, 0.0, 0.1])
    g.camera("main", [0.5, 1.5, 4.6], [0.0, 1.2, -0.4], 0.62)
    return g


SCENES = {"neon": neon}
