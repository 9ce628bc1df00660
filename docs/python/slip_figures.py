#!/usr/bin/env python3
"""Paths and turns of a slipping handle by several methods: the study's figure 5.7 from a folder of recordings.

    PYTHONPATH=build/release/python python3 docs/python/slip_figures.py RECORDINGS -o OUT
"""
import argparse
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import palpate

METHODS = {"alcazar": "C0", "ncc-paraboloid": "C1", "ncc-gauss3": "C2", "phase": "C4", "register": "C3", "contest": "k"}
REFERENCE, LAST = 13, 41  # frames between which the study follows the handle


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("."))
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)

    profile = palpate.load(given.recordings / "slip-detection" / "slip_and_rotation_teapot_handle.dsa")
    matrix = int(palpate.signals(profile)["sum"].sum(axis=0).argmax())
    last = min(LAST, len(profile) - 1)
    figure, (path, way, turn) = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    for method, color in METHODS.items():
        table = palpate.slip(profile, matrix, method=method, reference=REFERENCE)
        rows = (table["frame"] >= REFERENCE) & (table["frame"] <= last)
        t = (table["time_ms"][rows] - profile.time_ms[REFERENCE]) / 1e3
        x, y = table["ref_dx"][rows], table["ref_dy"][rows]  # NaN: the method found no match
        x[0] = y[0] = 0
        wide = {"linewidth": 2 if method in ("register", "contest") else 1}
        path.plot(x, y, ".-", color=color, label=method, markersize=3, **wide)
        way.plot(t, np.hypot(x, y), color=color, label=method, **wide)
        known = np.flatnonzero(np.isfinite(x))[-1]
        print(f"figure 5.7, {method}: ({y[known]:.3f}, {x[known]:.3f}) taxels [y, x] after {t[known]:.3f} s")
        if method == "alcazar":  # the turn is the same for all: that of the principal axis
            turn.plot(t, table["ref_rotation_deg"][rows], color="C0")
            print(f"figure 5.7, turn: {table['ref_rotation_deg'][rows][-1]:.2f} deg after {t[-1]:.3f} s")
    print("study's program: (1.385, 2.721) taxels [y, x], -44.65 deg, after 0.889 s")
    path.set(title="path", xlabel="x [taxels]", ylabel="y [taxels], down", aspect="equal")
    path.invert_yaxis()
    path.legend(fontsize=7)
    way.set(title="distance from the reference", xlabel="time [s]", ylabel="[taxels]")
    turn.set(title="turn since the reference", xlabel="time [s]", ylabel="[deg], from x towards y")
    figure.savefig(given.output / "figure_5_7.png", dpi=120)


if __name__ == "__main__":
    main()
