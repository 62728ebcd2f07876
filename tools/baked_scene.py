"""Scenes of `steradian bake`, read for measurements: what a graphics card shows of their light maps. Needs NumPy."""
import json
import struct
from pathlib import Path

import numpy

KINDS = {5123: ("<u2", 2), 5125: ("<u4", 4), 5126: ("<f4", 4), 5121: ("u1", 1)}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Baked:
    """Triangles in the world, with their places in the map. A scene that is not baked has no places."""

    def __init__(self, path):
        data = Path(path).read_bytes()
        size, = struct.unpack_from("<I", data, 12)
        self.json, self.binary = json.loads(data[20:20 + size]), data[28 + size:]
        light_map = self.json.get("extras", {}).get("steradian", {}).get("lightMap", {})
        self.width, self.height = light_map.get("width", 1), light_map.get("height", 1)
        parts = [self.primitive(node, primitive) for node in self.json["nodes"] if "mesh" in node
                 for primitive in self.json["meshes"][node["mesh"]]["primitives"]]
        # The map's place of a surface without a map is NaN.
        self.positions, self.normals, self.places, self.colors = (numpy.concatenate([p[k] for p in parts]) for k in range(4))

    def accessor(self, number):
        a = self.json["accessors"][number]
        view = self.json["bufferViews"][a["bufferView"]]
        kind, size = KINDS[a["componentType"]]
        columns = COLUMNS[a["type"]]
        first, step = view.get("byteOffset", 0) + a.get("byteOffset", 0), view.get("byteStride", columns * size)
        bytes_ = numpy.frombuffer(self.binary, "u1")
        rows = bytes_[first + numpy.arange(a["count"])[:, None] * step + numpy.arange(columns * size)]
        return numpy.ascontiguousarray(rows).view(kind).reshape(a["count"], columns)

    def matrix(self, node):
        if "matrix" in node:
            return numpy.array(node["matrix"], float).reshape(4, 4).T
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        turn = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        m = numpy.eye(4)
        m[:3, :3] = turn * numpy.array(node.get("scale", (1, 1, 1)))
        m[:3, 3] = node.get("translation", (0, 0, 0))
        return m

    def primitive(self, node, primitive):
        m = self.matrix(node)
        attributes = primitive["attributes"]
        positions = self.accessor(attributes["POSITION"]).astype(float) @ m[:3, :3].T + m[:3, 3]
        indices = self.accessor(primitive["indices"])[:, 0].astype(int) if "indices" in primitive else numpy.arange(len(positions))
        corners = positions[indices].reshape(-1, 3, 3)
        if "NORMAL" in attributes:
            normals = (self.accessor(attributes["NORMAL"]).astype(float) @ numpy.linalg.inv(m[:3, :3]))[indices].reshape(-1, 3, 3)
        else:
            normals = numpy.repeat(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, None], 3, 1)
        normals = normals / numpy.maximum(numpy.linalg.norm(normals, axis=2, keepdims=True), 1e-30)
        shown = primitive.get("extras", {}).get("steradian", {}).get("lightMap")
        if shown:
            places = self.accessor(attributes[f"TEXCOORD_{shown['texCoord']}"]).astype(float)
            places = (places * [self.width, self.height])[indices].reshape(-1, 3, 2)
        else:
            places = numpy.full((len(corners), 3, 2), numpy.nan)
        color = self.json["materials"][primitive["material"]]["pbrMetallicRoughness"].get("baseColorFactor", (1, 1, 1, 1))[:3]
        return corners, normals, places, numpy.tile(color, (len(corners), 1))

    def lit(self):
        """Numbers of the triangles in the map whose light counts: those below things share one place."""
        t = self.places
        area = (t[:, 1, 0] - t[:, 0, 0]) * (t[:, 2, 1] - t[:, 0, 1]) - (t[:, 1, 1] - t[:, 0, 1]) * (t[:, 2, 0] - t[:, 0, 0])
        return numpy.flatnonzero(numpy.isfinite(area) & (abs(area) > 1e-9))

    def areas(self):
        p = self.positions
        return numpy.linalg.norm(numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2

    def probes(self, count):
        """Random places in proportion to area: position, normal, tangent and place in the map."""
        random = numpy.random.default_rng(1)
        lit, area = self.lit(), self.areas()
        chosen = random.choice(lit, count, p=area[lit] / area[lit].sum())
        u, v = random.random(count), random.random(count)
        turned = u + v > 1
        u[turned], v[turned] = 1 - u[turned], 1 - v[turned]
        w = numpy.stack([1 - u - v, u, v], 1)[:, :, None]
        mean = lambda values: (values[chosen] * w).sum(1)
        p = self.positions[chosen]
        across = numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        across /= numpy.linalg.norm(across, axis=1, keepdims=True)
        along = p[:, 1] - p[:, 0]
        along /= numpy.linalg.norm(along, axis=1, keepdims=True)
        normals = mean(self.normals)
        return mean(self.positions), across, along, normals / numpy.linalg.norm(normals, axis=1, keepdims=True), mean(self.places)

    def seams(self):
        """Edges of smooth surfaces with two places in the map: (edges, side, end, 2)."""
        known, seams = {}, []
        for t in self.lit():
            for k in range(3):
                ends = [(tuple(self.positions[t, c].round(6)), self.normals[t, c], self.places[t, c]) for c in (k, (k + 1) % 3)]
                ends.sort(key=lambda e: e[0])
                known.setdefault((ends[0][0], ends[1][0]), []).append(ends)
        for sides in known.values():
            if len(sides) != 2:
                continue
            one, other = sides
            smooth = all(one[e][1] @ other[e][1] > 0.999 for e in (0, 1))
            # Light may jump where a thin wall parts a plane.
            curved = one[0][1] @ one[1][1] < 1 - 1e-6
            if smooth and curved and any(abs(one[e][2] - other[e][2]).max() > 1e-3 for e in (0, 1)):
                seams.append([[one[0][2], one[1][2]], [other[0][2], other[1][2]]])
        return numpy.array(seams).reshape(-1, 2, 2, 2)


def shown_at(texels, places):
    """What a graphics card shows of a map at places [texels]."""
    height, width = texels.shape[:2]
    x, y = numpy.clip(places[..., 0] - 0.5, 0, width - 1.001), numpy.clip(places[..., 1] - 0.5, 0, height - 1.001)
    i, j = x.astype(int), y.astype(int)
    fx, fy = (x - i)[..., None], (y - j)[..., None]
    return (texels[j, i] * (1 - fx) + texels[j, i + 1] * fx) * (1 - fy) + (texels[j + 1, i] * (1 - fx) + texels[j + 1, i + 1] * fx) * fy


def largest_seam(texels, seams, mean):
    if len(seams) == 0:
        return 0.0
    t = numpy.linspace(0, 1, 25)[:, None]
    sides = [shown_at(texels, s[:, None, 0] * (1 - t) + s[:, None, 1] * t) for s in (seams[:, 0], seams[:, 1])]
    return float(abs(sides[0] - sides[1]).max() / mean)
