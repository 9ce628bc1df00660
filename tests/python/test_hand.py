"""Hands, and profiles of any hand from arrays."""
import json

import numpy as np
import palpate
import pytest


def test_built_in_hands():
    assert {"sdh2", "flat_pad_16x16", "parallel_gripper", "four_fingers", "sole"} <= set(palpate.hands())
    hand = palpate.Hand("sdh2")
    assert [matrix["taxels"] for matrix in hand.matrices] == [84, 68] * 3
    assert len(hand.axes) == 7 and hand.axes[0]["unit"] == "deg"
    assert len(hand.temperature_sensors) == 9
    assert (hand.full_scale, hand.unit) == (4095, "counts")
    assert hand.has_geometry and hand.pinches
    assert not palpate.Hand("flat_pad_16x16").pinches
    assert palpate.Hand(hand).name == hand.name
    assert palpate.Hand("parallel_gripper").axes[0]["unit"] == "mm"


def test_wrong_hands(tmp_path):
    with pytest.raises(palpate.Error, match="flat_pad_16x16"):
        palpate.Hand("octopus")
    with pytest.raises(TypeError):
        palpate.Hand(3)
    (tmp_path / "hand.json").write_text(json.dumps({"format": "palpate-hand", "version": 1,
        "name": "x", "full_scale": 10, "matrices": [{"name": "a", "rows": 0, "columns": 1, "pitch_mm": 1}]}))
    with pytest.raises(ValueError, match="rows is 0"):
        palpate.Hand(tmp_path)


def test_record_a_pad_and_read_it_again(tmp_path):
    rng = np.random.default_rng(3)
    frames = rng.integers(0, 1024, (50, 16, 16))
    profile = palpate.record(frames, "flat_pad_16x16", rate=100)
    profile.save(tmp_path / "pad.palpate")
    again = palpate.load(tmp_path / "pad.palpate")
    np.testing.assert_array_equal(again.matrix(0), frames)
    assert again.hand == palpate.Hand("flat_pad_16x16").name
    assert list(again.time_ms[:3]) == [0, 10, 20]
    flat = palpate.record(frames.reshape(50, 256), palpate.Hand("flat_pad_16x16"), rate=100)
    np.testing.assert_array_equal(flat.matrix(0), frames)


def test_record_taxels_of_a_masked_hand_and_angles():
    sole = palpate.Hand("sole")
    taxels = sum(matrix["taxels"] for matrix in sole.matrices)
    places = sum(matrix["rows"] * matrix["columns"] for matrix in sole.matrices)
    assert taxels < places
    profile = palpate.record(np.ones((4, taxels)), sole, time_ms=[5, 6, 8, 9])
    assert sum(profile.matrix(m).sum() for m in range(len(sole.matrices))) == 4 * taxels
    gripper = palpate.Hand("parallel_gripper")
    parts = [np.zeros((3, matrix["rows"], matrix["columns"])) for matrix in gripper.matrices]
    grip = palpate.record(parts, gripper, rate=30, angles=[[1.0], [2.0], [3.0]])
    assert grip.angles.shape == (3, 1)


@pytest.mark.parametrize("change, message", [
    (dict(frames=np.zeros((3, 255))), "255 values"),
    (dict(frames=np.full((3, 256), -1.0)), "frames\\[0\\]: value 1 is -1"),
    (dict(frames=np.full((3, 256), np.nan)), "frames\\[0\\]"),
    (dict(frames=np.zeros(256)), "shape"),
    (dict(rate=0.0), "rate"),
    (dict(rate=None), "time_ms or rate"),
    (dict(time_ms=[1, 2, 3]), "time_ms or rate"),
    (dict(rate=None, time_ms=[1, 2]), "2 times"),
    (dict(rate=None, time_ms=[3, 2, 1]), "later"),
    (dict(angles=np.zeros((3, 2))), "angles"),
])
def test_what_does_not_fit_is_refused(change, message):
    arguments = dict(frames=np.zeros((3, 256)), hand="flat_pad_16x16", rate=100.0)
    arguments.update(change)
    with pytest.raises((ValueError, palpate.Error), match=message):
        palpate.record(**arguments)


def test_kinematics_of_another_hand():
    gripper = palpate.Hand("parallel_gripper")
    places = sum(matrix["rows"] * matrix["columns"] for matrix in gripper.matrices)
    closed, opened = (palpate.kinematics([mm], hand=gripper)["position_mm"] for mm in (0.0, 20.0))
    assert closed.shape == (places, 3)
    moved = np.linalg.norm(opened - closed, axis=1)
    assert moved.max() > 1.0
    with pytest.raises(ValueError):
        palpate.kinematics([1e6], hand=gripper)


def test_statistics_of_a_hand_without_pinch():
    frames = np.zeros((60, 16, 16))
    frames[10:50, 4:7, 8:10] = 300
    profile = palpate.record(frames, "flat_pad_16x16", rate=30)
    assert not palpate.features(profile).names and palpate.features(profile).troubles
    table = palpate.features(profile, "statistics")
    assert list(table.begin) == [10] and list(table.end) == [49]
    assert table.names == palpate.feature_names("statistics", "flat_pad_16x16")
