"""Filters against golden numbers and NumPy's own computations; recipes; series."""
import json

import numpy as np
import palpate
import pytest

SPECS = [
    ("median", {"radius": 1, "masked": False}, "median:size=3"),
    ("median", {"radius": 1, "masked": True}, "median:size=3,masked=1"),
    ("median", {"radius": 2, "masked": False}, "median:size=5"),
    ("gaussian", {"radius": 1, "sigma": 0.849321800288}, "gaussian:size=3"),
    ("gaussian", {"radius": 2, "sigma": 1.273982700432}, "gaussian:size=5"),
    ("opening", {"kernel": "cross", "radius": 1, "masked": False}, "opening:shape=cross,size=3"),
    ("opening", {"kernel": "ellipse", "radius": 2}, "opening:shape=ellipse,size=5"),
]


def sequence(values, interval_ms=30):
    values = np.asarray(values, dtype=np.float32)
    return palpate.from_arrays(1_000_000 + interval_ms * np.arange(len(values)), [values])


def full(frames):
    """Golden frames have zeros where there is no taxel; the filters were run on whole rectangles."""
    parts, begin = [], 0
    for m in range(6):
        rows = 14 if m % 2 == 0 else 13
        parts.append(frames[:, begin:begin + rows * 6].reshape(-1, rows, 6))
        begin += rows * 6
    return parts


@pytest.mark.parametrize("name,params,spec", SPECS, ids=[spec for _, _, spec in SPECS])
def test_golden_frames(golden, name, params, spec):
    settings = json.loads((golden / "filters.json").read_text())
    (given,) = [one["cells"] for one in settings if one["filter"] == "none"]
    (expected,) = [one["cells"] for one in settings if one["filter"] == name and
                   params.items() <= one["params"].items()]
    profile = palpate.from_arrays([0], full(np.array([given], dtype=float)))
    filtered = palpate.filter(profile, spec)
    assert filtered.value_type == "float"
    np.testing.assert_allclose(filtered.frames()[0], expected, rtol=1e-4, atol=1e-3)


def test_median_and_box_as_numpy_has_them():
    values = np.random.default_rng(1).integers(0, 4000, (3, 7, 5))
    padded = np.pad(values, ((0, 0), (1, 1), (1, 1)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(1, 2))
    profile = sequence(values)
    np.testing.assert_array_equal(palpate.filter(profile, "median:size=3").matrix(0),
                                  np.median(windows, axis=(3, 4)))
    np.testing.assert_allclose(palpate.filter(profile, "box:size=3").matrix(0),
                               windows.mean(axis=(3, 4)), rtol=1e-6)


def test_chains_are_one_filter_after_the_other():
    profile = sequence(np.random.default_rng(2).integers(0, 4000, (20, 7, 5)))
    expected = palpate.filter(palpate.filter(profile, "median:size=3"), "running-mean:window=5").frames()
    for chain in (("median:size=3", "running-mean:window=5"), ("median:size=3 | running-mean:window=5",),
                  (["median:size=3", "running-mean:window=5"],)):
        np.testing.assert_array_equal(palpate.filter(profile, *chain).frames(), expected)
    np.testing.assert_array_equal(palpate.filter(profile).frames(), profile.frames())


def test_restarts_begin_anew():
    values = np.ones((10, 1, 1)) * np.arange(10)[:, None, None]
    profile = sequence(values)
    filtered = palpate.filter(profile, "running-mean:window=3", restarts_ms=[int(profile.time_ms[6])])
    assert filtered.frames()[6, 0] == 6 and filtered.frames()[7, 0] == 6.5


def test_series():
    rng = np.random.default_rng(3)
    t, y = 0.03 * np.arange(50), rng.normal(100, 10, 50)
    expected = [y[max(0, i - 4):i + 1].mean() for i in range(50)]
    np.testing.assert_allclose(palpate.filter_series(t, y, "running-mean:window=5"), expected, rtol=1e-5)
    # Zero-order Kalman: at its steady gain 0.270156 (methods, section 1) an exponential mean.
    filtered = palpate.filter_series(t, y, "kalman:q=0.05,r=0.5")
    gains = (filtered[1:] - filtered[:-1]) / (y[1:] - filtered[:-1])
    np.testing.assert_allclose(gains[-10:], 0.270156, atol=2e-4)
    with pytest.raises(ValueError, match="neighbours"):
        palpate.filter_series(t, y, "median:size=3")


def test_savitzky_golay_weights_are_those_of_the_tables():
    np.testing.assert_allclose(palpate.savitzky_golay(5, 2) * 35, [-3, 12, 17, 12, -3], atol=1e-9)
    np.testing.assert_allclose(palpate.savitzky_golay(5, 3, 1) * 12, [1, -8, 0, 8, -1], atol=1e-9)
    np.testing.assert_allclose(palpate.savitzky_golay(5, 2, 2) * 7, [2, -1, -2, -1, 2], atol=1e-9)
    edge = np.polyval(np.polyfit(range(7), [1, 4, 2, 8, 5, 7, 1], 2), 6)  # at the newest sample
    assert palpate.savitzky_golay(7, 2, 0, 6) @ [1, 4, 2, 8, 5, 7, 1] == pytest.approx(edge)


def test_the_list_of_filters():
    kinds = {kind["name"]: kind for kind in palpate.filters()}
    assert {"box", "gaussian", "median", "bilateral", "nlm", "opening", "threshold", "running-mean", "kalman",
            "temporal-gaussian", "temporal-min", "kelvin-voigt", "rts", "median3d", "min-median",
            "savitzky-golay"} <= set(kinds)
    assert {o["key"]: o["default"] for o in kinds["opening"]["options"]}["shape"] == "cross"
    profile = sequence(np.ones((60, 5, 5)))
    for name in kinds:  # all of them run with their defaults
        assert np.isfinite(palpate.filter(profile, name).frames()).all()


def test_recipes(tmp_path):
    path = tmp_path / "r.json"
    palpate.save_recipe(path, "median:size=5", "kalman", name="mine")
    assert palpate.read_recipe(path) == "median:size=5 | kalman"
    profile = sequence(np.random.default_rng(4).integers(0, 4000, (6, 7, 5)))
    np.testing.assert_array_equal(palpate.filter(profile, recipe=path).frames(),
                                  palpate.filter(profile, "median:size=5", "kalman").frames())
    with pytest.raises(OSError):
        palpate.save_recipe(path, "kalman")
    palpate.save_recipe(path, "kalman", force=True)
    path.write_text("{")
    with pytest.raises((ValueError, palpate.Error)):
        palpate.read_recipe(path)
    for text in palpate.recipes().values():
        palpate.filter(profile, text).frames()
    with pytest.raises(ValueError, match="not both"):
        palpate.filter(profile, "kalman", recipe=path)


def test_ghosts_are_counted():
    values = np.zeros((30, 14, 6))
    values[::3, 4, 2] = 7  # one false taxel in ten frames
    report = palpate.ghosts(sequence(values), "median:size=3")
    assert report["frames"] == 30
    assert report["false_taxels"] == {"before": 10, "after": 0, "share_removed": 1.0}
    assert report["frames_with_false"]["before"] == 10


def test_kelvin_voigt_finds_the_pace():
    rng = np.random.default_rng(5)
    t = 0.02 * np.arange(1500)
    step = 0.002  # simulated finer than it is sampled
    y, v, series = 0.0, 0.0, []
    for i in range(len(t) * 10):
        v += (-400 * y - 8 * v) * step + rng.normal(0, 3000) * np.sqrt(step)
        y += v * step
        if i % 10 == 9:
            series.append(y + rng.normal(0, 1))
    fit = palpate.fit_kelvin_voigt(t, series)
    assert fit["converged"]
    assert fit["natural_hz"] == pytest.approx(20 / (2 * np.pi), rel=0.1)
    assert np.all(np.diff(fit["log_likelihood"]) > -1e-3)
    assert fit["smoothed"].shape == t.shape and np.all(fit["smoothed_variance"] >= 0)


def test_butterworth_as_scipy_has_it():
    signal = pytest.importorskip("scipy.signal")
    t = np.arange(400) / 100.0
    values = 500 + 100 * np.sin(2 * np.pi * 3 * t) + 40 * np.cos(2 * np.pi * 21 * t) + 80 * (t > 2)
    for spec, order, edges, kind in (("low-pass:cutoff=8,order=4", 4, 8, "low"),
                                     ("high-pass:cutoff=2,order=3", 3, 2, "high"),
                                     ("band-pass:low=2,high=9,order=2", 2, [2, 9], "bandpass"),
                                     ("band-stop:low=19,high=23,order=2", 2, [19, 23], "bandstop")):
        sos = signal.butter(order, edges, kind, fs=100, output="sos")
        forward, _ = signal.sosfilt(sos, values, zi=signal.sosfilt_zi(sos) * values[0])
        np.testing.assert_allclose(palpate.filter_series(t, values, spec), forward, atol=2e-3)
        np.testing.assert_allclose(palpate.filter_series(t, values, spec + ",centred=1"),
                                   signal.sosfiltfilt(sos, values), atol=2e-3)


def test_frequencies_end_at_half_the_rate():
    t = np.arange(50) / 40.0
    for spec in ("low-pass:cutoff=20", "band-stop:low=5,high=30,centred=1"):
        with pytest.raises(ValueError, match="not below 20.00 Hz, half the rate"):
            palpate.filter_series(t, np.ones(50), spec)
    with pytest.raises(ValueError, match="not below 20.00 Hz, half the rate"):
        palpate.filter(sequence(np.zeros((50, 2, 2)), interval_ms=25), "high-pass:cutoff=20")
