#!/usr/bin/env python3
"""An example port: a few functions of cipc in Python, standard library only, speaking the conformance protocol.

    cipc vectors distance2_point_edge | python3 tests/conformance/port.py | cipc judge

Reads queries (JSON lines) from standard input and writes them back with "got". --wrong plants a fault in every function: the judge must reject it.
"""
import json
import math
import sys
from fractions import Fraction


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def barrier(query):
    """b, b', b'' of b(D) = -(D - Dhat)^2 ln(D / Dhat) for 0 < D < Dhat."""
    D, Dhat = query["x"]
    if D >= Dhat:
        return {"f": [0.0, 0.0, 0.0]}
    gap, log = D - Dhat, math.log(D / Dhat)
    return {"f": [-gap * gap * log, -2 * gap * log - gap * gap / D, -2 * log - 4 * gap / D + (gap / D) ** 2]}


def point_point(p, q):
    """|p - q|^2 with gradient and Hessian, as lists over (p, q)."""
    d = sub(p, q)
    hessian = [[0.0] * 6 for _ in range(6)]
    for i in range(3):
        hessian[i][i] = hessian[i + 3][i + 3] = 2.0
        hessian[i][i + 3] = hessian[i + 3][i] = -2.0
    return dot(d, d), [2 * x for x in d] + [-2 * x for x in d], hessian


def point_line(p, e0, e1):
    """Squared distance of p to the line e0 e1: with foot t and closest vector d, the gradient is 2 w d, w = (1, t - 1, -t)."""
    u, e = sub(p, e0), sub(e1, e0)
    length2 = dot(e, e)
    t = dot(u, e) / length2
    d = [x - t * y for x, y in zip(u, e)]
    t += dot(d, e) / length2  # once more: the first t was good to the rounding of u only
    d = [x - t * y for x, y in zip(u, e)]
    w, c = (1.0, t - 1.0, -t), (0.0, -1.0, 1.0)
    gradient = [2 * wi * x for wi in w for x in d]
    hessian = [[0.0] * 9 for _ in range(9)]
    for i in range(3):
        for j in range(3):
            for r in range(3):
                for s in range(3):
                    across = (1.0 if r == s else 0.0) - e[r] * e[s] / length2
                    value = w[i] * w[j] * across - c[i] * w[j] * d[r] * e[s] / length2 - w[i] * c[j] * e[r] * d[s] / length2
                    hessian[3 * i + r][3 * j + s] = 2 * (value - c[i] * c[j] * d[r] * d[s] / length2)
    return dot(d, d), gradient, hessian


def scatter(n, nodes, gradient, hessian):
    """Derivatives of a few nodes in their places among all n numbers, the Hessian row by row."""
    g, H = [0.0] * n, [0.0] * (n * n)
    place = [3 * node + k for node in nodes for k in range(3)]
    for a, i in enumerate(place):
        g[i] = gradient[a]
        for b, j in enumerate(place):
            H[n * i + j] = hessian[a][b]
    return g, H


def distance2_point_point(query):
    x = query["x"]
    value, gradient, hessian = point_point(x[0:3], x[3:6])
    g, H = scatter(6, (0, 1), gradient, hessian)
    return {"value": value, "gradient": g, "hessian": H, "feature": "p-q"}


def distance2_point_edge(query):
    x = query["x"]
    p, e0, e1 = x[0:3], x[3:6], x[6:9]
    along, length2 = dot(sub(p, e0), sub(e1, e0)), dot(sub(e1, e0), sub(e1, e0))
    if along <= 0:
        feature, nodes, parts = "p-e0", (0, 1), point_point(p, e0)
    elif along >= length2:
        feature, nodes, parts = "p-e1", (0, 2), point_point(p, e1)
    else:
        feature, nodes, parts = "p-e", (0, 1, 2), point_line(p, e0, e1)
    g, H = scatter(9, nodes, parts[1], parts[2])
    return {"value": parts[0], "gradient": g, "hessian": H, "feature": feature}


def orient3d(query):
    """Exact, in rationals: every float is one."""
    a, b, c, d = ([Fraction(v) for v in query["x"][3 * i:3 * i + 3]] for i in range(4))
    u, v, w = sub(b, a), sub(c, a), sub(d, a)
    cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    det = dot(cross, w)
    return {"sign": (det > 0) - (det < 0)}


def toi_point_point(query):
    """Two points, d(t)^2 = |u + t v|^2: the first t with d = xi + s (d(0) - xi) is a root of a quadratic; a step to just before it is safe."""
    u = [Fraction(v) for v in sub([Fraction(v) for v in query["x0"][0:3]], [Fraction(v) for v in query["x0"][3:6]])]
    end = sub([Fraction(v) for v in query["x1"][0:3]], [Fraction(v) for v in query["x1"][3:6]])
    v = sub(end, u)
    xi, scale = query.get("thickness", 0.0), query.get("scale", 0.1)
    distance = math.sqrt(dot(u, u))
    if dot(u, u) <= Fraction(xi) ** 2:
        return {"toi": 0.0, "hit": True}
    target = xi + scale * (distance - xi)
    a, b, c = dot(v, v), dot(u, v), dot(u, u) - Fraction(target) ** 2
    discriminant = b * b - a * c
    if a == 0 or b >= 0 or discriminant < 0 or c <= 0:
        return {"toi": 1.0, "hit": False}
    root = float(c / (-b + Fraction(math.sqrt(discriminant)))) * (1 - 2.0 ** -40)
    return {"toi": root, "hit": True} if root < 1 else {"toi": 1.0, "hit": False}


FUNCTIONS = {f.__name__: f for f in (barrier, distance2_point_point, distance2_point_edge, orient3d, toi_point_point)}


def spoil(fn, got):
    """The faults of the wrong port: a lost factor of 2, a flipped sign, a step past the contact."""
    if fn == "barrier":
        got["f"][1] *= 1 + 1e-6
    elif fn.startswith("distance2"):
        got["gradient"] = [0.5 * x for x in got["gradient"]]
    elif fn == "orient3d":
        got["sign"] = -got["sign"]
    else:
        got["toi"] = min(1.0, 1.2 * got["toi"])
    return got


def main():
    wrong = sys.argv[1:] == ["--wrong"]
    for line in sys.stdin:
        query = json.loads(line)
        if query["fn"] not in FUNCTIONS:
            sys.exit("port.py: no function " + query["fn"])
        got = FUNCTIONS[query["fn"]](query)
        query["got"] = spoil(query["fn"], got) if wrong else got
        print(json.dumps(query))


if __name__ == "__main__":
    main()
