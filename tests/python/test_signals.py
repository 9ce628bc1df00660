"""Signals and spectra against NumPy's own; profiles of arrays."""
import numpy as np
import palpate
import pytest

T = 1_400_000_000_000


def profile_of(*matrices, interval_ms=30):
    count = len(matrices[0])
    return palpate.from_arrays(T + interval_ms * np.arange(count), list(matrices), pitch_mm=2.0)


def test_signals_are_those_of_numpy():
    rng = np.random.default_rng(1)
    a = rng.integers(1, 4000, (20, 5, 4)) * (rng.random((20, 5, 4)) < 0.4)
    b = np.zeros((20, 3, 3))
    profile = profile_of(a, b)
    every = palpate.signals(profile)
    assert every["mean"].shape == (20, 2)
    np.testing.assert_array_equal(every["time_ms"], profile.time_ms)
    active = (a > 0).sum(axis=(1, 2))
    np.testing.assert_array_equal(every["active"][:, 0], active)
    np.testing.assert_allclose(every["mean"][:, 0], a.sum(axis=(1, 2)) / active)
    np.testing.assert_allclose(every["sum"][:, 0], a.sum(axis=(1, 2)))
    np.testing.assert_allclose(every["max"][:, 0], a.max(axis=(1, 2)))
    np.testing.assert_allclose(every["min"][:, 0], [one[one > 0].min() for one in a])
    np.testing.assert_allclose(every["area_mm2"][:, 0], active * 4.0)
    for name in ("mean", "filtered_mean", "min", "max", "sum", "active", "area_mm2"):
        assert not every[name][:, 1].any()  # nothing touches it
        np.testing.assert_array_equal(palpate.signals(profile, 0)[name], every[name][:, 0])
    np.testing.assert_allclose(palpate.signals(profile, "hand")["mean"], a.sum(axis=(1, 2)) / active)


def test_filtered_mean_is_equation_3_2():
    values = np.zeros((1, 5, 5))
    values[0, 2, 2] = 1000
    w = np.exp(-np.array([-1, 0, 1]) ** 2 / (2 * 0.849322 ** 2))
    w /= w.sum()
    filtered = 1000 * np.outer(w, w)
    assert palpate.signals(profile_of(values), 0)["filtered_mean"][0] == pytest.approx(
        filtered.mean(), rel=1e-4)


def test_spectrum_is_that_of_numpy():
    t = np.arange(256) / 64.0
    y = 5 * np.sin(2 * np.pi * 8 * t) + 3
    found = palpate.spectrum(t, y, window=64, overlap=32)
    assert found["rate_hz"] == pytest.approx(64) and found["nyquist_hz"] == pytest.approx(32)
    assert found["magnitude"].shape == (7, 33) and found["frequency_hz"][8] == pytest.approx(8)
    assert found["strongest_hz"] == pytest.approx(8)
    np.testing.assert_allclose(found["magnitude"][:, 8], 5, rtol=1e-6)
    window = np.hanning(65)[:-1]
    part = y[:64] - y[:64].mean()
    expected = np.abs(np.fft.rfft(part * window)) ** 2 * 2 / (64 * (window ** 2).sum())
    np.testing.assert_allclose(found["psd"][0][1:-1], expected[1:-1], atol=1e-9)
    np.testing.assert_allclose(found["time_s"], (np.arange(7) * 32 + 32) / 64)
    with pytest.raises(ValueError, match="has 10 samples, a window takes 32"):
        palpate.spectrum(t[:10], y[:10])


def test_places_and_first_contact():
    values = np.zeros((30, 6, 4))
    assert palpate.strongest_taxel(profile_of(values)) is None
    assert palpate.first_contact(profile_of(values)) is None
    values[12:, 3, 1:4] = 100
    values[12:, 3, 2] = 300
    assert palpate.strongest_taxel(profile_of(values)) == (0, 2, 3)
    assert palpate.first_contact(profile_of(values)) == 12
    assert palpate.first_contact(profile_of(values), taxels=4) is None


def test_profiles_of_arrays(tmp_path):
    rng = np.random.default_rng(2)
    frames = rng.integers(0, 4000, (8, 486))
    angles, warmth = rng.normal(0, 40, (5, 7)), rng.normal(35, 1, (2, 9))
    times = T + np.array([0, 30, 61, 90, 120, 2000, 2030, 2060])
    profile = palpate.from_arrays(times, frames, angles=angles, angle_time_ms=T + 20 * np.arange(5),
                                  temperatures=warmth, temperature_time_ms=[T, T + 1000], serial="AB")
    np.testing.assert_array_equal(profile.frames(), frames)
    np.testing.assert_array_equal(profile.time_ms, times)
    np.testing.assert_allclose(profile.time_s, (times - T) / 1e3)
    np.testing.assert_array_equal(profile.angles, angles)
    np.testing.assert_array_equal(profile.temperatures_at_frames(),
                                  warmth[[0, 0, 0, 0, 0, 1, 1, 1]])
    np.testing.assert_array_equal(profile.taxel(1, 2, 3), profile.matrix(1)[:, 3, 2])
    timing = profile.timing()
    assert timing["gaps"] == [(4, pytest.approx(1.88))] and timing["duration_s"] == pytest.approx(2.06)
    assert profile.frame_at(T + 89) == 2 and profile.frame_at(0) == 0
    assert profile.serial == "AB" and profile.value_type == "counts" and profile.format == "arrays"
    info = palpate.info(profile)
    assert (info["frames"], info["gaps"], info["max_value"]) == (8, 1, frames.max())
    part = profile.crop(2, -3)
    np.testing.assert_array_equal(part.frames(), frames[2:6])
    profile.save(tmp_path / "a.palpate", events=[{"t_us": T * 1000, "kind": "label", "text": "x"}])
    np.testing.assert_array_equal(palpate.load(tmp_path / "a.palpate").frames(), frames)
    (event,) = palpate.events(tmp_path / "a.palpate")
    assert (event["kind"], event["text"], event["t1_us"]) == ("label", "x", T * 1000)
    assert palpate.details(tmp_path / "a.palpate")["labels"] == ["x"]
    assert palpate.meta(tmp_path / "a.palpate")["serial"] == "AB"
    seconds = palpate.seconds(tmp_path / "a.palpate")
    assert seconds["frames"].sum() == 8 * 6
    pads = [{"rows": m["rows"], "columns": m["columns"]} for m in profile.matrices]
    assert pads == [{"rows": 14 - m % 2, "columns": 6} for m in range(6)]


def test_tables_are_flat_for_pandas():
    values = np.random.default_rng(5).integers(0, 2000, (4, 486)).astype(float)
    profile = palpate.from_arrays(1_000_000 + 32 * np.arange(4), values)
    table = palpate.signals(profile)
    flat = palpate.flat(table)
    assert [one.ndim for one in flat.values()] == [1] * len(flat)
    assert {len(one) for one in flat.values()} == {4}
    np.testing.assert_array_equal(flat["mean_3"], table["mean"][:, 3])
    np.testing.assert_array_equal(flat["time_ms"], table["time_ms"])
    contact = palpate.contact(profile, angles_deg=palpate.preshape("parallel"))
    flat = palpate.flat(contact)
    np.testing.assert_array_equal(flat["sphere_mm_y"], contact["sphere_mm"][:, 1])
    np.testing.assert_array_equal(flat["centroid_mm_5_z"], contact["centroid_mm"][:, 5, 2])
    np.testing.assert_array_equal(flat["area_mm2_0"], contact["area_mm2"][:, 0])
    places = palpate.flat(palpate.kinematics([0] * 7))
    assert len(places["position_mm_x"]) == 486 and all(one.ndim == 1 for one in places.values())
    slip = palpate.slip(profile)
    assert set(palpate.flat(slip)) == set(slip)
    with pytest.raises(ValueError, match="isn't an array|isn't a table"):
        palpate.flat(palpate.info(profile))
    with pytest.raises(ValueError, match="rows"):
        palpate.flat({"a": np.zeros(3), "b": np.zeros(4)})


def test_contact_of_filtered_values_is_that_of_the_recording():
    values = np.zeros((60, 6, 4))
    values[10:20, 2:4, 1:3] = 1000
    profile = profile_of(values)
    for spec in ("kalman", "rts", "gaussian", "running-mean"):
        filtered = palpate.filter(profile, spec)
        found = palpate.signals(filtered, 0)
        np.testing.assert_array_equal(found["active"], palpate.signals(profile, 0)["active"])
        given = filtered.matrix(0)  # all that the filter gave, the tail and the neighbours, too
        assert (given > 0).sum() > (values > 0).sum()
        held = np.where(values > 0, given, 0).astype(float)
        np.testing.assert_allclose(found["sum"], held.sum(axis=(1, 2)), rtol=1e-6)
        # docs/manual/columns.md: over the active ones and those that hold at least 1 % of the largest value.
        counted = np.where((values > 0) | (given > 0.01 * given.max(axis=(1, 2), keepdims=True)), given, 0).astype(float)
        mean = counted[10:20].sum(axis=(1, 2)) / (counted[10:20] > 0).sum(axis=(1, 2))
        np.testing.assert_allclose(found["mean"][10:20], mean, rtol=1e-6)


def test_coherence_and_peaks_are_those_of_scipy():
    signal = pytest.importorskip("scipy.signal")
    random = np.random.default_rng(5)
    t = np.arange(2000) / 80.0
    a = 20 * np.sin(2 * np.pi * 7 * t) + random.normal(size=2000)
    b = 5 * np.sin(2 * np.pi * 7 * t - 1) + random.normal(size=2000)
    found = palpate.coherence(t, a, b, window=128)
    frequency, expected = signal.coherence(a, b, 80, nperseg=128)
    np.testing.assert_allclose(found["frequency_hz"], frequency, rtol=1e-9)
    np.testing.assert_allclose(found["coherence"], expected, atol=1e-6)
    cross = signal.csd(a, b, 80, nperseg=128)[1]
    near = np.argmin(abs(frequency - 7))
    assert found["phase_deg"][near] == pytest.approx(np.degrees(np.angle(cross[near])), abs=1e-3)
    peak = palpate.spectrum(t, a, window=128, overlap=64)["peaks"][0]
    assert peak["frequency_hz"] == pytest.approx(7, abs=0.05)
    assert peak["amplitude"] == pytest.approx(20, rel=0.05)
    with pytest.raises(ValueError, match="two segments"):
        palpate.coherence(t[:100], a[:100], b[:100])


def test_derived_curves_are_those_of_numpy():
    random = np.random.default_rng(8)
    values = random.integers(1, 4000, (60, 3, 4)).astype(float)
    profile = palpate.from_arrays(1_000_000 + np.cumsum(random.integers(20, 40, 60)), [values])
    seconds = profile.time_s
    sums = values.sum(axis=(1, 2))
    np.testing.assert_allclose(palpate.derive(profile, "m0_sum / 2 - abs(m0_x1_y2)"),
                               sums / 2 - values[:, 2, 1])
    np.testing.assert_allclose(palpate.derive(profile, "der(hand_sum)"), np.gradient(sums, seconds))
    columns = np.arange(4)[None, None, :]
    np.testing.assert_allclose(palpate.derive(profile, "m0_centroid_x_mm"),
                               3.4 * (values * columns).sum(axis=(1, 2)) / sums, rtol=1e-6)
    with pytest.raises(ValueError, match="no m0_force_n: needs a calibration: .*calibration="):
        palpate.derive(profile, "m0_force_n")
    with pytest.raises(ValueError, match="need a calibration"):
        palpate.derive(profile, "m0_sum", tare=True)
    for wrong in ("m0_sum +", "m7_sum", "angle0"):
        with pytest.raises(ValueError, match="formula"):
            palpate.derive(profile, wrong)


def test_a_pitch_is_one_number_or_two():
    frames = [np.ones((1, 2, 3))]
    (matrix,) = palpate.from_arrays([T], frames, pitch_mm=(5.28, 10.28)).matrices
    assert matrix["pitch_mm"] == [5.28, 10.28]
    (matrix,) = palpate.from_arrays([T], frames, pitch_mm=2).matrices
    assert matrix["pitch_mm"] == 2.0
    with pytest.raises(ValueError):
        palpate.from_arrays([T], frames, pitch_mm=(5.28, 0.0))
