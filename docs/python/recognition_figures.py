#!/usr/bin/env python3
"""Scatter of features, accuracies and confusion: the study's figures 6.14 and 6.20 and table 6.1 from a folder of recordings.

    PYTHONPATH=build/release/python python3 docs/python/recognition_figures.py RECORDINGS -o OUT
"""
import argparse
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import palpate


def scatter(features, out):
    """Figure 6.14: the first four features against each other, standardised."""
    x = features.values[:, :4]
    sd = x.std(axis=0)
    x = (x - x.mean(axis=0)) / np.where(sd > 0, sd, 1)
    names = sorted(set(features.classes))
    color = [names.index(one) for one in features.classes]
    figure, axes = plt.subplots(4, 4, figsize=(9, 9), layout="constrained")
    for i in range(4):
        for j in range(4):
            axis = axes[i][j]
            if i == j:
                axis.hist(x[:, i], bins=30, color="0.6")
            else:
                axis.scatter(x[:, j], x[:, i], c=color, cmap="gist_ncar", s=5)
            axis.set_xlabel(features.names[j] if i == 3 else "")
            axis.set_ylabel(features.names[i] if j == 0 else "")
            axis.tick_params(labelsize=6)
    figure.savefig(out / "figure_6_14.png", dpi=120)


def accuracies(features):
    """Table 6.1."""
    for name, lda, study in (("diameter", None, "0.734"), ("first4", None, "0.872"), ("moments", None, "0.711"),
                             ("study", None, "0.903"), ("study", 14, "0.976")):
        components = lda and min(lda, len(set(features.classes)) - 1)
        report = palpate.evaluate(features, set=name, lda=components)
        print(f"table 6.1, {name}{' and lda' if lda else ''}: {report['accuracy_mean']:.3f} "
              f"+- {report['accuracy_sd']:.3f} (study: {study})")
    return report


def confusion(report, out):
    """Figure 6.20: rows are what was grasped, columns what it was called."""
    labels, counts = report["confusion_labels"], report["confusion"]
    size = max(4, 0.24 * len(labels))
    figure, axis = plt.subplots(figsize=(size + 1, size), layout="constrained")
    share = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    image = axis.imshow(share, cmap="Blues", vmin=0, vmax=1)
    for (i, j), count in np.ndenumerate(counts):
        if count:
            axis.text(j, i, count, ha="center", va="center", fontsize=6, color="white" if share[i, j] > 0.5 else "black")
    axis.set_xticks(range(len(labels)), labels, rotation=90, fontsize=7)
    axis.set_yticks(range(len(counts)), labels[:len(counts)], fontsize=7)
    axis.set(xlabel="called", ylabel="grasped")
    figure.colorbar(image, label="share of the grasps", shrink=0.6)
    figure.savefig(out / "figure_6_20.png", dpi=120)
    f = np.average([one["f"] for one in report["classes"]], weights=[one["support"] for one in report["classes"]])
    print(f"table 6.2: F {f:.3f} on average (study: 0.969)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("."))
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    features = palpate.features(given.recordings / "grasps_by_class", "study")
    for trouble in features.troubles:
        print(trouble)
    print(f"{len(features)} grasps of {len(set(features.classes))} classes (study: 856 of 36)")
    scatter(features, given.output)
    confusion(accuracies(features), given.output)


if __name__ == "__main__":
    main()
