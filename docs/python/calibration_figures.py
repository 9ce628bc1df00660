#!/usr/bin/env python3
"""Step fits and noise lines: the study's figures 3.4, 3.7 and 3.12 from a folder of recordings.

    PYTHONPATH=build/release/python python3 docs/python/calibration_figures.py RECORDINGS -o OUT
"""
import argparse
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import palpate

MATRIX = 1  # finger 0 distal
PRESSURES_KPA = dict(zip("ABCDEFGH", (17.796, 26.694, 35.592, 44.490, 53.388, 62.286, 71.184, 80.082)))


def fitted_steps(path):
    """The loading steps of a recording that could be fitted, longest first."""
    steps = palpate.calibrate_step(palpate.load(path), MATRIX)["steps"]
    return sorted((step for step in steps if step["converged"]), key=lambda step: -step["t"][-1])


def curve(step, t):
    return palpate.step_response(t, step["K"], step["m"], T=step["T"], d=step["d"])


def exemplary_fits(recordings, out):
    """Figure 3.4: the same grasp of a hard and of a soft ball."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    settled = {}
    for axis, name in zip(axes, ("hockey_ball", "foam_ball")):
        steps = [s for s in fitted_steps(recordings / "grasps" / f"{name}.dsa") if s["usable"]]
        if not steps:
            print(f"figure 3.4, {name}: no step could be fitted")
            continue
        settled[name] = np.median([s["steady_s"] for s in steps])
        step = min(steps, key=lambda s: s["rmse"] / s["K"])
        axis.plot(step["t"], step["y"], ".", color="0.5", markersize=4, label="filtered mean")
        t = np.linspace(0, step["t"][-1], 500)
        axis.plot(t, curve(step, t), color="C3", label=f"K {step['K']:.0f}, m {step['m']:.1f}/s, RMSE {step['rmse']:.1f}")
        axis.axvline(step["steady_s"], color="C0", linestyle=":", label=f"steady after {step['steady_s']:.2f} s")
        axis.set(title=name.replace("_", " "), xlabel="time [s]", ylabel="mean of active taxels [counts]")
        axis.legend(loc="lower right")
    if len(settled) == 2:
        print(f"figure 3.4: steady after {settled['hockey_ball']:.2f} s (hockey ball) and {settled['foam_ball']:.2f} s "
              "(foam ball), median of the grasps (study: 3 times longer for foam, of two other recordings)")
    figure.savefig(out / "figure_3_4.png", dpi=120)


def pressure_series(recordings, out):
    """Figure 3.7: fitted steps under known pressures, in three ranges of temperature."""
    ranges = [d for d in ("room", "operating", "high") if (recordings / "pressure_calibration" / d).is_dir()]
    figure, axes = plt.subplots(1, len(ranges), figsize=(3.6 * len(ranges), 3.6), sharey=True, squeeze=False,
                                layout="constrained")
    table = []
    for axis, name in zip(axes[0], ranges):
        for path in sorted((recordings / "pressure_calibration" / name).glob("[A-H]*.dsa")):
            steps = fitted_steps(path)
            pressure = PRESSURES_KPA[path.name[0]]
            table.append((path, pressure))
            if not steps:
                print(f"figure 3.7, {name} {path.name}: no step could be fitted")
                continue
            step = steps[0]
            t = np.linspace(0, step["t"][-1], 300)
            axis.plot(t, curve(step, t), color=plt.cm.viridis((pressure - 15) / 70), label=f"{pressure:.0f} kPa")
        axis.set(title=f"{name} temperature", xlabel="time [s]")
    axes[0][0].set_ylabel("fitted response [counts]")
    axes[0][-1].legend(fontsize=7, loc="lower right")
    figure.savefig(out / "figure_3_7.png", dpi=120)
    gain = palpate.calibrate_pressure(table, matrix=MATRIX, choices="study").report["K"]
    print("figure 3.8: P(K, T) has c", " ".join(f"{c:.4g}" for c in gain["c"]),
          f"kPa, RMSE {gain['rmse_kpa']:.2f} kPa over {len(table)} steps "
          "(study: 31.9 -0.625 0.0978 -3.86e-05, RMSE 2.75 over its 54)")


def creep(recordings, _):
    """How much the sum of the loaded matrix rises under a constant weight, from 1.3 s after the contact."""
    rises, last_seconds = [], []
    for path in sorted((recordings / "pressure_calibration").glob("*/[A-H]*.dsa")):
        profile = palpate.load(path)
        total = profile.matrix(MATRIX).sum(axis=(1, 2))
        t = profile.time_s - profile.time_s[np.argmax(total > 0.1 * total.max())]
        end = t[np.flatnonzero(total > 0.5 * total.max())[-1]]

        def level(at, half):
            return np.median(total[(t > at - half) & (t < at + half)])

        if end < 11.5:
            continue
        rises.append(level(11, 0.5) / level(1.3, 0.3) - 1)
        last_seconds.append(level(11, 0.5) / level(10, 0.5) - 1)
    if rises:
        print(f"creep: the sum rises by {100 * np.median(rises):.0f} % from 1.3 s to 11 s after the contact, by "
              f"{100 * np.median(last_seconds):.1f} % in the last second (medians of {len(rises)} steps that last)")
    else:
        print("creep: no step lasts 11.5 s")


def noise_lines(recordings, out):
    """Figure 3.12: the largest reading of unloaded matrices over the temperature nearby."""
    profile = palpate.load(recordings / "calibration_noise" / "temperature-noise.dsa")
    largest = palpate.signals(profile)["max"]
    warmth = profile.temperatures_at_frames()
    lines = palpate.calibrate_noise(profile)["matrices"]
    figure, axes = plt.subplots(2, 3, figsize=(10, 5.6), sharex=True, layout="constrained")
    for line in lines:
        m = line["index"]
        axis = axes[1 - m % 2][m // 2]  # distal above proximal, as on the hand
        t = np.linspace(warmth[:, m + 1].min(), warmth[:, m + 1].max(), 50)
        fitted = line["intercept"] + line["slope"] * t
        axis.plot(warmth[:, m + 1], largest[:, m], ".", color="0.7", markersize=2)
        bins = [one for one in line["bins"] if one["count"] > 0]
        axis.errorbar([b["temperature_c"] for b in bins], [b["mean"] for b in bins], [b["sd"] for b in bins],
                      fmt="o", color="C0", markersize=3, linewidth=1)
        axis.plot(t, fitted, color="C3", label=f"{line['slope']:.3f} T + {line['intercept']:.2f}")
        axis.plot(t, fitted + 3 * line["rmse"], color="C3", linestyle="--", label="+ 3 RMSE: threshold")
        axis.set_title(profile.matrices[m]["name"], fontsize=9)
        axis.set_ylim(np.percentile(largest[:, m], 0.5) - 3, np.percentile(largest[:, m], 99.5) + 8)
        axis.legend(fontsize=7, loc="upper left")
    figure.supxlabel("temperature of the nearest motor [deg C]", fontsize=9)
    figure.supylabel("largest reading [counts]", fontsize=9)
    figure.savefig(out / "figure_3_12.png", dpi=120)
    print("figure 3.12: RMSE", " ".join(f"{line['rmse']:.6f}" for line in lines),
          "(study's program: 2.425417 0.708428 2.894096 0.930476 2.646151 0.850922)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("."))
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    for part, work in (("grasps", exemplary_fits), ("pressure_calibration", pressure_series), ("pressure_calibration", creep),
                       ("calibration_noise", noise_lines)):
        if (given.recordings / part).is_dir():
            work(given.recordings, given.output)
        else:
            print(f"{part} is missing in {given.recordings}: its figure is left out")


if __name__ == "__main__":
    main()
