"""The worked examples of docs/python run and make their figures: of small data that is made here, in the study's folders."""
import os
import re
import subprocess
import sys

import numpy as np
import palpate
import pytest
from conftest import SOURCE

matplotlib = pytest.importorskip("matplotlib")
T = 1_400_000_000_000


def run(name, recordings, out):
    script = SOURCE / "docs/python" / f"{name}.py"
    done = subprocess.run([sys.executable, "-B", script, recordings, "-o", out], capture_output=True, text=True,
                          env={**os.environ, "MPLCONFIGDIR": str(out)}, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def loaded(gain, seconds=6.0):
    """A step of a load on matrix 1, with nothing before and after."""
    t = np.arange(0, seconds, 0.032)
    level = np.concatenate([np.zeros(8), palpate.step_response(t, gain, 5, T1=0.3, T2=0.08), np.zeros(8)])
    frames = np.zeros((len(level), 486))
    frames[:, 84 + 30:84 + 34] = np.round(level)[:, None]
    frames[:, 84 + 36:84 + 40] = np.round(level)[:, None]
    times = T + 32 * np.arange(len(level))
    return palpate.from_arrays(times, frames, temperatures=np.full((2, 9), 25 + gain / 50),
                               temperature_time_ms=[T, T + 1000])


def test_calibration_figures(tmp_path):
    for name in ("hockey_ball", "foam_ball"):
        (tmp_path / "grasps").mkdir(exist_ok=True)
        loaded(400).save(tmp_path / "grasps" / f"{name}.dsa")
    for i, name in enumerate(("room", "operating", "high")):
        folder = tmp_path / "pressure_calibration" / name
        folder.mkdir(parents=True)
        for k, letter in enumerate("ABC"):
            loaded(150 + 80 * k + 20 * i, seconds=12.5).save(folder / f"{letter}1.dsa")
    rng = np.random.default_rng(1)
    warm = np.linspace(25, 55, 200)
    frames = np.zeros((200, 486))
    frames[:, [5, 124, 170, 286, 330, 448]] = np.round(40 + 0.3 * warm + rng.normal(0, 1, 200))[:, None]
    times = T + 3000 * np.arange(200)
    (tmp_path / "calibration_noise").mkdir()
    palpate.from_arrays(times, frames, temperatures=np.repeat(warm[:, None], 9, axis=1),
                        temperature_time_ms=times).save(tmp_path / "calibration_noise" / "temperature-noise.dsa")
    said = run("calibration_figures", tmp_path, tmp_path / "out")
    assert "no step could be fitted" not in said
    for figure in ("3_4", "3_7", "3_12"):
        assert (tmp_path / "out" / f"figure_{figure}.png").stat().st_size > 5000
    # The middle one of nine responses; 0.05 s pass until it has 10 % of its end and counts as touched.
    middle = palpate.step_response(np.array([1.35, 11.05]), 250, 5, T1=0.3, T2=0.08)
    rise = float(said.split("creep: the sum rises by ")[1].split(" %")[0])
    assert rise == pytest.approx(100 * (middle[1] / middle[0] - 1), abs=2)
    rmse = [float(word) for word in said.split("figure 3.12: RMSE ")[1].split(" (")[0].split()]
    np.testing.assert_allclose(rmse, 1.04, atol=0.2)


def test_slip_figures(tmp_path):
    count = 50
    x, y = np.linspace(3.5, 2.5, count), np.linspace(5, 7, count)
    frames = palpate.synthetic_contact(x, y, np.linspace(30, 0, count), shape="bar", noise=1, rows=13)
    blank = [np.zeros((count, 14 - m % 2, 6)) for m in range(6)]
    blank[1] = frames
    (tmp_path / "slip-detection").mkdir()
    palpate.from_arrays(T + 32 * np.arange(count), blank).save(
        tmp_path / "slip-detection" / "slip_and_rotation_teapot_handle.dsa")
    said = run("slip_figures", tmp_path, tmp_path / "out")
    assert (tmp_path / "out" / "figure_5_7.png").stat().st_size > 5000
    (line,) = [one for one in said.splitlines() if "5.7, register" in one]
    found = [float(word.strip("(),")) for word in line.split()[3:5]]
    np.testing.assert_allclose(found, [y[41] - y[13], x[41] - x[13]], atol=0.3)
    (line,) = [one for one in said.splitlines() if "5.7, turn" in one]
    assert float(line.split()[3]) == pytest.approx(-30 * 28 / 49, abs=4)


def test_recognition_figures(tmp_path):
    for name, peak, radius in (("pea", 900, 0.8), ("ball", 1800, 2.4), ("melon", 2600, 4.5)):
        folder = tmp_path / "grasps_by_class" / name
        folder.mkdir(parents=True)
        palpate.synthesize(grasps=8, duration=30, peak=peak, radius=radius, noise=15, angle_rate=40)[0].save(
            folder / "a.dsa")
    said = run("recognition_figures", tmp_path, tmp_path / "out")
    assert "of 3 classes" in said
    for figure in ("6_14", "6_20"):
        assert (tmp_path / "out" / f"figure_{figure}.png").stat().st_size > 5000
    (line,) = [one for one in said.splitlines() if "table 6.1, study:" in one]
    assert float(line.split()[3]) > 0.9


NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
# Of each row of python.md, "The study's figures", where the scripts print its numbers, in the order of the page.
PRINTED = {
    "3.4": rf"3\.4: steady after ({NUMBER}) s \(hockey ball\) and ({NUMBER}) s",
    "3.7/3.8": rf"3\.8: P\(K, T\) has c ({NUMBER}) ({NUMBER}) ({NUMBER}) ({NUMBER}) kPa, RMSE ({NUMBER})",
    "creep": rf"rises by ({NUMBER}) % from (1\.3) s to (11) s after the contact, by ({NUMBER}) %",
    "3.12": rf"3\.12: RMSE" + rf" ({NUMBER})" * 6,
    "5.7, turn": rf"5\.7, turn: ({NUMBER}) deg",
    "5.7, way": r".*?".join(rf"5\.7, {name}: \(({NUMBER}), ({NUMBER})\)" for name in ("alcazar", "register", "contest")),
    "table 6.1": r".*?".join(rf"6\.1, {name}: ({NUMBER})" for name in ("diameter", "first4", "moments", "study", "study and lda")),
    "table 6.2": rf"6\.2: F ({NUMBER})",
}


def test_the_figures_of_the_manual_are_those_that_the_scripts_print(recordings, tmp_path):
    said = "".join(run(name, recordings, tmp_path) for name in
                   ("calibration_figures", "slip_figures", "recognition_figures"))
    page = (SOURCE / "docs/manual/python.md").read_text().split("## The study's figures")[1].split("\n## ")[0]
    rows = [row.strip("| ").split(" | ") for row in page.splitlines() if row.startswith("| ")][1:]  # without the names
    left = dict(PRINTED)
    for section, ours, *_ in rows:
        (key,) = [key for key in left if section.startswith(key)]
        found = re.search(left.pop(key), said, re.DOTALL)
        assert found, f"{section}: {said}"
        told = re.findall(NUMBER, ours.replace("- ", "-"))
        assert len(told) == len(found.groups()), (section, told, found.groups())
        for number, printed in zip(told, found.groups()):
            last_digit = 10.0 ** -len(number.partition(".")[2])
            assert float(number) == pytest.approx(float(printed), abs=0.51 * last_digit), section
    assert not left, f"python.md has no row for {list(left)}"
