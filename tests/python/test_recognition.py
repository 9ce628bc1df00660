"""Grasps, features, moments and models against golden numbers and known truth."""
import copy
import json
import multiprocessing
import pickle

import numpy as np
import palpate
import pytest
from conftest import rows_of


def classes_of(model):
    return model.classes


def test_golden_features(golden, recordings):
    rows = rows_of(golden / "grasp_features.csv")
    names = list(rows[0])[8:]
    assert palpate.feature_names("study") == names
    for row in rows[::10]:
        profile = palpate.load(recordings / row["file"])
        found = palpate.study_features(profile, int(row["grasp_begin"]), int(row["grasp_end"]),
                                       end_frame=int(row["end_frame"]))
        assert found["trouble"] == "" and found["initial_frame"] == int(row["initial_frame"])
        np.testing.assert_allclose(found["values"], [float(row[name]) for name in names],
                                   rtol=1e-6, atol=1e-7, err_msg=row["file"])


def test_folders_are_classes(golden, recordings):
    folder = recordings / "grasps_by_class"
    found = palpate.features([folder / "golf_ball", folder / "hammer"], "study")
    assert set(found.classes) == {"golf ball", "hammer"} and found.values.shape == (len(found), 54)
    rows = {row["file"]: row for row in rows_of(golden / "grasp_features.csv")}
    for file, begin, end, frame in zip(found.files, found.begin, found.end, found.end_frame):
        row = rows[file[len(str(recordings)) + 1:]]
        assert (begin, end) == (int(row["grasp_begin"]), int(row["grasp_end"]))
        assert str(frame) in row["end_frame_tie"].split(";")
    single = palpate.features(palpate.load(found.files[0]), "study")
    np.testing.assert_array_equal(single.values[0], found.values[0])
    assert single.classes == [""] and single.time_ms[0] == found.time_ms[0]


def test_study_figures(recordings):
    features = palpate.features(recordings / "grasps_by_class", "study")
    # 571 of the study's 856 grasps: 0.734, 0.872, 0.711, 0.903, 0.976 there
    for name, lda, expected in (("diameter", None, 0.73), ("first4", None, 0.88), ("moments", None, 0.71),
                                ("study", None, 0.90), ("study", 14, 0.97)):
        report = palpate.evaluate(features, set=name, lda=lda)
        assert report["accuracy_mean"] == pytest.approx(expected, abs=0.04), (name, lda)
        assert report["accuracy_mean"] == pytest.approx(report["accuracies"].mean())
        confusion = report["confusion"]
        assert confusion.shape == (36, len(report["confusion_labels"]))
        assert np.trace(confusion[:, :36]) / confusion.sum() == pytest.approx(
            report["accuracy_mean"], abs=1e-9)


@pytest.fixture(scope="module")
def emulated(tmp_path_factory):
    """Two objects, two days: a folder per day, a folder per object; on the second day the joints' zeros are off."""
    root = tmp_path_factory.mktemp("emulated")
    for day, zeros in (("one", []), ("two", [0, 0, 0, 0.5, 0.5, 0, 0])):
        for scene in ("ball", "foam_ball"):
            folder = root / day / scene
            folder.mkdir(parents=True)
            palpate.emulate(pinch_of(scene), grasps=10, duration=8, zero_error_deg=zeros).save(
                folder / "0.palpate")
    return root


def pinch_of(scene):
    size, stiffness = {"ball": (66, 10.0), "foam_ball": (50, 0.1)}[scene]
    return {
        "objects": [{"shape": "sphere", "size_mm": size, "stiffness_n_per_mm3": stiffness,
                     "pose": {"position_mm": [0, 0, 145], "rotation_deg": [0, 0, 0]}}],
        "hand": {"preshape": "pinch-parallel", "close": 0.0},
        "script": [{"at_s": 1, "grasp": {"close": 1, "velocity_deg_per_s": 30}},
                   {"at_s": 5, "release": {"velocity_deg_per_s": 30}}],
    }


def test_models(emulated, tmp_path):
    model = palpate.train(emulated / "one")
    assert model.classes == ["ball", "foam ball"] and model.classifier == "gauss" and model.carries_over
    assert model.validation["accuracy_mean"] > 0.8 and len(model.inputs) == 2
    model.save(tmp_path / "m.json")
    with pytest.raises(OSError):
        model.save(tmp_path / "m.json")
    model = palpate.Model.load(tmp_path / "m.json")
    report = model.evaluate(emulated / "two")
    assert report["accuracy"] > 0.7 and report["grasps"] >= 8
    profile = palpate.load(emulated / "two" / "ball" / "0.palpate")
    found = model.classify(profile)
    assert found["grasps"] and found["grasps"][0]["label"] == "ball"
    assert [one["p"] for one in found["grasps"][0]["top"]] == sorted(
        (one["p"] for one in found["grasps"][0]["top"]), reverse=True)
    assert model.classify(profile, session_offset=0.5)["session_offset"]["mm"] == 0.5
    assert model.classify(profile, session_offset="batch")["session_offset"]["origin"] == "batch"
    with pytest.raises(ValueError):
        model.classify(profile, session_offset="today")
    again = pickle.loads(pickle.dumps(model))
    assert again.classify(profile)["grasps"][0]["top"] == found["grasps"][0]["top"]
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.map(classes_of, [model]) == [model.classes]
    assert copy.copy(model) is model and copy.deepcopy(model) is model
    adapted = model.adapt(emulated / "two")
    adapted.save(tmp_path / "a.json")
    pickle.loads(pickle.dumps(adapted)).save(tmp_path / "b.json")
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()
    for state in ((b"nonsense",), (b"{}",), (b"", 1)):
        with pytest.raises((ValueError, TypeError)):
            palpate.Model.__new__(palpate.Model).__setstate__(state)
    assert adapted.session_offset["origin"] == "references" and adapted.session_offset["grasps"] >= 8
    assert model.session_offset["origin"] == "none"  # the old one is as it was
    table = palpate.features(emulated / "one")
    again = palpate.train(table)
    assert again.classify(profile)["grasps"][0]["top"][0]["p"] == pytest.approx(
        found["grasps"][0]["top"][0]["p"])
    svm = palpate.train(emulated / "one", set="study", classifier="svm", lda=1)
    assert svm.classifier == "svm" and not svm.carries_over
    with pytest.raises(palpate.Error):
        svm.adapt(emulated / "two")
    with pytest.raises(palpate.Error, match="set"):
        palpate.train(table, set="study")
    other = palpate.from_arrays(30 * np.arange(5), [np.ones((5, 4, 4))])
    assert model.classify(other)["grasps"] == [] and model.classify(other)["warnings"]


def test_nothing_to_learn_is_said(tmp_path):
    with pytest.raises(OSError):
        palpate.train(tmp_path / "missing")
    with pytest.raises(palpate.Error):
        palpate.train(tmp_path)
    with pytest.raises(ValueError):
        palpate.evaluate(tmp_path, set="all")
    with pytest.raises(ValueError, match="lda"):
        palpate.train(tmp_path, classifier="gauss", lda=3)
    with pytest.raises(ValueError):
        palpate.train(tmp_path, shrinkage=2)
    for content in ("", "{}", '{"format": "palpate-model"}'):
        (tmp_path / "m.json").write_text(content)
        with pytest.raises(ValueError):
            palpate.Model.load(tmp_path / "m.json")


def test_grasps_are_found():
    profile, truth = palpate.synthesize(grasps=3)
    found = palpate.grasps(profile)
    # both fingers touch but for a frame at either end
    assert all(0 <= begin - true <= 1 for begin, true in zip(found["begin"], [b for b, _ in truth]))
    assert all(0 <= true - end <= 1 for end, true in zip(found["end"], [e for _, e in truth]))
    assert found["fingers"] == [(0, 2)] * 3 and (found["quality"] > 0.3).all()
    assert len(palpate.grasps(profile, rule="study")["begin"]) == 3
    np.testing.assert_array_equal(found["begin_ms"], profile.time_ms[found["begin"]])


def test_golden_moments(golden):
    for one in json.loads((golden / "chebyshev.json").read_text()):
        pad = one["pad"]
        picture = palpate.in_square(one["frame"], one["N"], above=pad["top"], left=pad["left"])
        np.testing.assert_allclose(palpate.chebyshev_moments(picture, 8), one["T"], atol=1e-8)
        found = palpate.chebyshev_invariants(picture, 4)
        if found["empty"] or not found["angle_determined"]:
            continue
        np.testing.assert_allclose(found["centroid"], one["centroid"], atol=1e-8)
        assert found["angle_rad"] == pytest.approx(one["theta"], abs=1e-7)
        np.testing.assert_allclose(found["moments"], one["T_rotation_translation"], rtol=2e-5, atol=1e-6)
    picture = np.random.default_rng(1).random((14, 14))
    back = palpate.chebyshev_picture(palpate.chebyshev_moments(picture, 13), 14)
    np.testing.assert_allclose(back, picture, atol=1e-9)
    assert palpate.picture_error(picture, back) < 1e-9 < palpate.picture_error(picture, back * 0.9)


def test_emulated_hands_are_repeatable():
    assert {"ball", "empty", "slipping_handle"} <= set(palpate.scenes())
    a, b = (palpate.emulate("ball", duration=8, seed=4) for _ in range(2))
    np.testing.assert_array_equal(a.frames(), b.frames())
    assert a.frames().max() > 0 and palpate.emulate("empty", duration=2).frames().max() == 0
    with pytest.raises(OSError):
        palpate.emulate("no_such_scene")
    with pytest.raises(ValueError):
        palpate.emulate({"objects": [{"shape": "teapot"}]})
    with pytest.raises(ValueError):
        palpate.emulate("ball", duration=-1)
    with pytest.raises(TypeError):
        palpate.emulate(3)


def test_noisy_contacts_and_their_truth():
    made = palpate.noisy_contacts(frames=400, seed=2)
    frames = made["profile"].frames()
    assert made["touched"].shape == made["nothing"].shape == frames.shape
    assert not (made["touched"] & made["nothing"]).any()
    assert (frames[made["touched"]] > 0).mean() > 0.9 > 0.1 > (frames[made["nothing"]] > 0).mean()
