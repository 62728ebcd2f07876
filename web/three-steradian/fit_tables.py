#!/usr/bin/env python3
"""fit_tables.py: fits the two tables of three's RectAreaLight to three's own formula, and writes src/tables.js.

    fit_tables.py            writes them
    fit_tables.py --limit    how far the formula is off at 36 entries where nothing is asked of them but metals

A table of linearly transformed cosines is fitted to the lobe: what it then sends is integrated exactly where the horizon is. three's shader
approximates that integral, by a sphere in the place of the light, and so is off by more than its table is. Here the shader's whole formula
is fitted: at every entry to what lights over the hemisphere, many of them cut by the horizon, send by GGX in closed form.

Needs numpy and the Python module (./dev python); takes some minutes.
"""
import base64
import sys
from pathlib import Path

import numpy as np
import steradian

from rect_formula import SIZE, form_factor

HERE = Path(__file__).resolve().parent
LICENCE = "// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.\n"
LIGHTS = 240  # an entry
METAL, PLASTIC = 0.7, 0.04  # f0 of the two materials that an entry is fitted to
WEIGHTS = (1, 0.6)  # of their misses: a plastic's lobe is seen over its diffuse light, a metal's alone
STIFFNESS = 0.03  # how much an entry is held to its neighbours' mean: else linear lookup between two good entries is none
COARSE, STEPS, FINE_STEPS = 3, 8, 3  # every third entry first: 63 is 21 times 3, and so are the roughnesses that are used
LEAST_ROUGHNESS = 0.0525  # three's


def random_lights(count, seed):
    """Rectangles by what makes them, the same for every entry: half of them about the mirrored view, half anywhere."""
    rng = np.random.default_rng(seed)
    return {"about_mirror": np.arange(count) % 2 == 0, "offset": rng.normal(size=(count, 3)), "distance": np.exp(rng.uniform(np.log(0.4), np.log(3), count)),
            "tilt": rng.normal(size=(count, 3)) * 0.6, "level": np.arange(count) % 4 < 2, "roll": rng.normal(size=(count, 3)),
            "size": np.exp(rng.uniform(np.log(0.3), np.log(2.5), (count, 2)))}


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def corners_of(lights, cosine, alpha):
    """Corners (count, 4, 3) about the surface's point, in the order of three's shader; the view is in the plane of x and z."""
    mirror = np.array([-np.sqrt(1 - cosine * cosine), 0, cosine])
    center = unit(np.where(lights["about_mirror"][:, None], mirror + lights["offset"] * 2 * (0.15 + alpha), lights["offset"]))
    center[:, 2] = np.where(center[:, 2] < -0.35, -center[:, 2], center[:, 2])  # what is far below sends nothing
    normal = unit(lights["tilt"] - center)
    normal *= np.sign(-(normal * center).sum(-1, keepdims=True))  # the lit side
    x = unit(np.cross(np.where(lights["level"][:, None], [0.0, 0, 1], lights["roll"]), normal)) * lights["size"][:, :1] / 2
    y = unit(np.cross(normal, x)) * lights["size"][:, 1:] / 2
    center *= lights["distance"][:, None]
    return np.stack([center + x - y, center - x - y, center - x + y, center + x + y], 1)


def sent(corners, cosine, alpha):
    """What the lights send by GGX in closed form to (metal, plastic): (count, 2)."""
    view = [np.sqrt(1 - cosine * cosine), 0, cosine]
    lobe = {"brdf": "ggx", "alpha": alpha, "f0": [METAL, PLASTIC, 0], "f90": 1}
    return np.array([steradian.radiance({"type": "polygon", "vertices": c[::-1], "radiance": 1}, [0, 0, 0], [0, 0, 1], view, lobe, quality="high").flatten()[:2]
                     for c in corners])


class Entries:
    """Of some roughnesses (rows) and views (columns): the lights, and what they send; all as one list."""

    def __init__(self, roughness, cosine, corners, wanted):
        self.alpha, self.cosine, self.corners, self.wanted = roughness ** 2, cosine, corners, wanted

    @staticmethod
    def about(roughness, cosine, lights):
        r, c = np.repeat(roughness, len(cosine)), np.tile(cosine, len(roughness))
        corners = np.stack([corners_of(lights, k, a) for k, a in zip(c, r ** 2)])
        return Entries(r, c, corners, np.stack([sent(q, k, a) for q, k, a in zip(corners, c, r ** 2)]))

    def some(self, index):
        return Entries(np.sqrt(self.alpha[index]), self.cosine[index], self.corners[index], self.wanted[index])

    def matrix(self, p):
        """The second row is fitted in units of alpha, so that neighbours are alike."""
        return p * np.stack([np.ones_like(self.alpha), self.alpha] * 2, -1)

    def shares(self, p):
        return form_factor(self.corners, self.matrix(p)[:, None, :])

    def scales(self, f):
        """The best factors for (metal, plastic)."""
        return np.einsum("nl,nlk->nk", f, self.wanted) / np.maximum((f * f).sum(1), 1e-30)[:, None]

    def misses(self, p):
        """What the formula with its best factors is off, in shares of what is sent."""
        f = self.shares(p)
        off = (f[..., None] * self.scales(f)[:, None, :] - self.wanted) / np.linalg.norm(self.wanted, axis=1, keepdims=True) * WEIGHTS
        return off.reshape(len(p), -1)


def fit(entries, p, steps, from_above=True):
    """Levenberg and Marquardt at every entry at once; p (roughnesses, views, 4). from_above: the first view is straight down."""
    shape, damping = p.shape, np.full(p.shape[0] * p.shape[1], 1e-2)
    free = np.ones((*shape[:2], 4))
    if from_above:
        free[:, 0] = [0, 0, 0, 1]  # seen from straight above, a lobe is round
    free = free.reshape(-1, 1, 4)
    for step in range(steps):
        padded = np.pad(p, ((1, 1), (1, 1), (0, 0)), "edge")
        mean = ((padded[:-2, 1:-1] + padded[2:, 1:-1] + padded[1:-1, :-2] + padded[1:-1, 2:]) / 4).reshape(-1, 4)
        flat, total = p.reshape(-1, 4), 0.0
        for some in np.array_split(np.arange(len(flat)), max(len(flat) // 128, 1)):
            part, q = entries.some(some), flat[some]

            def residual(x):
                return np.concatenate([part.misses(x), STIFFNESS * (x - mean[some])], 1)
            r = residual(q)
            J = np.stack([(residual(q + 1e-5 * axis) - r) / 1e-5 for axis in np.eye(4)], -1) * free[some]
            A, b = np.einsum("nra,nrb->nab", J, J), np.einsum("nra,nr->na", J, r)
            A += np.eye(4) * (damping[some, None] * np.einsum("naa->na", A) + 1e-9)[:, None, :]
            tried = q - np.linalg.solve(A, b[..., None])[..., 0]
            before, now = (r * r).sum(1), (residual(tried) ** 2).sum(1)
            better = now < before
            flat[some] = np.where(better[:, None], tried, q)
            damping[some] = np.where(better, np.maximum(damping[some] / 4, 1e-7), np.minimum(damping[some] * 6, 1e4))
            total += np.minimum(now, before).sum()
        p = flat.reshape(shape)
        print(f"step {step + 1}: off by {np.sqrt(total / len(flat) / 2):.4f} of what is sent, rms", flush=True)
    return p


def between(coarse, every):
    """Linear between entries of which every so many there are, both ways."""
    for axis in (0, 1):
        n = (coarse.shape[axis] - 1) * every + 1
        at = np.arange(n) / every
        i = np.minimum(at.astype(int), coarse.shape[axis] - 2)
        share = (at - i).reshape([-1 if k == axis else 1 for k in range(3)])
        coarse = np.take(coarse, i, axis) * (1 - share) + np.take(coarse, i + 1, axis) * share
    return coarse


def tables():
    """(SIZE, SIZE, 4) and (SIZE, SIZE, 2): rows by the view, columns by the roughness."""
    first_used = int(LEAST_ROUGHNESS * (SIZE - 1))  # linear lookup never sees the entries before
    roughness = np.arange(first_used, SIZE) / (SIZE - 1)
    cosine = np.maximum(1 - (np.arange(SIZE) / (SIZE - 1)) ** 2, 1e-3)
    entries = Entries.about(roughness, cosine, random_lights(LIGHTS, 1))
    print("what the lights send is known", flush=True)
    # To start with: a cosine about the mirrored view, as wide as the lobe along the plane of view and across it.
    c, s = cosine[:, None], np.sqrt(1 - cosine * cosine)[:, None]
    start = np.maximum(c, 0.05) * np.concatenate([c, -2 * s, s, 2 * c], 1)
    start[0] = [1, 0, 0, 2]
    index = np.arange(len(roughness) * SIZE).reshape(len(roughness), SIZE)
    coarse = fit(entries.some(index[::COARSE, ::COARSE].ravel()), np.stack([start[::COARSE]] * len(roughness[::COARSE])), STEPS)
    p = fit(entries, between(coarse, COARSE), FINE_STEPS).reshape(-1, 4)
    # Radiance with f0 is f0 a + (1 - f0) b.
    parts = np.concatenate([np.linalg.solve([[METAL, 1 - METAL], [PLASTIC, 1 - PLASTIC]], e.scales(e.shares(q)).T).T
                            for e, q in ((entries.some(k), p[k]) for k in index)])
    first, second = (np.concatenate([t[:1].repeat(first_used, 0), t]).swapaxes(0, 1)
                     for t in (entries.matrix(p).reshape(len(roughness), SIZE, 4), parts.reshape(len(roughness), SIZE, 2)))
    return first, second


def limit():
    """The formula's own part: entries that are fitted alone, not held to each other, and for metals only. No tables do better on such lights."""
    global WEIGHTS, STIFFNESS
    WEIGHTS, STIFFNESS = (1, 0), 0
    at = np.array([6, 15, 27, 39, 51, 63]), np.array([6, 18, 30, 42, 51, 60])
    cosine = 1 - (at[1] / (SIZE - 1)) ** 2
    entries = Entries.about(at[0] / (SIZE - 1), cosine, random_lights(LIGHTS, 1))
    c, s = cosine[:, None], np.sqrt(1 - cosine * cosine)[:, None]
    p = fit(entries, np.stack([c * np.concatenate([c, -2 * s, s, 2 * c], 1)] * 6), 3 * STEPS, from_above=False).reshape(-1, 4)
    each = np.sqrt((entries.misses(p) ** 2).sum(1))
    print(f"metals, {len(each)} entries: at best off by {each.mean():.4f} of what is sent, {each.min():.4f} to {each.max():.4f}")


def main():
    if sys.argv[1:] == ["--limit"]:
        limit()
        return
    coded = [base64.b64encode(t.astype("<f2").tobytes()).decode() for t in tables()]
    (HERE / "src" / "tables.js").write_text(
        "// GGX tables for the formula of three's RectAreaLight: a matrix and two magnitudes an entry, as half floats. Made by fit_tables.py.\n" + LICENCE +
        "import { DataUtils } from 'three';\n\n"
        f"const MATRIX = '{coded[0]}';\nconst MAGNITUDE = '{coded[1]}';\n\n"
        "function decoded( text ) {\n\n"
        "\tconst bytes = Uint8Array.from( atob( text ), ( c ) => c.charCodeAt( 0 ) );\n"
        "\tconst view = new DataView( bytes.buffer );\n"
        "\treturn Float32Array.from( { length: bytes.length / 2 }, ( _, i ) => DataUtils.fromHalfFloat( view.getUint16( 2 * i, true ) ) );\n\n"
        "}\n\n"
        "// The contents of three's textures: four numbers an entry.\n"
        "export function ltcTables() {\n\n"
        f"\tconst size = {SIZE}, pairs = decoded( MAGNITUDE ), magnitude = new Float32Array( 4 * size * size );\n"
        "\tfor ( let i = 0; i < size * size; i ++ ) magnitude.set( pairs.subarray( 2 * i, 2 * i + 2 ), 4 * i );\n"
        "\treturn { size, matrix: decoded( MATRIX ), magnitude };\n\n"
        "}\n")


if __name__ == "__main__":
    main()
