#!/usr/bin/env python3
"""Whole trees of light paths in crystals, in 50-digit arithmetic, by a method that shares nothing
with culet. The four waves at a face are the roots of det(N N^T - N^2 I + eps) = 0 as a quartic
in q, N = K + q n; their fields are null vectors of that matrix; a face is the 4x4 system of
continuous tangential E and H; rays run along the Poynting vector to the nearest plane ahead.
Makes ray_trees.json for ray_trees_test.cpp:

    apt-get install python3-mpmath
    python3 ray_trees.py > ray_trees.json
"""
import json
import math
import random

import mpmath as mp

mp.mp.dps = 50


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = mp.sqrt(dot(a, a))
    return [x / length for x in a]


def permittivity(indices, axes):
    """Axes are doubles. The first is kept; the others are made exactly perpendicular to it."""
    a = unit([mp.mpf(x) for x in axes[0]])
    b = [mp.mpf(x) for x in axes[1]]
    b = unit([y - dot(a, b) * x for x, y in zip(a, b)])
    c = cross(a, b)
    eps = mp.matrix(3, 3)
    for n, axis in zip(indices, (a, b, c)):
        for i in range(3):
            for j in range(3):
                eps[i, j] += mp.mpf(n) ** 2 * axis[i] * axis[j]
    return eps


def maxwell(eps, N):
    M = mp.matrix(3, 3)
    for i in range(3):
        for j in range(3):
            M[i, j] = N[i] * N[j] - (dot(N, N) if i == j else 0) + eps[i, j]
    return M


def null_vector(M):
    rows = [[M[i, j] for j in range(3)] for i in range(3)]
    candidates = [cross(rows[0], rows[1]), cross(rows[0], rows[2]), cross(rows[1], rows[2])]
    size = lambda v: mp.sqrt(sum(abs(x) ** 2 for x in v))
    best = max(candidates, key=size)
    return [x / size(best) for x in best]


def poynting(wave):
    return [mp.re(s) for s in cross(wave["E"], [mp.conj(h) for h in wave["H"]])]


def crystal_waves(eps, K, n):
    points = [mp.mpf(x) for x in (-2, -1, 0, 1, 2)]
    A, b = mp.matrix(5, 5), mp.matrix(5, 1)
    for i, q in enumerate(points):
        for j in range(5):
            A[i, j] = q ** (4 - j)
        b[i] = mp.det(maxwell(eps, [k + q * m for k, m in zip(K, n)]))
    coefficients = list(mp.lu_solve(A, b))
    waves = []
    for q in mp.polyroots(coefficients, maxsteps=2000, extraprec=400):
        travels = abs(mp.im(q)) < mp.mpf(10) ** -35
        q = mp.re(q) if travels else q
        N = [k + q * m for k, m in zip(K, n)]
        E = null_vector(maxwell(eps, N))
        wave = {"N": N, "E": E, "H": cross(N, E), "travels": travels}
        wave["flux"] = dot(poynting(wave), n)
        wave["forward"] = wave["flux"] > 0 if travels else mp.im(q) > 0
        waves.append(wave)
    return waves


def outside_waves(K, n, sign):
    q = mp.sqrt(mp.mpc(1 - dot(K, K)))
    s = cross(unit(K), n)
    N = [k + sign * q * m for k, m in zip(K, n)]
    waves = []
    for E in (s, cross(N, s)):
        wave = {"E": E, "H": cross(N, E)}
        wave["flux"] = dot(poynting(wave), n)
        waves.append(wave)
    return waves


def amplitudes(incident, same_side, far_side, K, n):
    """The waves that `incident` makes on both sides: tangential E and H are continuous."""
    t2 = unit(K)
    t1 = cross(t2, n)
    tangential = lambda w: [dot(t1, w["E"]), dot(t2, w["E"]), dot(t1, w["H"]), dot(t2, w["H"])]
    A, b = mp.matrix(4, 4), mp.matrix(4, 1)
    for column, (wave, sign) in enumerate([(w, 1) for w in far_side] + [(w, -1) for w in same_side]):
        for row, value in enumerate(tangential(wave)):
            A[row, column] = sign * value
    for row, value in enumerate(tangential(incident)):
        b[row] = value
    x = mp.lu_solve(A, b)
    return [x[2], x[3]], [x[0], x[1]]


def tangential_part(N, n):
    return [k - dot(N, n) * m for k, m in zip(N, n)]


def trace(planes, eps, origin, direction, depth, light):
    """Radiance, remainder and number of hits of the tree down to `depth`; the powers of waves
    add."""
    x = [mp.mpf(v) for v in origin]
    d = unit([mp.mpf(v) for v in direction])
    t, n = max(((off - dot(m, x)) / dot(m, d), m) for m, off in planes if dot(m, d) < 0)
    x = [a + t * b for a, b in zip(x, d)]
    n = [-v for v in n]
    K = tangential_part(d, n)
    inside = [w for w in crystal_waves(eps, K, n) if w["forward"]]
    back = outside_waves(K, n, -1)
    reflected, power = mp.mpf(0), [mp.mpf(0), mp.mpf(0)]
    for incident in outside_waves(K, n, 1):
        r, t = amplitudes(incident, back, inside, K, n)
        for m in range(2):
            reflected += abs(r[m]) ** 2 * abs(back[m]["flux"]) / incident["flux"] / 2
            if inside[m]["travels"]:
                power[m] += abs(t[m]) ** 2 * inside[m]["flux"] / incident["flux"] / 2
    radiance = reflected * light([a - 2 * dot(d, n) * b for a, b in zip(d, n)])
    remainder, hits = mp.mpf(0), 1
    open_paths = [(x, w, p, 2) for w, p in zip(inside, power) if w["travels"]]
    while open_paths:
        x, wave, p, event = open_paths.pop()
        if event > depth:
            remainder += p
            continue
        hits += 1
        ray = unit(poynting(wave))
        t, n = min(((off - dot(m, x)) / dot(m, ray), m) for m, off in planes if dot(m, ray) > 0)
        x = [a + t * b for a, b in zip(x, ray)]
        K = tangential_part(wave["N"], n)
        incoming = dot(poynting(wave), n)
        inside = [w for w in crystal_waves(eps, K, n) if not w["forward"]]
        out = outside_waves(K, n, 1)
        r, t = amplitudes(wave, inside, out, K, n)
        if dot(K, K) < 1:
            q = mp.sqrt(1 - dot(K, K))
            through = sum(abs(t[m]) ** 2 * out[m]["flux"] for m in range(2)) / incoming
            radiance += p * through * light([k + q * m for k, m in zip(K, n)])
        for m in range(2):
            if inside[m]["travels"]:
                share = abs(r[m]) ** 2 * abs(inside[m]["flux"]) / incoming
                open_paths.append((x, inside[m], p * share, event + 1))
    return radiance, remainder, hits


def rotation(a, b, c, d):
    """Rows of the rotation of a quaternion of small integers, as doubles."""
    s = a * a + b * b + c * c + d * d
    return [[(a * a + b * b - c * c - d * d) / s, 2 * (b * c - a * d) / s, 2 * (b * d + a * c) / s],
            [2 * (b * c + a * d) / s, (a * a - b * b + c * c - d * d) / s, 2 * (c * d - a * b) / s],
            [2 * (b * d - a * c) / s, 2 * (c * d + a * b) / s, (a * a - b * b - c * c + d * d) / s]]


def tier(count, inclination_deg, offset, start_deg=0.0):
    planes = []
    for k in range(count):
        azimuth = math.radians(start_deg + 360.0 * k / count)
        tilt = math.radians(abs(inclination_deg))
        up = math.copysign(math.cos(tilt), inclination_deg)
        planes.append(([math.sin(tilt) * math.cos(azimuth), math.sin(tilt) * math.sin(azimuth), up], offset))
    return planes


def stones():
    cube = [([float(s) * (i == k) for k in range(3)], 1.0) for i in range(3) for s in (-1, 1)]
    prism = [([0.0, 0.0, 1.0], 0.9), ([0.1, 0.05, -1.0], 1.1), ([1.0, 0.2, 0.1], 1.3), ([-0.5, 0.8, 0.0], 1.2),
             ([-0.6, -0.8, 0.1], 1.25)]
    brilliant = [([0.0, 0.0, 1.0], 0.9)]
    brilliant += tier(16, 90.0, 2.5, 11.25)
    brilliant += tier(8, 34.5, 1.62) + tier(16, 42.3, 1.86, 11.25) + tier(8, 22.0, 1.33, 22.5)
    brilliant += tier(8, -41.0, 1.64) + tier(16, -42.6, 1.71, 11.25)
    return {"cube": cube, "prism": prism, "brilliant": brilliant}


MATERIALS = {
    "sapphire": [1.760, 1.768, 1.768],
    "zircon": [1.984, 1.925, 1.925],
    "calcite": [1.486, 1.658, 1.658],
    "topaz": [1.610, 1.613, 1.620],
    "peridot": [1.654, 1.671, 1.690],
    "weak": [1.6, 1.600003, 1.60001],
    "strong": [1.5, 1.6, 1.8],
}
LOBE = {"direction": [0.3, -0.2, 1.0], "exponent": 3, "radiance": 1.0}
HEMISPHERE = {"direction": [-0.2, 0.9, 0.1], "radiance": 0.7}
CONSTANT = 0.25


def light(v):
    seen = mp.mpf(CONSTANT)
    cosine = dot(unit([mp.mpf(x) for x in LOBE["direction"]]), v)
    if mp.re(cosine) > 0:
        seen += mp.re(cosine) ** LOBE["exponent"]
    if mp.re(dot([mp.mpf(x) for x in HEMISPHERE["direction"]], v)) > 0:
        seen += mp.mpf(HEMISPHERE["radiance"])
    return seen


def main():
    rng = random.Random(2004)
    cases = []
    all_stones = stones()
    frames = [rotation(3, 1, 2, 1), rotation(5, 2, -1, 3), rotation(1, 0, 0, 0)]
    for stone, planes in all_stones.items():
        exact = []
        for normal, offset in planes:
            normal = [mp.mpf(x) for x in normal]
            length = mp.sqrt(dot(normal, normal))
            exact.append(([x / length for x in normal], mp.mpf(offset) / length))
        for material, indices in MATERIALS.items():
            for k in range(2):
                axes = frames[(k + len(cases)) % 3]
                # Towards a point well inside, so that no ray misses.
                origin = [rng.uniform(-3, 3), rng.uniform(-3, 3), 8.0]
                direction = [rng.uniform(-0.6, 0.6) - origin[0], rng.uniform(-0.6, 0.6) - origin[1], -8.0]
                depth = 5 if stone == "brilliant" else 6
                radiance, remainder, hits = trace(exact, permittivity(indices, axes), origin, direction, depth, light)
                cases.append({"stone": stone, "material": material, "n": indices, "axes": axes, "origin": origin,
                              "direction": direction, "depth": depth, "hits": hits,
                              "radiance": mp.nstr(mp.re(radiance), 20), "remainder": mp.nstr(mp.re(remainder), 20)})
    document = {"made_by": "ray_trees.py, 50 digits", "constant": CONSTANT, "lobe": LOBE, "hemisphere": HEMISPHERE,
                "stones": {name: [{"normal": n, "offset": o} for n, o in planes] for name, planes in all_stones.items()},
                "cases": cases}
    print(json.dumps(document, indent=1))


main()
