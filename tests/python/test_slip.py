"""Slip against NumPy's centroids, golden numbers and known motion."""
import numpy as np
import palpate
import pytest
from conftest import rows_of


def centroids(frames):
    total = frames.sum(axis=(1, 2))
    y, x = np.mgrid[:frames.shape[1], :frames.shape[2]]
    return (frames * x).sum(axis=(1, 2)) / total, (frames * y).sum(axis=(1, 2)) / total


def moving(count=40, shape="bar"):
    x, y = np.linspace(1.9, 3.1, count), np.linspace(5, 8, count)
    frames = palpate.synthetic_contact(x, y, np.zeros(count), shape=shape, noise=0)
    return x, y, palpate.from_arrays(32 * np.arange(count), [frames]), frames


def test_centroids_are_numpys():
    _, _, profile, frames = moving()
    found = palpate.slip(profile, 0, method="centroid")
    x, y = centroids(frames.astype(float))
    np.testing.assert_allclose(found["x"], x, atol=1e-9)
    np.testing.assert_allclose(found["dx"][1:], np.diff(x), atol=1e-9)
    np.testing.assert_allclose(found["dy"][1:], np.diff(y), atol=1e-9)
    np.testing.assert_allclose(found["ref_dx"][1:], (x - x[0])[1:], atol=1e-9)
    assert not found["valid"][0] and np.isnan(found["dx"][0])
    late = palpate.slip(profile, 0, method="centroid", reference=10)
    np.testing.assert_allclose(late["ref_dy"][11:], (y - y[10])[11:], atol=1e-9)


@pytest.mark.parametrize("method", ["centroid", "alcazar", "ncc-paraboloid", "ncc-gauss3", "phase",
                                    "register", "contest"])
def test_every_method_sees_where_it_goes(method):
    x, y, profile, _ = moving()
    found = palpate.slip(profile, 0, method=method)
    path_x, path_y = np.nansum(found["dx"]), np.nansum(found["dy"])
    assert path_x == pytest.approx(x[-1] - x[0], abs=0.4), method
    assert path_y == pytest.approx(y[-1] - y[0], abs=0.5), method
    assert set(found["state"]) <= {"still", "loading", "load_shift", "ambiguous", "slip", "invalid"}


def test_motion_is_slip_and_rest_is_not():
    _, _, profile, frames = moving()
    assert palpate.slip(profile)["slipping"].any()
    segments = palpate.slip_segments(profile, 0)
    assert len(segments["begin"]) == 1 and segments["path_taxels"][0] > 1
    rest = palpate.from_arrays(32 * np.arange(40), [np.repeat(frames[:1], 40, axis=0)])
    assert not palpate.slip(rest)["slipping"].any()
    assert len(palpate.slip_segments(rest)["begin"]) == 0
    table = palpate.slip(palpate.from_arrays([0, 30], [np.zeros((2, 14, 6))]))
    assert all(len(column) == 0 for column in table.values())


def test_golden_recordings(golden, recordings):
    rows = rows_of(golden / "slip.csv")
    for file in sorted({row["file"] for row in rows}):
        if not (recordings / file).is_file():
            continue
        found = palpate.slip(palpate.load(recordings / file), method="centroid")
        at = {key: i for i, key in enumerate(zip(found["frame"], found["matrix"]))}
        seen = 0
        for row in rows:
            if row["file"] != file or row["ok_rotation"] != "1":
                continue
            i = at[int(row["frame"]), int(row["matrix"])]
            assert found["active"][i] == int(row["active"])
            assert found["x"][i] == pytest.approx(float(row["centroid_x"]), abs=1e-6)
            assert found["y"][i] == pytest.approx(float(row["centroid_y"]), abs=1e-6)
            seen += 1
        assert seen > 100


def test_moments_of_known_shapes():
    line = np.zeros((5, 7))
    line[2, 1:6] = 10
    found = palpate.contact_moments(line)
    assert (found["x"], found["y"], found["active"], found["sum"]) == (3, 2, 5, 50)
    assert found["mu20"] == pytest.approx(2) and found["eccentricity"] == pytest.approx(1)
    assert found["orientation_deg"] == pytest.approx(0) and found["sd"] == 0 and found["roundness"] == 0
    assert palpate.contact_moments(line.T)["orientation_deg"] == pytest.approx(90)
    ramp = np.zeros((4, 4))
    ramp[1, :3] = [1, 2, 6]
    assert palpate.contact_moments(ramp)["sd"] == pytest.approx(np.std([1, 2, 6]))
    assert palpate.contact_moments(np.zeros((3, 3)))["active"] == 0


def test_benchmark():
    methods = palpate.slip_benchmark(trials=1, shapes=["disc"], seed=3)
    assert {"register", "contest", "centroid"} <= set(methods)
    one = methods["register"]
    assert one["crb"] < one["rmse"] < 0.1 and one["gain_x"] == pytest.approx(1, abs=0.1)
    with pytest.raises(ValueError, match="disc"):
        palpate.slip_benchmark(shapes=["disk"])
