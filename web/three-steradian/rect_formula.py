"""What three's shader makes of a RectAreaLight and the two tables, in numpy: its form factor, its edges, its approximation of the horizon.

    lights_physical_pars_fragment.glsl.js of three 0.187: LTC_Evaluate, RE_Direct_RectArea_Physical
"""
import numpy as np

SIZE = 64  # entries each way: roughness, and the root of 1 - cos of the view


def edge(a, b):
    """Of the vector form factor, as three has it: a rational approximation of angle over sine."""
    x = (a * b).sum(-1)
    y = np.abs(x)
    v = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y)
    return np.cross(a, b) * np.where(x > 0, v, 0.5 / np.sqrt(np.maximum(1 - x * x, 1e-7)) - v)[..., None]


def form_factor(corners, matrix):
    """corners (..., 4, 3): in the frame whose z is the normal and whose x points towards the eye; matrix (..., 4): of the first table."""
    x, y, z = np.moveaxis(corners, -1, 0)
    m = matrix[..., None, :]
    q = np.stack([m[..., 0] * x + m[..., 2] * z, y, m[..., 1] * x + m[..., 3] * z], -1)
    q /= np.linalg.norm(q, axis=-1, keepdims=True)
    f = sum(edge(q[..., i, :], q[..., (i + 1) % 4, :]) for i in range(4))
    length = np.linalg.norm(f, axis=-1)
    return np.maximum((length * length + f[..., 2]) / (length + 1), 0)  # a sphere of that size, cut by the horizon, by a rational function


def looked_up(table, roughness, cosine):
    """Linear between entries, as three's sampler."""
    u, v = np.asarray(roughness) * (SIZE - 1), np.sqrt(1 - np.asarray(cosine)) * (SIZE - 1)
    i, j = np.minimum(u.astype(int), SIZE - 2), np.minimum(v.astype(int), SIZE - 2)
    fu, fv = (u - i)[..., None], (v - j)[..., None]
    return (table[j, i] * (1 - fu) + table[j, i + 1] * fu) * (1 - fv) + (table[j + 1, i] * (1 - fu) + table[j + 1, i + 1] * fu) * fv


def radiance(corners, roughness, cosine, tables, f0):
    """Of a lobe with f90 = 1, for radiance 1 of the light."""
    first, second = (looked_up(t, roughness, cosine) for t in tables)
    return form_factor(corners, first) * (f0 * second[..., 0] + (1 - f0) * second[..., 1])
