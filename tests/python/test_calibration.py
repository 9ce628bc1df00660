"""Step fits, noise, sensitivity and pressure against golden numbers, the study's and known truth."""
import numpy as np
import palpate
import pytest
from conftest import rows_of


def step(t, gain, drift, t1, t2):
    return gain * (1 - (t1 * np.exp(-t / t1) - t2 * np.exp(-t / t2)) / (t1 - t2)) + drift * t


def test_response_is_the_formula():
    t = np.linspace(0, 3, 50)
    np.testing.assert_allclose(palpate.step_response(t, 500, 4, T1=0.3, T2=0.1), step(t, 500, 4, 0.3, 0.1))
    same = palpate.step_response(t, 500, T=0.2, d=1)
    np.testing.assert_allclose(same, 500 * (1 - (1 + t / 0.2) * np.exp(-t / 0.2)), atol=1e-6)
    for wrong in ({}, {"T1": 1}, {"T1": 1, "T2": 1, "T": 1, "d": 2}, {"T1": -1, "T2": 1}):
        with pytest.raises(ValueError):
            palpate.step_response(t, 500, **wrong)


def test_fit_finds_what_was_there():
    rng = np.random.default_rng(1)
    t = np.arange(0, 6, 0.032)
    errors = []
    for _ in range(40):
        fit = palpate.fit_step(t, step(t, 600, 5, 0.25, 0.06) + rng.normal(0, 2, len(t)))
        assert fit["converged"] and fit["usable"] and fit["covariance"].shape == (4, 4)
        errors.append((fit["K"] - 600) / np.sqrt(fit["covariance"][0, 0]))
    assert abs(np.mean(errors)) < 0.6 and 0.7 < np.std(errors) < 1.4  # the covariance is right
    flat = palpate.fit_step([0, 1, 2], [0, 0, 0])
    assert not flat["converged"] and flat["notes"]
    for name in ("K", "m", "T1", "T2", "T", "d", "rmse", "residual_sd"):  # nothing was fitted
        assert np.isnan(flat[name]), name


def test_steps_of_every_signal(recordings):
    profile = palpate.load(recordings / "grasps" / "foam_ball.dsa")
    for signal in palpate.signals(profile, 1):
        if signal != "time_ms":
            assert palpate.calibrate_step(profile, 1, signal=signal)["signal"] == signal


def test_golden_steps(golden, recordings):
    for row in rows_of(golden / "pressure_calibration.csv"):
        report = palpate.calibrate_step(palpate.load(recordings / row["file"]), 1)
        found = max(report["steps"], key=lambda one: len(one["t"]))
        assert found["K"] == pytest.approx(float(row["K"]), rel=0.01), row["file"]
        assert found["m"] == pytest.approx(float(row["drift_m"]), abs=0.15), row["file"]
        again = palpate.fit_step(found["t"], found["y"])
        assert again["K"] == pytest.approx(found["K"])


def test_noise_lines_are_the_studys(recordings):
    found = palpate.calibrate_noise(
        palpate.load(recordings / "calibration_noise" / "temperature-noise.dsa"))["matrices"]
    # reference of the prior program: RMSE of its XML, slopes and intercepts found again
    np.testing.assert_allclose([one["rmse"] for one in found],
                               [2.425417, 0.708428, 2.894096, 0.930476, 2.646151, 0.850922], atol=1e-5)
    np.testing.assert_allclose([one["slope"] for one in found],
                               [.332, .200, .360, .163, .408, .174], atol=6e-4)
    np.testing.assert_allclose([one["intercept"] for one in found],
                               [33.63, 42.57, 41.55, 40.17, 30.62, 45.30], atol=6e-3)


def test_noise_is_saved(tmp_path):
    rng = np.random.default_rng(2)
    warm = np.linspace(25, 55, 400)
    peak = 40 + 0.3 * warm + rng.normal(0, 1, 400)
    frames = np.zeros((400, 486))
    frames[:, ::81] = np.round(peak)[:, None]
    degrees = np.repeat(warm[:, None], 9, axis=1)
    times = 3000 * np.arange(1, 401)
    noise = palpate.calibrate_noise(palpate.from_arrays(
        times, frames, temperatures=degrees, temperature_time_ms=times))
    assert noise["matrices"][0]["slope"] == pytest.approx(0.3, abs=0.03)
    assert noise["matrices"][0]["rmse"] == pytest.approx(1.04, abs=0.15)
    palpate.save_noise(noise, tmp_path / "n.xml")
    assert "<slope>" in (tmp_path / "n.xml").read_text()
    with pytest.raises(OSError):
        palpate.save_noise(noise, tmp_path / "n.xml")
    palpate.save_noise(noise, tmp_path / "n.json")
    with pytest.raises((palpate.Error, ValueError)):
        palpate.save_noise({}, tmp_path / "m.json")


def test_sensitivity_is_a_line():
    found = palpate.calibrate_sensitivity([0.1, 0.5, 1.0], [50, 290, 590])
    slope, offset = np.polyfit([0.1, 0.5, 1.0], [50, 290, 590], 1)
    assert found["slope"] == pytest.approx(slope) and found["offset"] == pytest.approx(offset)
    with pytest.raises(ValueError):
        palpate.calibrate_sensitivity([0.1, 0.5], [50])


def test_study_pressure_model_is_least_squares(golden):
    rows = rows_of(golden / "pressure_calibration.csv")
    k, m, p, t = (np.array([float(row[name]) for row in rows]) for name in
                  ("K", "drift_m", "pressure_kPa", "temp_sample1_mean9"))
    found = palpate.fit_pressure(k, m, p, t, study=True)
    design = np.stack([np.ones_like(k), t, k, k * t], axis=1)
    expected = np.linalg.lstsq(design, p, rcond=None)[0]
    np.testing.assert_allclose(found["K"]["c"], expected, rtol=1e-5)
    rms = np.sqrt(np.mean((design @ expected - p) ** 2))
    assert found["K"]["rmse_kpa"] == pytest.approx(rms, rel=1e-6)


def test_calibration_from_recordings(recordings, tmp_path):
    masses = dict(zip("ABCDEFGH", (17.796, 26.694, 35.592, 44.490, 53.388, 62.286, 71.184, 80.082)))
    table = [(path, masses[path.name[0]])
             for path in sorted((recordings / "pressure_calibration").glob("*/*.dsa"))]
    made = palpate.calibrate_pressure(table + [(tmp_path / "missing.dsa", 10.0)], area=110.25)
    report = made.report
    assert report["K"]["rmse_kpa"] < 3.5  # the study's 2.75 over its 54 steps
    assert [one["file"] for one in report["samples"] if not one["used"]] == [str(tmp_path / "missing.dsa")]
    made.save(tmp_path / "c.json")
    with pytest.raises(OSError):
        made.save(tmp_path / "c.json")
    again = palpate.Calibration.load(tmp_path / "c.json")
    at = again.pressure_at([200, 400], 40)
    terms = dict(zip(("1", "T", "K", "KT"), report["K"]["c"]))
    if len(terms) == 4:
        expected = [terms["1"] + terms["T"] * 40 + terms["K"] * k + terms["KT"] * k * 40 for k in (200, 400)]
        np.testing.assert_allclose(at["pressure_kpa"], expected, rtol=1e-9)
    assert (at["pressure_sd_kpa"] > 0).all() and at["in_range"].all()
    profile = palpate.load(table[3][0])
    forces = again.apply(profile)
    late = np.flatnonzero(forces["active"][:, 1] > 0)[40:-5]
    # 500 g stood on it: 4.905 N, within the calibration's own scatter
    assert np.median(forces["force_n"][late, 1]) == pytest.approx(4.905, rel=0.2)
    assert forces["pressure_kpa"].shape == (len(profile), 6) and forces["assumptions"]
    np.testing.assert_allclose(forces["hand_force_n"], forces["force_n"].sum(axis=1), rtol=1e-5)
    known = forces["in_range"][:, 1]
    force = palpate.derive(profile, "m1_force_n", calibration=again)
    np.testing.assert_allclose(force[known], forces["force_n"][known, 1], rtol=1e-5)
    assert np.isnan(force[~known]).all() and known.sum() > 20
    with pytest.raises(palpate.Error, match="filtered"):
        again.apply(palpate.filter(profile, "median"))
    (tmp_path / "c.json").write_text("{}")
    with pytest.raises(ValueError):
        palpate.Calibration.load(tmp_path / "c.json")


def test_tare():
    frames = np.zeros((100, 486))
    frames[:, 90] = 40
    tare = palpate.calibrate_tare(palpate.from_arrays(30 * np.arange(100), frames))
    assert tare["zero"][90] == 40 and tare["zero"].sum() == 40
