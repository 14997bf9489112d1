#!/usr/bin/env python3
"""Ports with the field's real bugs: for each flag of hard.jsonl, the answers of `cipc eval` with that very bug put in.

    python3 tests/conformance/bugs.py CIPC HARD.jsonl --list          the flags
    python3 tests/conformance/bugs.py CIPC HARD.jsonl FLAG | cipc judge   must fail on every case with the flag

Most bugs are a right answer to a wrong question: `cipc eval` is asked without the thickness, without the mollifier and so on.
"""
import json
import math
import subprocess
import sys


def evaluate(cipc, query):
    line = json.dumps({k: v for k, v in query.items() if k != "want"}) + "\n"
    return json.loads(subprocess.run([cipc, "eval"], input=line, capture_output=True, text=True, check=True).stdout)["got"]


def scaled(got, factor, fields=("gradient", "hessian")):
    for field in fields:
        if field in got:
            got[field] = [factor * v for v in got[field]]
    return got


def with_params(query, **changes):
    return {**query, "params": {**query["params"], **changes}}


def edge_length(query):
    x = query["x"]
    return math.dist(x[0:3], x[3:6])


def transposed(query):
    P = query["params"]["basis"]
    return with_params(query, basis=[P[0], P[2], P[4], P[1], P[3], P[5]])


def lost_bracket(cipc, q):
    """b'' dg dg^T without b' Hess d^2: a rank-one Hessian along the gradient, with the right entry along it."""
    got = evaluate(cipc, q)
    g, n = got["gradient"], len(got["gradient"])
    norm2 = sum(v * v for v in g)
    along = sum(g[i] * got["hessian"][n * i + j] * g[j] for i in range(n) for j in range(n)) / norm2 ** 2
    got["hessian"] = [along * g[i] * g[j] for i in range(n) for j in range(n)]
    return got


def nearest_end(cipc, q):
    """Edges called parallel: the best of the four vertex-edge distances, although they cross."""
    got, x = evaluate(cipc, q), q["x"]
    ends = [(x[0:3], x[6:9], x[9:12]), (x[3:6], x[6:9], x[9:12]), (x[6:9], x[0:3], x[3:6]), (x[9:12], x[0:3], x[3:6])]
    best = math.inf
    for p, a, b in ends:
        e, u = [s - t for s, t in zip(b, a)], [s - t for s, t in zip(p, a)]
        t = min(1.0, max(0.0, sum(r * s for r, s in zip(u, e)) / sum(r * r for r in e)))
        best = min(best, math.dist(p, [r + t * s for r, s in zip(a, e)]) ** 2)
    return {**got, "value": best}


def in_floats(cipc, q):
    """Computed in single precision from world coordinates."""
    import struct
    single = [struct.unpack("f", struct.pack("f", v))[0] for v in q["x"]]
    return evaluate(cipc, {**q, "x": single})


def no_number(cipc, q):
    return {**evaluate(cipc, q), "value": "nan"}


def missed(cipc, q):
    return {"toi": 1.0, "hit": False}


def without_edges(cipc, q):
    """Point-triangle pairs alone."""
    x, xi, total = q["x"], q["thickness"], 0.0
    reach = (xi + q["dhat"]) ** 2 - xi ** 2
    for i in range(6):
        other = x[9:18] if i < 3 else x[0:9]
        d2 = evaluate(cipc, {"id": 1, "fn": "distance2_point_triangle", "x": x[3 * i:3 * i + 3] + other})["value"]
        total += q["stiffness"] * evaluate(cipc, {"id": 1, "fn": "barrier", "x": [d2 - xi ** 2, reach]})["f"][0]
    return {**evaluate(cipc, q), "value": total}


def each_stencil_once(cipc, q):
    """Six pairs share one closest feature: it is kept once, without its multiplicity."""
    got = scaled(evaluate(cipc, q), 1 / 6)
    return {**got, "value": got["value"] / 6}


BUGS = {
    "barrier-hessian-bracket": lost_bracket,
    "factor-two": lambda c, q: scaled(evaluate(c, q), 0.5) if "f" not in evaluate(c, q) else {"f": [0.5 * v for v in evaluate(c, q)["f"]]},
    "thickness-squared": lambda c, q: evaluate(c, with_params(q, offset=q["params"]["offset"] * (1 - 1e-7))),
    "gap-over-thickness-1e-9": lambda c, q: scaled(evaluate(c, q), 1 - 1e-5),
    "mollifier-derivative": lambda c, q: scaled(evaluate(c, q), -1e8),
    "mollifier-ignored": lambda c, q: evaluate(c, with_params(q, mollifier_eps=0.0)),
    "bending-rest-length": lambda c, q: scaled(evaluate(c, q), 1 / edge_length(q), ("gradient", "hessian")),
    "bending-rest-angle": lambda c, q: evaluate(c, with_params(q, rest_angle=0.0)),
    "bending-normal-sign": lambda c, q: evaluate(c, {**q, "x": q["x"][0:6] + q["x"][9:12] + q["x"][6:9]}),
    "bending-flat": lambda c, q: scaled(evaluate(c, q), 0.0, ("gradient",)),
    "strain-limit-log": lambda c, q: {"f": ["nan", "nan", "nan"]},
    "friction-transposed": lambda c, q: evaluate(c, transposed(q)),
    "friction-doubled": lambda c, q: scaled(evaluate(c, q), 2.0),
    "friction-hessian": lambda c, q: scaled(evaluate(c, q), -1.0, ("hessian",)),
    "parallel-edges": nearest_end,
    "parallel-edges-wrong-formula": no_number,
    "degenerate-nan": no_number,
    "sliver": lambda c, q: {**evaluate(c, q), "value": evaluate(c, q)["value"] * (1 + 1e-6)},
    "clamped-side": lambda c, q: {**evaluate(c, q), "value": q["x"][2] ** 2},
    "world-offset": in_floats,
    "predicate-rounding": lambda c, q: {"sign": 0} if evaluate(c, q)["sign"] else {"sign": 1},
    "touching-counts": lambda c, q: {"intersects": False},
    "coplanar": lambda c, q: {"intersects": False},
    "thickness-ignored": lambda c, q: evaluate(c, {**q, "thickness": 0.0}),
    "late": lambda c, q: {**evaluate(c, q), "toi": 1.2 * evaluate(c, q)["toi"]},
    "step-zero": lambda c, q: {"toi": 0.0, "hit": True},
    "parallel-motion-missed": missed,
    "coplanar-motion-missed": missed,
    "touch-missed": missed,
    "world-offset-missed": missed,
    "gap-over-thickness-missed": missed,
    "near-parallel-missed": missed,
    "started-in-contact": missed,
    "zero-length-edge": missed,
    "stencils-counted-once": each_stencil_once,
    "edge-edge-pairs-forgotten": without_edges,
    "mollifier-not-assembled": lambda c, q: evaluate(c, {**q, "rest": [1e-3 * v for v in q["rest"]]}),
    "potential-thickness": lambda c, q: evaluate(c, {**q, "thickness": 0.0}),
}


def main():
    cipc, path, flag = sys.argv[1:4]
    with open(path, encoding="utf-8") as file:
        queries = [json.loads(line) for line in file]
    flags = sorted({f for q in queries for f in q["flags"]})
    if flag == "--list":
        unknown = [f for f in flags if f not in BUGS] + [f for f in BUGS if f not in flags]
        if unknown:
            sys.exit("bugs.py: without a case or without a bug: " + " ".join(unknown))
        print("\n".join(flags))
        return
    for query in queries:
        if flag in query["flags"]:
            query["got"] = BUGS[flag](cipc, query)
            print(json.dumps(query))


if __name__ == "__main__":
    main()
