#!/usr/bin/env python3
"""derivatives_test.py PROGRAM [--cases N] [--seed S] [--table]: the derivatives of `steradian eval` against differences of `eval` itself.

Families of random queries: every area light, every lobe, the point and the light everywhere: beside the horizon, at grazing
views, in the mirrored view, tiny, huge and far lights. The judge is Richardson's extrapolation of three central differences. Two of its
orders bound its error. Where the differences are those of quadrature, a random direction of each vector stands for its three components.

The derivatives by the light and the point are those of the true integral: their judge is quadrature (`reference`, `exact`). Those of
transformed cosines are of their own lobe. Those by the lobe are of the method's value in high quality.
"""
import argparse
import json
import math
import random
import subprocess
import sys

RADIANCE = [1, 2, 5]
LIGHTS = ["polygon", "rect", "disk", "sphere", "ellipsoid", "capsule"]
PLACES = ["plain", "plain", "horizon", "grazing", "mirror", "tiny", "huge", "far"]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def times(a, s):
    return [x * s for x in a]


def plus(*vectors):
    return [sum(x) for x in zip(*vectors)]


def unit(a):
    return times(a, 1 / math.sqrt(dot(a, a)))


def frame(n):
    a = unit(cross(n, [1, 0, 0] if abs(n[0]) < 0.8 else [0, 1, 0]))
    return a, cross(n, a)


class Families:
    """Random queries."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def direction(self):
        return unit([self.random.gauss(0, 1) for _ in range(3)])

    def light(self, kind, center, size, distance):
        n = self.direction()
        a, b = frame(n)
        flat = {"radiance": RADIANCE, "two_sided": True}
        aspect, solid = self.random.uniform(0.2, 1), min(size, 0.5 * distance)
        if kind == "polygon":
            first, count = self.random.uniform(0, 6), self.random.randint(3, 6)
            angles = [first + 2 * math.pi * (i + self.random.uniform(0, 0.8)) / count for i in range(count)]
            return {"type": kind, "vertices": [plus(center, times(a, size * math.cos(t)), times(b, size * math.sin(t))) for t in angles], **flat}
        if kind == "rect":
            return {"type": kind, "center": center, "x": times(a, size), "y": times(b, size * aspect), **flat}
        if kind == "disk":
            return {"type": kind, "center": center, "x": times(a, size), "y": plus(times(b, size * aspect), times(a, 0.3 * size)), **flat}
        if kind == "sphere":
            return {"type": kind, "center": center, "radius": solid, "radiance": RADIANCE}
        if kind == "ellipsoid":
            axes = {"x": times(a, solid), "y": times(b, solid * aspect), "z": times(n, solid * 0.3)}
            return {"type": kind, "center": center, **axes, "radiance": RADIANCE}
        ends = [plus(center, times(a, solid)), plus(center, times(a, -solid))]
        radius = 0 if kind == "line" else solid * self.random.uniform(0.05, 0.4)
        return {"type": "capsule", "ends": ends, "radius": radius, "radiance": RADIANCE}

    def query(self, kind, material, method):
        place = self.random.choice(PLACES)
        n, position = self.direction(), [self.random.gauss(0, 1) for _ in range(3)]
        a, b = frame(n)
        height, azimuth = self.random.uniform(0.01, 0.08) if place == "grazing" else self.random.uniform(0.2, 1), self.random.uniform(0, 6)
        across = math.sqrt(1 - height * height)
        view = plus(times(n, height), times(a, across * math.cos(azimuth)), times(b, across * math.sin(azimuth)))
        to = plus(times(n, 0.05 if place == "horizon" else self.random.uniform(0.5, 1.5)), times(a, self.random.gauss(0, 0.7)),
                  times(b, self.random.gauss(0, 0.7)))
        if place == "mirror":
            to = plus(times(n, 2 * height), times(view, -1))
        if place == "far":
            to = times(to, 100)
        size = {"tiny": 1e-4, "huge": 30}.get(place, self.random.uniform(0.2, 0.8))
        light = self.light(kind, plus(position, to), size, math.sqrt(dot(to, to)))
        return {"id": place, "light": light, "position": position, "normal": n, "view": view, "material": material, "method": method}

    def lobe(self, name):
        roughness, f0 = self.random.uniform(0.2, 1), [0.04, 0.5, 0.9]
        alpha_x, alpha_y = self.random.uniform(0.05, 0.3), self.random.uniform(0.3, 0.9)
        return {"lambert": {"brdf": "lambert", "albedo": [0.2, 0.5, 0.9]},
                "phong": {"brdf": "phong", "exponent": self.random.choice([1, 5, 30.5, 300]), "albedo": [0.2, 0.5, 0.9]},
                "phong-cosine": {"brdf": "phong", "exponent": self.random.choice([1, 5, 30.5]), "foreshortening": True},
                "ggx": {"brdf": "ggx", "roughness": roughness, "f0": f0},
                "ggx-two-widths": {"brdf": "ggx", "alpha_x": alpha_x, "alpha_y": alpha_y, "tangent": self.direction(), "f0": f0},
                "ggx-unshadowed": {"brdf": "ggx", "roughness": roughness, "shadowing": "none"},
                "ltc": {"brdf": "ggx", "roughness": roughness, "f0": f0},
                "ltc-compact": {"brdf": "ggx", "roughness": roughness, "f0": f0},
                "beckmann": {"brdf": "beckmann", "roughness": roughness},
                "blinn-phong": {"brdf": "blinn-phong", "exponent": self.random.choice([3, 20, 100])},
                "charlie": {"brdf": "charlie", "roughness": roughness},
                "lobe-product": {"brdf": "lobe-product", "exponent": 10, "axis_exponent": 4}}[name]


LOBES = ["lambert", "phong", "phong-cosine", "ggx", "ggx-two-widths", "ggx-unshadowed", "ltc", "ltc-compact", "beckmann", "blinn-phong",
         "charlie", "lobe-product"]
NUMBERS = ("exponent", "axis_exponent", "roughness", "alpha_x", "alpha_y")
LINEAR = ("albedo", "f0", "f90")
TRUE_ROUND = (("lobe-product", "disk"), ("beckmann", "capsule"))  # judged by quadrature even so: their methods are less true


def parameters(query, directions):
    """(key of the answer, where in it, what moves in the query, by which direction, typical size).

    directions(key, vectors): the unit vectors along which a vector moves, of those given or between them.
    """
    light, position = query["light"], query["position"]
    points = light.get("vertices") or light.get("ends") or [light["center"]]
    distance = min(math.dist(p, position) for p in points)
    extent = max([math.dist(p, points[0]) for p in points] + [light.get("radius", 0)] +
                 [math.sqrt(dot(light[k], light[k])) for k in "xyz" if k in light])
    size = min(distance, extent)
    axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    vectors = [("d_position", [], ["position"], distance), ("d_normal", [], ["normal"], 1), ("d_view", [], ["view"], 1)]
    vectors += [("d_" + key, [], ["light", key], size) for key in ("center", "x", "y", "z") if key in light]
    vectors += [("d_ends", [k], ["light", "ends", k], size) for k in range(2 if "ends" in light else 0)]
    for key, place, path, typical in vectors:
        for e in directions(key, axes):
            yield key, [*place, e], path, e, typical
    if "vertices" in light:  # in their plane: other moves are errors
        n = unit(cross(plus(points[1], times(points[0], -1)), plus(points[2], times(points[0], -1))))
        for k in range(len(points)):
            for e in directions("d_vertices", frame(n)):
                yield "d_vertices", [k, e], ["light", "vertices", k], e, size
    if light.get("radius"):
        yield "d_radius", None, ["light", "radius"], 1, size
    yield "d_radiance", None, ["light", "radiance"], [1, 1, 1], 1
    for key in LINEAR:
        if key in query["material"]:
            yield "d_" + key, None, ["material", key], [1, 1, 1], 0.1
    for key in NUMBERS:
        value = query["material"].get(key)
        if value is not None and value < 0.95 or key.endswith("exponent") and value is not None:
            yield "d_" + key, None, ["material", key], 1, value


def moved(query, path, direction, step):
    copy = json.loads(json.dumps(query))
    parent = copy
    for key in path[:-1]:
        parent = parent[key]
    old = parent[path[-1]]
    parent[path[-1]] = plus(old, times(direction, step)) if isinstance(old, list) else old + direction * step
    return copy


def derivative(answer, key, place, channel):
    """The derivative along a direction, and the length of the vector of which it is a part."""
    value = answer[key][channel]
    length = abs(value) if not place else 0
    for step in place or []:
        if isinstance(step, list):
            length, value = math.sqrt(dot(value, value)), dot(value, step)
        else:
            value = value[step]
    return value, length


def is_shape(key):
    return key in ("d_position", "d_vertices", "d_center", "d_x", "d_y", "d_z", "d_ends", "d_radius")


def is_flat(query):
    return query["light"]["type"] in ("polygon", "rect")


def is_line(query):
    return query["light"].get("radius") == 0


def judge_of(lobe, query, key, thorough):
    """(keys of the judge's query, how far the derivative may be off, and a size below which it does not count).

    The first is a fraction of the longest derivative of its key, or of the size if that is larger. The size is a fraction of what the
    whole lobe sends over the length in question: the judge's own error is such a fraction.
    """
    own = {"method": query["method"]}
    if is_line(query) and lobe in ("lambert", "ltc", "ltc-compact") and key != "d_radiance":  # a strip of a thousandth of the distance
        return own, 1e-5, 1e-6
    if key in ("d_radiance", "d_albedo", "d_f0"):
        return own, 1e-9, 1e-6
    # Transformed cosines are lobes of their own. Their light's outline is a polygon of 32 corners, if it is round.
    if lobe in ("lambert", "ltc", "ltc-compact"):
        return (own, 1e-7, 1e-6) if is_flat(query) or lobe == "lambert" else (own, 3e-2, 1e-2)
    exact = lobe.startswith("phong") or lobe == "ggx-unshadowed"
    if is_line(query) and (is_shape(key) or key in ("d_normal", "d_view")):
        return {"method": "exact" if exact else "reference"}, 2e-3, 1e-4
    if is_shape(key):
        # GGX has a rule of 6 nodes along an edge (docs/theory/derivatives.md).
        if is_flat(query):
            return {"method": "reference"}, 2e-3 if lobe.startswith("ggx") else 1e-6, 1e-6
        # Polygons of 1024 corners are slow, those of 48 less true.
        if exact or thorough or (lobe, query["light"]["type"]) in TRUE_ROUND:
            return {"method": "exact" if exact else "reference"}, 2e-3, 1e-4
        return {**own, "quality": "high"}, 3e-2, 1e-2
    # By normal and view, GGX has the error of its cubature's mean of shadowing and Fresnel, at grazing views in the largest lights.
    if lobe in ("ggx", "ggx-two-widths") and key in ("d_normal", "d_view") and is_flat(query):
        return {"method": "reference"}, 1e-2, 1e-2
    # By the lobe: differences of the value. The outline of a round light is fixed, that of the judge gathers about the lobe.
    if lobe.startswith("phong"):
        own = {"method": "exact"}
    high = {**own, "quality": "high"} if lobe != "charlie" else own
    return (high, 1e-4, 1e-6) if is_flat(query) or key not in ("d_normal", "d_view") else (high, 3e-2, 1e-2)


class Program:
    def __init__(self, path):
        self.path = path

    def answers(self, queries):
        lines = "".join(json.dumps(q) + "\n" for q in queries)
        done = subprocess.run([self.path, "eval", "-"], input=lines, capture_output=True, text=True)
        found = [json.loads(line) for line in done.stdout.splitlines()]
        assert len(found) == len(queries), done.stderr
        return found


def check(program, cases, thorough):
    """One row a case, key and channel: (lobe, light, place, key, error, judge's own error, tolerance)."""
    asked = program.answers([{**query, "derivatives": True} for _, query in cases])
    wanted, moves = [], []
    chance = random.Random(1)
    for (lobe, query), answer in zip(cases, asked):
        assert "error" not in answer, (answer, query)

        # Quadrature is slow: it judges one random direction of each vector.
        def directions(key, vectors):
            if judge_of(lobe, query, key, thorough)[0].get("method") != "reference":
                return vectors
            return [unit(plus(*(times(e, chance.gauss(0, 1)) for e in vectors)))]

        for key, place, path, direction, size in parameters(query, directions):
            assert key in answer, (key, query)
            judge, tolerance, floor = judge_of(lobe, query, key, thorough)
            step = size * (2e-3 if not key.startswith("d_radiance") else 0.1)
            if key in ("d_normal", "d_view"):
                step = 2e-3
            for level in (1, 0.5, 0.25):
                moves += [moved({**query, **judge}, path, direction, s * step * level) for s in (1, -1)]
            wanted.append((lobe, query, answer, key, place, step, tolerance, floor))
    values = program.answers(moves)
    rows, largest = [], {}
    for i, (lobe, query, answer, key, place, step, tolerance, floor) in enumerate(wanted):
        of_one = values[6 * i:6 * i + 6]
        assert all("error" not in v for v in of_one), (key, of_one, query)
        for channel in range(3):
            f = [v["radiance"][channel] for v in of_one]
            slopes = [(f[0] - f[1]) / (2 * step), (f[2] - f[3]) / step, (f[4] - f[5]) / (step / 2)]
            first, second = (4 * slopes[1] - slopes[0]) / 3, (4 * slopes[2] - slopes[1]) / 3
            truth = (16 * second - first) / 15
            got, length = derivative(answer, key, place, channel)
            assert math.isfinite(got), (key, query)
            # The judge's own error, over the step: 1e-9 of quadrature, 1e-10 of the lobe by `exact`, 1e-14 by rounding.
            off = {"reference": 1e-9 * abs(f[0]), "exact": 1e-14 * abs(f[0]) if lobe == "lambert" else 1e-10 * RADIANCE[channel]}
            rounding = off.get(values[6 * i]["method"], 1e-14 * abs(f[0])) / step
            uncertain = abs(truth - second) + 0.1 * abs(second - first) + rounding
            group = (id(query), is_shape(key) and key not in ("d_radius", "d_position") or key, channel)
            largest[group] = max(largest.get(group, RADIANCE[channel] * floor * 2e-3 / step), abs(truth), length)
            rows.append((lobe, query, key, got, truth, uncertain, group, tolerance))
    return rows, largest


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=2, help="of each lobe and light (default 2)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--lobes", nargs="*", help="default: all")
    parser.add_argument("--lights", nargs="*", help="default: all")
    parser.add_argument("--thorough", action="store_true", help="judge round lights by polygons of 1024 corners (minutes)")
    parser.add_argument("--table", action="store_true", help="print the errors of each lobe and kind of key")
    options = parser.parse_args()
    cases = []
    for lights in (LIGHTS, ["line"]):
        families = Families(options.seed)
        for lobe in options.lobes or LOBES:
            for kind in [kind for kind in lights if kind in (options.lights or lights)]:
                for _ in range(options.cases):
                    cases.append((lobe, families.query(kind, families.lobe(lobe), lobe if lobe.startswith("ltc") else "auto")))
    rows, largest = check(Program(options.program), cases, options.thorough)
    errors, wrong, judged = {}, [], 0
    for lobe, query, key, got, truth, uncertain, group, tolerance in rows:
        size = largest[group]
        if uncertain > 0.3 * size:  # the judge does not know
            continue
        judged += 1
        error = abs(got - truth)
        if error > tolerance * size + 3 * uncertain:
            wrong.append((lobe, key, got, truth, uncertain / size, query))
        what = "light and point" if is_shape(key) else "normal and view" if key in ("d_normal", "d_view") else "numbers"
        errors.setdefault((lobe, what, "flat" if is_flat(query) else "round"), []).append(max(error - uncertain, 0) / size)
    if options.table:
        for group, found in sorted(errors.items()):
            found.sort()
            print(f"{group[0]:16} {group[1]:16} {group[2]:6} {len(found):5} median {found[len(found) // 2]:.1e} "
                  f"90 % {found[len(found) * 9 // 10]:.1e} worst {found[-1]:.1e}")
    print(f"{len(cases)} queries, {judged} of {len(rows)} derivatives judged, {len(wrong)} wrong")
    for lobe, key, got, truth, uncertain, query in wrong[:10]:
        print(f"wrong: {lobe} {key}: {got:.6g}, by differences {truth:.6g} (uncertain by {uncertain:.1e})\n  {json.dumps(query)}")
    if judged < len(rows) * 2 / 3:
        print("the judge knows too few of them")
        return 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
