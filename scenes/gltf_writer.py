"""Writes glTF files from Python's standard library alone, and the shapes that the scenes of this folder are made of.

The same bytes on every machine: coordinates are rounded before they become floats.
"""

import json
import math
import struct
import zlib

COPYRIGHT = "CC0-1.0: the Steradian authors waive all rights to this scene"

HALF = math.sqrt(0.5)
DOWN = [-HALF, 0.0, 0.0, HALF]        # rotations that turn a light's -Z: down,
TO_MINUS_X = [0.0, HALF, 0.0, HALF]   # to -x,
TO_PLUS_X = [0.0, -HALF, 0.0, HALF]   # to +x,
TO_PLUS_Z = [0.0, 1.0, 0.0, 0.0]      # to +z


def rounded(x):
    return round(x, 6) + 0.0  # no negative zero


class Shape:
    """Indexed triangles with normals."""

    def __init__(self):
        self.positions, self.normals, self.triangles, self.texcoords = [], [], [], []

    def vertex(self, p, n):
        length = math.sqrt(sum(c * c for c in n)) or 1.0
        self.positions.append([rounded(c) for c in p])
        self.normals.append([rounded(c / length) for c in n])
        return len(self.positions) - 1

    def quad(self, a, b, c, d):
        """A flat quadrilateral, counter-clockwise as seen from its front."""
        u = [b[i] - a[i] for i in range(3)]
        v = [d[i] - a[i] for i in range(3)]
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        i = [self.vertex(p, n) for p in (a, b, c, d)]
        self.triangles += [(i[0], i[1], i[2]), (i[0], i[2], i[3])]

    def grid(self, columns, rows, point_and_normal):
        """Quadrilaterals over (u, v) in [0, 1]^2; u runs to the right of v as seen from the front."""
        first = len(self.positions)
        for j in range(rows + 1):
            for i in range(columns + 1):
                self.vertex(*point_and_normal(i / columns, j / rows))
        for j in range(rows):
            for i in range(columns):
                a = first + j * (columns + 1) + i
                b, c, d = a + 1, a + columns + 2, a + columns + 1
                for t in ((a, b, c), (a, c, d)):
                    if len({tuple(self.positions[k]) for k in t}) == 3:  # poles of spheres
                        self.triangles.append(t)


def png(width, height, color):
    """An RGB picture of color(x, y) in 0..255, not compressed: zlib's choices differ from version to version."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in color(x, y)) for y in range(height))
    stored = b"".join(struct.pack("<BHH", i + 65535 >= len(rows), len(part), 65535 - len(part)) + part
                      for i in range(0, len(rows), 65535) for part in [rows[i:i + 65535]])

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", b"\x78\x01" + stored + struct.pack(">I", zlib.adler32(rows))) + chunk(b"IEND", b""))


class Gltf:
    """A glTF file in the making."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "scenes/make_scenes.py", "copyright": COPYRIGHT},
                     "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [],
                     "accessors": [], "bufferViews": []}
        self.data = bytearray()

    def use(self, extension):
        used = self.json.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def view(self, data):
        self.data += bytes(-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, component, kind, count, data, **more):
        self.json["accessors"].append(
            {"bufferView": self.view(data), "componentType": component, "type": kind, "count": count, **more})
        return len(self.json["accessors"]) - 1

    def vectors(self, values, **more):
        return self.accessor(5126, "VEC3", len(values), b"".join(struct.pack("<3f", *v) for v in values), **more)

    def material(self, name, color, metallic=0.0, roughness=1.0, specular=None, emission=None):
        m = {"name": name, "pbrMetallicRoughness": {"baseColorFactor": list(color) + [1.0], "metallicFactor": metallic,
                                                    "roughnessFactor": roughness}}
        if specular is not None:
            self.use("KHR_materials_specular")
            m.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": specular}
        if emission is not None:
            strength = max(emission)
            self.use("KHR_materials_emissive_strength")
            m["emissiveFactor"] = [rounded(c / strength) for c in emission]
            m.setdefault("extensions", {})["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
        self.json["materials"].append(m)
        return len(self.json["materials"]) - 1

    def picture(self, name, data, material, use="emissiveTexture"):
        """Makes a PNG the texture of a material: its emissive or its base colour."""
        self.json.setdefault("images", []).append({"name": name, "bufferView": self.view(data), "mimeType": "image/png"})
        self.json.setdefault("samplers", []).append({"magFilter": 9729, "wrapS": 33071, "wrapT": 33071})
        self.json.setdefault("textures", []).append({"source": len(self.json["images"]) - 1, "sampler": len(self.json["samplers"]) - 1})
        m = self.json["materials"][material]
        (m["pbrMetallicRoughness"] if use == "baseColorTexture" else m)[use] = {"index": len(self.json["textures"]) - 1}

    def diffuse(self, name, color):
        return self.material(name, color, specular=0.0)

    def mesh(self, name, shape, material):
        p = shape.positions
        low, high = ([f(v[i] for v in p) for i in range(3)] for f in (min, max))
        flat = [i for t in shape.triangles for i in t]
        wide = len(p) > 65535
        primitive = {"attributes": {"POSITION": self.vectors(p, min=low, max=high), "NORMAL": self.vectors(shape.normals)},
                     "indices": self.accessor(5125 if wide else 5123, "SCALAR", len(flat),
                                              struct.pack("<%d%s" % (len(flat), "I" if wide else "H"), *flat)),
                     "material": material}
        if shape.texcoords:
            uv = b"".join(struct.pack("<2f", *t) for t in shape.texcoords)
            primitive["attributes"]["TEXCOORD_0"] = self.accessor(5126, "VEC2", len(shape.texcoords), uv)
        self.json["meshes"].append({"name": name, "primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def with_material(self, name, mesh, material):
        """The same geometry in another material."""
        primitive = dict(self.json["meshes"][mesh]["primitives"][0], material=material)
        self.json["meshes"].append({"name": name, "primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def node(self, name, **members):
        self.json["nodes"].append({"name": name, **members})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def light(self, extension, name, light, **node):
        self.use(extension)
        lights = self.json.setdefault("extensions", {}).setdefault(extension, {"lights": []})["lights"]
        lights.append({"name": name, **light})
        self.node(name, extensions={extension: {"light": len(lights) - 1}}, **node)

    def lamp(self, name, light):
        """An area light for any number of nodes: the function takes their name and place."""
        self.use("EXT_lights_area")
        lights = self.json.setdefault("extensions", {}).setdefault("EXT_lights_area", {"lights": []})["lights"]
        lights.append({"name": name, **light})
        number = len(lights) - 1
        return lambda **node: self.node(name, extensions={"EXT_lights_area": {"light": number}}, **node)

    def area_light(self, name, light, **node):
        self.light("EXT_lights_area", name, light, **node)

    def camera(self, name, position, target, yfov):
        cameras = self.json.setdefault("cameras", [])
        cameras.append({"name": name, "type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        self.node(name, camera=len(cameras) - 1, matrix=looking(position, target))

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + bytes(-len(self.data) % 4)
        with open(path, "wb") as f:
            f.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
            f.write(struct.pack("<I4s", len(text), b"JSON") + text)
            f.write(struct.pack("<I4s", len(data), b"BIN\0") + data)


def looking(position, target):
    """The matrix of a node at `position` whose -Z points to `target`, by columns."""
    def unit(v):
        length = math.sqrt(sum(c * c for c in v))
        return [c / length for c in v]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    z = unit([position[i] - target[i] for i in range(3)])
    x = unit(cross([0, 1, 0], z))
    y = cross(z, x)
    return [round(c, 9) + 0.0 for c in x + [0] + y + [0] + z + [0] + list(position) + [1]]


def sphere(columns=48, rows=24):
    s = Shape()

    def at(u, v):
        theta, phi = math.pi * (1 - v), 2 * math.pi * u
        p = (math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi))
        return p, p
    s.grid(columns, rows, at)
    return s


def lathe(profile, columns, rows, flutes=0, depth=0.0):
    """Turns radius = profile(v)[0], height = profile(v)[1] about y; v from the bottom to the top."""
    def at_point(u, v):
        phi = 2 * math.pi * u
        r, y = profile(v)
        if flutes:
            r *= 1 - depth * abs(math.sin(flutes * phi / 2)) * math.sin(math.pi * min(max((v - 0.08) / 0.84, 0), 1)) ** 0.25
        return [r * math.sin(phi), y, r * math.cos(phi)]

    def at(u, v):
        h = 1e-4
        du = [(b - a) for a, b in zip(at_point(u - h, v), at_point(u + h, v))]
        dv = [(b - a) for a, b in zip(at_point(u, max(v - h, 0)), at_point(u, min(v + h, 1)))]
        n = [du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2], du[0] * dv[1] - du[1] * dv[0]]
        return at_point(u, v), n
    s = Shape()
    s.grid(columns, rows, at)
    return s


def tube(path, radius, columns, rows):
    """A closed tube about path(t), t in [0, 1]."""
    def at(u, v):
        h = 1e-3
        p, a, b = path(u), path(u - h), path(u + h)
        t = [b[i] - a[i] for i in range(3)]
        length = math.sqrt(sum(c * c for c in t))
        t = [c / length for c in t]
        # One frame for the whole path: away from the y axis or, where the path runs to the centre, from itself.
        out = [a[i] + b[i] - 2 * p[i] for i in range(3)]
        d = sum(out[i] * t[i] for i in range(3))
        e = [out[i] - d * t[i] for i in range(3)]
        length = math.sqrt(sum(c * c for c in e))
        e = [c / length for c in e]
        f = [t[1] * e[2] - t[2] * e[1], t[2] * e[0] - t[0] * e[2], t[0] * e[1] - t[1] * e[0]]
        phi = -2 * math.pi * v
        n = [math.cos(phi) * e[i] + math.sin(phi) * f[i] for i in range(3)]
        return [p[i] + radius * n[i] for i in range(3)], n
    s = Shape()
    s.grid(columns, rows, at)
    return s


def box(x0, y0, z0, x1, y1, z1):
    s = Shape()
    s.quad((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1))
    s.quad((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0))
    s.quad((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1))
    s.quad((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0))
    s.quad((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0))
    s.quad((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1))
    return s


def plate(*corners):
    s = Shape()
    s.quad(*corners)
    return s
