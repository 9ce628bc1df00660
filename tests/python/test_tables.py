"""to_pandas() and to_xarray() against the NumPy arrays of the same recording."""
import copy
import pickle
import sys

import numpy as np
import palpate
import pytest

pandas = pytest.importorskip("pandas")
xarray = pytest.importorskip("xarray")

T_US = 1_400_000_000_123_000


def sample(hand="sdh2"):
    rng = np.random.default_rng(5)
    places = sum(m["rows"] * m["columns"] for m in palpate.Hand(hand).matrices)
    frames = rng.integers(1, 1000, (12, places))
    axes = len(palpate.Hand(hand).axes)
    return palpate.record(frames, hand, time_ms=T_US // 1000 + 30 * np.arange(12), serial="S1",
                          angles=rng.normal(0, 9, (12, axes)) if axes else None)


def same_instants(index, time_us):
    np.testing.assert_array_equal(np.asarray(index).astype("datetime64[us]").astype("int64"), time_us)


def test_a_recording_as_a_frame_has_a_column_per_taxel():
    profile = sample()
    frame = profile.to_pandas()
    same_instants(frame.index, profile.time_us)
    assert frame.index.name == "time" and frame.columns.names == ["matrix", "y", "x"]
    assert frame.shape == (12, 456)
    for m, matrix in enumerate(profile.matrices):
        for y, x in ((0, 2), (matrix["rows"] - 1, 5)):
            np.testing.assert_array_equal(frame[(matrix["name"], y, x)], profile.taxel(m, x, y))
    assert ("finger 0 distal", 0, 0) not in frame.columns  # no taxel is there
    assert frame.attrs == {"units": "counts", "hand": profile.hand, "serial": "S1"}


def test_a_matrix_is_an_array_over_time_and_mm():
    profile = sample()
    array = profile.to_xarray(1)
    assert array.dims == ("time", "y", "x") and array.name == "finger 0 distal"
    same_instants(array.time, profile.time_us)
    np.testing.assert_allclose(array.x, 3.4 * np.arange(6))
    np.testing.assert_allclose(array.y, 3.4 * np.arange(13))
    assert array.x.attrs["units"] == array.y.attrs["units"] == "mm"
    mask = profile.matrices[1]["static_mask"]
    np.testing.assert_array_equal(array.values[:, mask], profile.matrix(1)[:, mask])
    assert np.isnan(array.values[:, ~mask]).all() and (~mask).sum() == 10
    assert array.attrs["units"] == "counts" and array.attrs["hand"] == profile.hand
    near = array.sel(x=7.0, y=10.0, method="nearest")
    np.testing.assert_array_equal(near, profile.taxel(1, 2, 3))
    with pytest.raises(IndexError, match="matrix 6 is not in 0..5"):
        profile.to_xarray(6)


def test_all_series_of_a_recording():
    profile = sample()
    arrays = profile.to_xarray()
    assert list(arrays) == [m["name"] for m in profile.matrices] + ["angles"]
    angles = arrays["angles"]
    assert angles.dims == ("time", "axis") and list(angles.axis.values) == profile.axes
    np.testing.assert_array_equal(angles, profile.angles)
    assert angles.attrs["units"] == "deg"
    gripper = palpate.Hand("parallel_gripper")  # arrays A9: its axis slides
    parts = [np.zeros((2, matrix["rows"], matrix["columns"])) for matrix in gripper.matrices]
    grip = palpate.record(parts, gripper, rate=30, angles=[[1.0], [2.0]])
    assert grip.to_xarray()["angles"].attrs["units"] == "mm"
    pad = sample("flat_pad_16x16").to_xarray()
    assert len(pad) == 1 and "angles" not in pad


def test_signals_have_a_column_per_matrix_and_units():
    profile = sample()
    table = palpate.signals(profile)
    frame = palpate.to_pandas(table)
    same_instants(frame.index, 1000 * table["time_ms"])
    for name, values in palpate.flat(table).items():
        np.testing.assert_array_equal(frame[name], values)
    assert frame.attrs["units"]["mean_3"] == "counts"
    assert frame.attrs["units"]["area_mm2_0"] == "mm^2"
    assert frame.attrs["units"]["active_0"] == "taxels"
    assert palpate.to_pandas(table, unit="kPa").attrs["units"]["mean_3"] == "kPa"
    data = palpate.to_xarray(table)
    assert data["mean"].dims == ("time", "matrix") and data["mean"].attrs["units"] == "counts"
    np.testing.assert_array_equal(data["mean"], table["mean"])
    same_instants(data.time, 1000 * table["time_ms"])
    assert palpate.to_xarray(palpate.signals(profile, 0))["sum"].dims == ("time",)


def test_slip_contact_and_grasps():
    profile = palpate.synthesize(duration=4, grasps=1)[0]
    slip = palpate.slip(profile, 1)
    frame = palpate.to_pandas(slip)
    np.testing.assert_array_equal(frame["dx"], slip["dx"])
    assert list(frame["state"]) == list(slip["state"])
    assert frame.attrs["units"]["dx"] == "taxels" and frame.attrs["units"]["rotation_deg"] == "deg"
    contact = palpate.contact(profile, angles_deg=np.zeros(7))
    data = palpate.to_xarray(contact)
    assert data["centroid_mm"].dims == ("time", "matrix", "axis")
    assert data["sphere_mm"].dims == ("time", "axis") and data["sphere_mm"].attrs["units"] == "mm"
    np.testing.assert_array_equal(data["centroid_mm"].sel(axis="z"), contact["centroid_mm"][..., 2])
    np.testing.assert_array_equal(palpate.to_pandas(contact)["centroid_mm_1_z"],
                                  contact["centroid_mm"][:, 1, 2])
    grasps = palpate.grasps(profile)
    table = palpate.to_pandas(grasps)
    same_instants(table.index, 1000 * grasps["begin_ms"])
    assert list(table["fingers"]) == grasps["fingers"] and len(table) == 1
    assert "fingers" not in palpate.to_xarray(grasps)


def test_a_table_is_a_dict_with_units_and_meanings():
    profile = sample()
    for table in (palpate.signals(profile), palpate.signals(profile, "hand"), palpate.slip(profile),
                  palpate.slip_segments(profile), palpate.grasps(profile),
                  palpate.contact(profile, angles_deg=np.zeros(7)), palpate.compare(profile, profile, align="start")):
        assert isinstance(table, palpate.Table) and isinstance(table, dict)
        assert set(table.meanings) == set(table) and all(table.meanings.values())
        assert set(table.units) <= set(table) and all(table.units.values())
        assert {table.units[name] for name in table if name.endswith("_mm")} <= {"mm"}
        assert {table.units[name] for name in table if name.endswith("_ms")} <= {"ms"}
        pandas.testing.assert_frame_equal(table.to_pandas(), palpate.to_pandas(table))
        assert table.to_xarray().identical(palpate.to_xarray(table))
        for same in (copy.copy(table), pickle.loads(pickle.dumps(table))):
            assert type(same) is palpate.Table and list(same) == list(table)
            assert (same.units, same.meanings, same.notes) == (table.units, table.meanings, table.notes)
        flat = palpate.flat({name: values for name, values in table.items() if name != "fingers"})
        assert type(flat) is palpate.Table
    assert palpate.flat(palpate.signals(profile)).units["area_mm2_5"] == "mm^2"
    places = palpate.kinematics(np.zeros(7))
    assert places.units == {"x": "taxels", "y": "taxels", "position_mm": "mm"}
    assert palpate.surface_points(np.zeros(7), [[0, 1, 2]]).units == {"position_mm": "mm"}
    assert palpate.to_pandas(dict(palpate.signals(profile))).attrs["units"] == {}


def test_the_shapes_and_types_of_tables():
    profile = sample()
    signals = palpate.signals(profile)
    assert list(signals) == ["time_ms", "mean", "filtered_mean", "min", "max", "sum", "active", "area_mm2"]
    assert signals["time_ms"].shape == (12,) and signals["active"].shape == (12, 6)
    assert {name: values.dtype.kind for name, values in signals.items() if values.dtype.kind != "f"} == {
        "time_ms": "i", "active": "i"}
    masks = [matrix["static_mask"] for matrix in profile.matrices]
    np.testing.assert_array_equal(signals["sum"], np.transpose(
        [profile.matrix(m).astype(float)[:, mask].sum(axis=1) for m, mask in enumerate(masks)]))
    hand = palpate.signals(profile, "hand")
    np.testing.assert_array_equal(hand["sum"], signals["sum"].sum(axis=1))
    np.testing.assert_array_equal(palpate.signals(profile, -1)["max"], signals["max"][:, 5])
    slip = palpate.slip(profile)
    assert list(slip)[:8] == ["frame", "time_ms", "matrix", "active", "x", "y", "valid", "dx"]
    assert slip["valid"].dtype == bool and slip["matrix"].dtype == np.int64
    assert slip["state"].dtype == palpate.slip(palpate.from_arrays([], np.zeros((0, 486))))["state"].dtype
    contact = palpate.contact(profile, angles_deg=np.zeros(7))
    assert contact["sphere_mm"].shape == (12, 3) and contact["normal"].shape == (12, 6, 3)
    assert contact["matrix_active"].dtype == np.int64
    np.testing.assert_array_equal(contact["sum"], signals["sum"])
    features = palpate.features(palpate.synthesize(grasps=2)[0])
    np.testing.assert_array_equal(features.table["begin"], features.begin)
    np.testing.assert_array_equal(np.transpose([features.table[name] for name in features.names]),
                                  features.values)


def test_a_notebook_shows_the_ends_of_a_table():
    table = palpate.Table({"n": np.arange(12), "pitch_mm": np.full(12, 3.4), "text": np.array(["<b>"] * 12)},
                          {"pitch_mm": "mm"}, notes=["a & b"])
    page = table._repr_html_()
    rows = page.split("<tr>")[1:]
    assert len(rows) == 2 + 5 + 1 + 5
    assert "<th>mm</th>" in rows[1] and "<td>3.4</td>" in rows[2] and "<td>11</td>" in rows[-1]
    assert "<b>" not in page and "&lt;b&gt;" in page and "a &amp; b" in page and "12 rows" in page
    assert palpate.Table({"n": np.arange(3)})._repr_html_().count("<tr>") == 2 + 3
    assert "<pre>" in palpate.Table({"a": 3})._repr_html_()
    assert "0 rows" in palpate.Table()._repr_html_()


def test_what_is_no_table():
    with pytest.raises(ValueError, match="isn't a table"):
        palpate.to_pandas({"a": np.arange(3), "text": "report"})
    with pytest.raises(ValueError, match="rows"):
        palpate.to_xarray({"a": np.arange(3), "b": np.arange(4)})
    data = palpate.to_xarray({"a": np.arange(3)})
    assert data["a"].dims == ("row",)


@pytest.mark.parametrize("package, calls", [
    ("pandas", [lambda: palpate.to_pandas({"a": np.arange(3)}), lambda: sample().to_pandas()]),
    ("xarray", [lambda: palpate.to_xarray({"a": np.arange(3)}), lambda: sample().to_xarray()])])
def test_without_the_package_the_error_names_it(monkeypatch, package, calls):
    monkeypatch.setitem(sys.modules, package, None)
    for call in calls:
        with pytest.raises(ImportError, match=f"needs {package}, .* install python3-{package}"):
            call()
