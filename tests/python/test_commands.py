"""What the commands compare, labels, convert and render do, as functions."""
import numpy as np
import palpate
import pytest

T_MS = 1_400_000_000_000


def recording_of(frames, offset_ms=0):
    """A frame every 30 ms."""
    return palpate.from_arrays(T_MS + offset_ms + 30 * np.arange(len(frames)), [frames])


def test_compare_is_numpys():
    rng = np.random.default_rng(3)
    a, b = rng.integers(0, 3, (20, 4, 5)), rng.integers(0, 3, (20, 4, 5))
    a[:, 0, 0] = 1
    found = palpate.compare(recording_of(a), recording_of(b, 60), align="clock")
    np.testing.assert_array_equal(found["frame_a"], np.arange(2, 20))
    np.testing.assert_array_equal(found["frame_b"], np.arange(18))
    np.testing.assert_allclose(found["time_s"], 0.03 * np.arange(2, 20))
    for i in range(18):
        one, other = a[i + 2].astype(float), b[i].astype(float)
        touched = (one > 0) | (other > 0)
        difference = (one - other)[touched]
        assert found["mean_a"][i] == pytest.approx(one[one > 0].mean())
        assert found["difference_mean"][i] == pytest.approx(difference.mean())
        assert found["difference_rms"][i] == pytest.approx(np.sqrt((difference**2).mean()))
    assert found.units["time_s"] == "s" and found.units["mean_a"] == "counts"
    late = palpate.compare(recording_of(a), recording_of(b), offset=0.3)
    assert late["frame_a"][0] == 10 and late["frame_b"][0] == 0


def test_compare_says_why_not(tmp_path):
    still = recording_of(np.zeros((20, 4, 5)))
    with pytest.raises(palpate.Error, match="align='start'"):
        palpate.compare(still, still)
    with pytest.raises(ValueError, match="align is 'grasp'"):
        palpate.compare(still, still, align="grasp")
    with pytest.raises(ValueError, match="offset"):
        palpate.compare(still, still, offset=float("nan"))
    with pytest.raises(OSError):
        palpate.compare(still, tmp_path / "none.dsa")
    with pytest.raises(TypeError):
        palpate.compare(still, 3)
    assert any("no moment in common" in note for note in palpate.compare(still, still, offset=100).notes)
    still.save(tmp_path / "a.palpate")
    assert len(palpate.compare(still, tmp_path / "a.palpate", align="start")["time_s"]) == 20


def test_compare_notes_what_was_lost():
    whole = recording_of(np.ones((20, 4, 5)))
    recording, form, _ = whole.__getstate__()
    damaged = palpate.Profile.__new__(palpate.Profile)
    damaged.__setstate__((recording, form, ["lost: 2 frames of 22"]))
    assert palpate.compare(whole, whole, align="start").notes == []
    assert palpate.compare(whole, damaged, align="start").notes == ["b: 2 frames of 22"]


def test_labels_are_those_of_the_recording(tmp_path):
    profile = recording_of(np.ones((20, 4, 5)))
    us = T_MS * 1000
    profile.save(tmp_path / "a.palpate", events=[
        {"t_us": us + 250_000, "t1_us": us + 500_000, "kind": "label", "text": "ball"},
        {"t_us": us + 100_000, "kind": "mark", "text": "here", "matrix": 0},
        {"t_us": us, "kind": "settings", "text": "not a label"}])
    found = palpate.labels(tmp_path / "a.palpate")
    np.testing.assert_allclose(found["begin_s"], [0.1, 0.25])
    np.testing.assert_allclose(found["end_s"], [0.1, 0.5])
    assert list(found["kind"]) == ["mark", "label"] and list(found["text"]) == ["here", "ball"]
    assert found["matrix"][0] == 0 and np.isnan(found["matrix"][1])
    profile.save(tmp_path / "b.palpate")
    assert [len(column) for column in palpate.labels(tmp_path / "b.palpate").values()] == [0] * 5
    with pytest.raises(OSError):
        palpate.labels(tmp_path / "none.palpate")


def test_convert_writes_what_is_in_a_recording(tmp_path):
    frames = np.random.default_rng(1).integers(1, 1000, (20, 4, 5))
    source = tmp_path / "a.palpate"
    recording_of(frames).save(source)
    report = palpate.convert(source, tmp_path / "a.npz")
    assert report["state"] == "whole" and report["message"].startswith("20 frames")
    with np.load(tmp_path / "a.npz") as arrays:
        np.testing.assert_array_equal(arrays["m0"], frames)
        np.testing.assert_array_equal(arrays["time_ms"], T_MS + 30 * np.arange(20))
    palpate.convert(source, tmp_path / "filtered.npz", "median", ["gaussian"])
    with np.load(tmp_path / "filtered.npz") as arrays:
        np.testing.assert_array_equal(arrays["m0"],
                                      palpate.filter(palpate.load(source), "median", "gaussian").matrix(0))
    palpate.convert(source, tmp_path / "a.csv", units_row=True)
    with pytest.raises(OSError, match="force=True|exists"):
        palpate.convert(source, tmp_path / "a.npz")
    palpate.convert(source, tmp_path / "a.npz", force=True)
    for wrong in (dict(units_row=True), dict(compression="zip"), dict(images="ros")):
        with pytest.raises(ValueError):
            palpate.convert(source, tmp_path / "b.npz", **wrong)
    for out in (source, tmp_path / "a.what", tmp_path / "no" / "b.npz"):
        with pytest.raises(OSError):
            palpate.convert(source, out, force=True)
    assert not (tmp_path / "b.npz").exists()


def test_render_draws_pictures(tmp_path):
    source = tmp_path / "a.palpate"
    palpate.synthesize(duration=4, grasps=1)[0].save(source)
    palpate.render(source, tmp_path / "a.png", frame=3, size="400x400", range=(0, 500), values=True)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    palpate.render(source, tmp_path / "a.svg", width_mm=85, filter=["median", "kalman"])
    assert b"<svg" in (tmp_path / "a.svg").read_bytes()
    with pytest.raises(palpate.Error, match="a.png") as raised:
        palpate.render(source, tmp_path / "a.png")
    assert "\n" not in str(raised.value) and "--" not in str(raised.value)
    palpate.render(source, tmp_path / "a.png", force=True)
    for wrong in (dict(frame=-1), dict(colour="red"), dict(view="left"), dict(range=(5, 1))):
        with pytest.raises(ValueError) as raised:
            palpate.render(source, tmp_path / "b.png", **wrong)
        assert "\n" not in str(raised.value)
    with pytest.raises(palpate.Error, match="frame 99999"):
        palpate.render(source, tmp_path / "b.png", frame=99999)
    assert not (tmp_path / "b.png").exists()


def test_render_says_where_it_looks_for_the_program(tmp_path, monkeypatch):
    monkeypatch.setattr(palpate, "__file__", str(tmp_path / "python" / "palpate.so"))
    with pytest.raises(palpate.Error, match="needs the program palpate, which isn't at"):
        palpate.render("a.dsa", "a.png")
