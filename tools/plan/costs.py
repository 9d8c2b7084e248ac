#!/usr/bin/env python3
"""costs.py ROWS > costs_data.h: instructions per event of a call, fitted to counts (costs.sh)."""

import sys

import numpy as np

LETTERS = "RADO"
WORK = ("blocks parts shadows copies legs runs low_runs low_legs grounds diffuse_parts diffuse_slices diffuse_nodes "
        "diffuse_fine diffuse_fading diffuse_loads").split()
# In the order of plan_event in cost.h.
EVENTS = ("call block part shadow copy run run_node low_run low_node ends_block ends_tangent ground_block ground_ray "
          "ground_table transmittance_ray grid_block grid_ray grid_alone diffuse_part diffuse_slice diffuse_node fine fading load "
          "grid").split()


def features(kind, words):
    """The events of a window."""
    x = dict.fromkeys(EVENTS, 0.0)
    if kind == "grid":
        w = dict(zip(WORK, map(float, words)))
        x["grid"] = 1
        light = 1
    else:
        n, ground, trans, light, rays = map(int, words[:5])
        w = dict(zip(WORK, map(float, words[5:])))
        x.update(call=1, block=w["blocks"], part=w["parts"], shadow=w["shadows"], copy=w["copies"], run=w["runs"],
                 run_node=n * w["runs"], low_run=w["low_runs"], low_node=n * w["low_runs"])
        if ground or trans:
            x.update(ends_block=w["blocks"], ends_tangent=w["parts"] - w["blocks"])
        if ground:
            x.update(ground_block=w["blocks"], ground_ray=w["grounds"])
            x["ground_table"] = w["grounds"] if light else 0
        if trans:
            x["transmittance_ray"] = rays
        if light == 2 and not w["diffuse_parts"]:
            x.update(grid_block=w["blocks"], grid_ray=rays, grid_alone=0 if ground or trans else w["blocks"])
    x.update(diffuse_part=w["diffuse_parts"], diffuse_slice=w["diffuse_slices"], diffuse_node=w["diffuse_nodes"],
             fine=w["diffuse_fine"], fading=w["diffuse_fading"], load=w["diffuse_loads"])
    return [x[e] for e in EVENTS]


def not_negative(a, y):
    """Least squares, relative; what would become negative is left out."""
    a, y = a / y[:, None], np.ones_like(y)
    scale = np.maximum(np.abs(a).max(axis=0), 1e-30)
    use = [i for i in range(a.shape[1]) if np.abs(a[:, i]).max() > 0]
    while True:
        c = np.zeros(a.shape[1])
        # A little ridge: columns that always go together share their cost.
        m = a[:, use] / scale[use]
        c[use] = np.linalg.solve(m.T @ m + 1e-7 * np.eye(len(use)), m.T @ y) / scale[use]
        bad = [i for i in use if c[i] < 0]
        if not bad:
            return c, a @ c - 1
        use.remove(min(bad, key=lambda i: c[i] * scale[i]))


def main():
    groups, order = {}, []
    for line in open(sys.argv[1]):
        target, bands, letters, n, kind, *words = line.split()
        key = (target, int(bands), letters)
        if key not in groups:
            groups[key] = {"rows": [], "begin": []}
            order.append(key)
        g = groups[key]
        if kind == "empty":
            g["empty"] = float(n)
        elif kind in ("call", "grid"):
            g["rows"].append((float(n) - g["empty"], features(kind, words)))
        elif kind == "begin":
            g["begin"].append(float(n) - g["empty"])
        elif kind == "sizes":
            g["sizes"] = [int(w) for w in words]
        elif kind == "time":
            g["ns"] = float(words[0])
    targets = []
    for key in order:
        if key[0] not in targets:
            targets.append(key[0])
    print("// Made by tools/plan/costs.sh: `make plan-costs`. Instructions per event, in the order of plan_event (cost.h).")
    print("// clang-format off")
    print("static const plan_rate plan_rates[] = {")
    for t in targets:
        rate = 0.0
        for key in order:
            g = groups[key]
            if key[0] == t and "ns" in g:
                total = sum(y for y, _ in g["rows"]) + sum(g["begin"])
                rate = 1000 * total / g["ns"]
        print(f'    {{"{t}", {rate:.0f}}}, // instructions per microsecond, 0: not measured')
    print("};\nstatic const plan_costs plan_cost_rows[] = {")
    worst_of = {}
    for key in order:
        g = groups[key]
        y = np.array([r[0] for r in g["rows"]])
        a = np.array([r[1] for r in g["rows"]])
        c, off = not_negative(a, y)
        worst_of.setdefault(key[0], []).append((np.abs(off).mean(), np.abs(off).max(), key))
        mask = sum(1 << LETTERS.index(s) for s in key[2])
        model, frame, lanes, s0, s1, s2, flash_single, flash = g["sizes"]
        values = ", ".join(f"{v:.5g}" for v in c)
        print(f'    {{"{key[0]}", {key[1]}, {mask}, {lanes}, {model}, {frame}, {flash_single}, {flash}, '
              f"{{{s0}, {s1}, {s2}}}, {np.mean(g['begin']):.0f},\n     {{{values}}}}}, // {key[2]}: fit {100 * np.abs(off).mean():.1f} %, "
              f"largest {100 * np.abs(off).max():.1f} %")
    print("};")
    for t, rows in worst_of.items():
        worst = max(rows, key=lambda r: r[1])
        print(f"{t}: mean {100 * np.mean([r[0] for r in rows]):.2f} %, largest {100 * worst[1]:.1f} % in {worst[2]}", file=sys.stderr)


main()
