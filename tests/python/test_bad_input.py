"""Wrong shapes, types and values, damaged files, threads, data that outlives its profile: exceptions, never a crash."""
import gc
import os
import random
import signal
import sys
import threading
import time

import numpy as np
import palpate
import pytest
from conftest import CORPUS

NAN = float("nan")
PROFILE, _ = palpate.synthesize(duration=3, grasps=1)


def empty():
    return palpate.from_arrays(np.zeros(0, dtype=int), np.zeros((0, 486)))


WRONG_VALUES = [
    lambda: PROFILE.matrix(6), lambda: PROFILE.taxel(0, 6, 0), lambda: PROFILE.taxel(0, 0, -15),
    lambda: PROFILE.crop(0, 10_000), lambda: PROFILE.crop(5, 3), lambda: palpate.slip(PROFILE, 6),
    lambda: palpate.slip(PROFILE, 1, "guess"), lambda: palpate.slip(PROFILE, reference=9999),
    lambda: palpate.slip(PROFILE, reference="last"), lambda: palpate.slip(PROFILE, step=-1.0),
    lambda: palpate.slip(PROFILE, limit=NAN), lambda: palpate.filter(PROFILE, "media:size=3"),
    lambda: palpate.filter(PROFILE, "median:size=4"), lambda: palpate.filter(PROFILE, "median:width=3"),
    lambda: palpate.filter(PROFILE, "median:matrices=9").frames(), lambda: palpate.filter(PROFILE, "|"),
    lambda: palpate.signals(PROFILE, 6), lambda: palpate.signals(PROFILE, "finger"),
    lambda: palpate.kinematics([1, 2, 3]), lambda: palpate.kinematics(np.zeros((2, 3, 7))),
    lambda: palpate.kinematics([1000] * 7), lambda: palpate.kinematics([[0] * 7, [0, 0, 92, 0, 0, 0, 0]]),
    lambda: palpate.surface_points([1000] * 7, [[0, 0, 0]]), lambda: palpate.kinematics([NAN] * 7), lambda: palpate.kinematics(1.0), lambda: palpate.kinematics(None),
    lambda: palpate.kinematics([0] * 7, fingertip="soft"),
    lambda: palpate.surface_points([0] * 7, [[9, 0, 0]]), lambda: palpate.surface_points([0] * 7, [[0.5, 0, 0]]),
    lambda: palpate.surface_points([0] * 7, [[0, NAN, 0]]), lambda: palpate.surface_points([0] * 7, [0, 0, 0]),
    lambda: palpate.bounding_sphere([[0, 0]]), lambda: palpate.bounding_sphere([[0, 0, NAN]]),
    lambda: palpate.contact(PROFILE, angles_deg=[0, 0]), lambda: palpate.contact(PROFILE, threshold=-1.0),
    lambda: palpate.contact(PROFILE, angles_deg=[NAN] * 7),
    lambda: palpate.object_size(PROFILE, 5, 2), lambda: palpate.object_size(PROFILE, 0, 10_000),
    lambda: palpate.fit_step([0, 1], [0]), lambda: palpate.fit_step([[0, 1]], [[0, 1]]),
    lambda: palpate.fit_step([0, 1], [0, 1], loss="cubes"), lambda: palpate.fit_step([0.], [0.], loss_scale=-1.0),
    lambda: palpate.calibrate_step(PROFILE, 6), lambda: palpate.calibrate_step(PROFILE, 1, signal="median"),
    lambda: palpate.calibrate_step(PROFILE, 1, above=-1.0), lambda: palpate.calibrate_noise(PROFILE, bins=1),
    lambda: palpate.calibrate_pressure([("a",)]), lambda: palpate.calibrate_pressure([], choices="mine"),
    lambda: palpate.fit_pressure([1], [1], [1], [1, 2]), lambda: palpate.grasps(PROFILE, rule="mine"),
    lambda: palpate.features(PROFILE, "all"), lambda: palpate.features([]), lambda: palpate.feature_names("x"),
    lambda: palpate.study_features(PROFILE, 0, 99_999), lambda: palpate.study_features(PROFILE, 0, 20, end_frame=60),
    lambda: palpate.chebyshev_moments(np.zeros((3, 4)), 2), lambda: palpate.chebyshev_moments(np.zeros((3, 3)), 3),
    lambda: palpate.chebyshev_moments(np.full((3, 3), NAN), 1), lambda: palpate.chebyshev_moments(np.zeros((0, 0)), 0),
    lambda: palpate.chebyshev_invariants(np.eye(3), -1), lambda: palpate.chebyshev_invariants(np.eye(3), 1, angle="x"),
    lambda: palpate.chebyshev_picture(np.eye(5), 3), lambda: palpate.in_square(np.eye(5), 3),
    lambda: palpate.in_square(np.eye(5), 9, above=-1), lambda: palpate.picture_error(np.eye(2), np.eye(3)),
    lambda: palpate.contact_moments(np.zeros((0, 3))), lambda: palpate.contact_moments(np.zeros(3)),
    lambda: palpate.contact_moments(np.zeros((300, 2))), lambda: palpate.preshape("parallel", NAN),
    lambda: palpate.spectrum([0, 1, 1], [1, 2, 3], window=2), lambda: palpate.spectrum([0, 1], [1]),
    lambda: palpate.spectrum([0, NAN], [1, 2], window=2), lambda: palpate.spectrum([0, 1], [1, 2], window=0),
    lambda: palpate.spectrum([0, 1], [1, 2], overlap=40), lambda: palpate.spectrum([0, 1], [1, 2], detrend="x"),
    lambda: palpate.filter_series([0, 0], [1, 2], "kalman"), lambda: palpate.filter_series([0, 1], [1, NAN], "kalman"),
    lambda: palpate.savitzky_golay(0), lambda: palpate.savitzky_golay(5, 9), lambda: palpate.savitzky_golay(5, position=NAN),
    lambda: palpate.fit_kelvin_voigt([0, 1], [1]), lambda: palpate.fit_kelvin_voigt([0, 1], [1, 2], m=-1.0),
    lambda: palpate.first_contact(PROFILE, frames=0), lambda: palpate.synthesize(duration=-1),
    lambda: palpate.synthesize(rate=NAN), lambda: palpate.noisy_contacts(frames=0), lambda: palpate.slip_benchmark(trials=0),
    lambda: palpate.synthetic_contact([0], [0], [0], shape="star"), lambda: palpate.synthetic_contact([0], [0, 1], [0]),
    lambda: palpate.synthetic_contact([NAN], [0], [0]), lambda: palpate.synthetic_contact([0], [0], [0], rows=0),
    lambda: palpate.synthetic_contact([0], [0], [0], noise=-1), lambda: palpate.ghosts(PROFILE, "median", above=-1.0),
    lambda: palpate.from_arrays([0], np.zeros((2, 486))), lambda: palpate.from_arrays([0], np.zeros((1, 485))),
    lambda: palpate.from_arrays([[0]], np.zeros((1, 486))), lambda: palpate.from_arrays([1, 1], np.zeros((2, 486))),
    lambda: palpate.from_arrays([2**62], np.zeros((1, 486))), lambda: palpate.from_arrays([0], np.full((1, 486), NAN)),
    lambda: palpate.from_arrays([0], []), lambda: palpate.from_arrays([0], [np.zeros((1, 0, 4))]),
    lambda: palpate.from_arrays([0], [np.zeros((1, 300, 4))]), lambda: palpate.from_arrays([0], [np.zeros((1, 4, 4))], pitch_mm=-1.0),
    lambda: palpate.from_arrays([0], np.zeros((1, 486)), angles=np.zeros((1, 7))),
    lambda: palpate.from_arrays([0], np.zeros((1, 486)), angles=np.zeros((1, 7)), angle_time_ms=[0, 1]),
    lambda: palpate.from_arrays([0], np.zeros((1, 486)), angles=[[NAN] * 7], angle_time_ms=[0]),
    lambda: PROFILE.save("/tmp/x.palpate", events=[{}]), lambda: empty().angles_at_frames(),
    lambda: empty().crop(0, 0), lambda: palpate.contact(empty()),
]
WRONG_TYPES = [
    lambda: palpate.load(3), lambda: palpate.load("a\0b"), lambda: palpate.load(None), lambda: palpate.slip(None), lambda: palpate.slip(PROFILE, "1"),
    lambda: palpate.filter(PROFILE, 3), lambda: palpate.filter(PROFILE, [3]), lambda: palpate.filter("file", "median"),
    lambda: palpate.kinematics("x"), lambda: palpate.fit_step("ab", "cd"),
    lambda: palpate.signals(PROFILE, 1.5), lambda: palpate.features(3), lambda: palpate.features([3]),
    lambda: palpate.calibrate_pressure(3), lambda: palpate.calibrate_pressure([(1, 2)]), lambda: palpate.emulate([1]),
    lambda: palpate.from_arrays([0.5], np.zeros((1, 486))), lambda: palpate.from_arrays([0], "frames"),
    lambda: palpate.from_arrays(["a"], np.zeros((1, 486))), lambda: palpate.Profile(), lambda: palpate.Model(),
    lambda: palpate.Calibration(), lambda: palpate.train(3), lambda: palpate.verify(3),
    lambda: PROFILE.save("/tmp/x.palpate", events=[3]), lambda: palpate.save_noise(object(), "/tmp/x.json"),
    lambda: palpate.slip(PROFILE, 1, "contest", "first"), lambda: palpate.slip(PROFILE, reference=None),
]


@pytest.mark.parametrize("call", range(len(WRONG_VALUES)))
def test_wrong_values(call):
    with pytest.raises((ValueError, IndexError)) as raised:
        WRONG_VALUES[call]()
    assert str(raised.value) and "\n" not in str(raised.value)


@pytest.mark.parametrize("call", range(len(WRONG_TYPES)))
def test_wrong_types(call):
    with pytest.raises(TypeError) as raised:
        WRONG_TYPES[call]()
    assert str(raised.value) and "\n" not in str(raised.value) and "::" not in str(raised.value)


def test_a_wrong_type_is_named():
    with pytest.raises(TypeError, match=r"^slip\(\) doesn't take \(Profile, str, step=int\): see help\(palpate.slip\)$"):
        palpate.slip(PROFILE, "1", step=1)
    with pytest.raises(TypeError, match=r"^Hand\(\) doesn't take \(\)"):
        palpate.Hand()
    with pytest.raises(TypeError, match=r"^Profile.matrix\(\) doesn't take \(str\)"):
        PROFILE.matrix("1")


def test_a_recording_without_frames_is_no_trouble():
    profile = empty()
    assert len(profile) == 0 and profile.frames().shape == (0, 486) and profile.time_s.shape == (0,)
    assert palpate.strongest_taxel(profile) is None and palpate.first_contact(profile) is None
    assert palpate.signals(profile)["mean"].shape == (0, 6) and len(palpate.slip(profile)["dx"]) == 0
    assert len(palpate.grasps(profile)["begin"]) == 0 and len(palpate.features(profile)) == 0
    assert palpate.filter(profile, "median", "kalman").frames().shape == (0, 486)
    assert palpate.info(profile)["frames"] == 0 and profile.frame_at(3) is None
    assert palpate.calibrate_step(profile, 1)["steps"] == []
    assert palpate.calibrate_noise(profile)["matrices"] and palpate.calibrate_tare(profile)
    assert palpate.ghosts(profile, "median")["frames"] == 0


def test_values_that_are_no_numbers_give_no_crash():
    fit = palpate.fit_step([0, 0.1, 0.2, NAN, 0.4] * 10, [NAN] * 50)
    assert not fit["converged"] and fit["dropped"] == 50
    assert palpate.contact_moments(np.full((4, 4), NAN))["active"] == 0
    assert palpate.calibrate_sensitivity([NAN, 1], [1, 2])["valid"] is False
    assert np.isnan(palpate.step_response([NAN], 1, T1=1, T2=2)).all()


def read_all(path):
    """Everything that opens files, on one of them."""
    for use in (lambda: palpate.load(path).frames(), lambda: palpate.verify(path), lambda: palpate.details(path),
                lambda: palpate.events(path), lambda: palpate.meta(path), lambda: palpate.seconds(path),
                lambda: palpate.Model.load(path), lambda: palpate.Calibration.load(path),
                lambda: palpate.read_recipe(path)):
        try:
            use()
        except (ValueError, OSError, palpate.Error) as error:
            assert str(error) and "\n" not in str(error)
    assert palpate.verify(path)["state"] in ("sound", "damaged", "unreadable")


@pytest.mark.parametrize("path", sorted(p for f in ("dsa", "palpate", "recipe") for p in (CORPUS / f).iterdir()),
                         ids=lambda path: f"{path.parent.name}-{path.name}")
def test_odd_and_damaged_files(path, tmp_path):
    read_all(path)
    try:
        state = palpate.recover(path, tmp_path / "out.palpate")["state"]
        assert (state != "nothing") == (tmp_path / "out.palpate").exists()
    except (ValueError, OSError):
        assert not (tmp_path / "out.palpate").exists()


@pytest.mark.parametrize("name", ["palpate/whole.palpate", "dsa/example.bz2", "dsa/example.xml"])
def test_flipped_and_cut_files(name, tmp_path):
    content = (CORPUS / name).read_bytes()
    rng = random.Random(7)
    path = tmp_path / "a"
    for _ in range(25):
        damaged = bytearray(content[:rng.randrange(len(content))] if rng.random() < 0.3 else content)
        for _ in range(rng.randrange(1, 6)):
            if damaged:
                damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
        path.write_bytes(damaged)
        read_all(path)


def test_what_cannot_be_opened(tmp_path):
    for path in (tmp_path, tmp_path / "missing", "", "/dev/null"):
        with pytest.raises((OSError, ValueError)):
            palpate.load(path)
    locked = tmp_path / "no_such_folder" / "a.palpate"
    with pytest.raises(OSError):
        PROFILE.save(locked)


def test_arrays_outlive_their_profile(whole):
    profile = palpate.load(whole)
    expected = [array.copy() for array in (profile.frames(), profile.matrix(1), profile.time_ms, profile.angles)]
    arrays = [profile.frames(), profile.matrix(1), profile.time_ms, profile.angles]
    filtered = palpate.filter(profile, "median")
    part = profile.crop(2, 5)
    del profile
    gc.collect()
    noise = [np.random.default_rng(0).random(10_000) for _ in range(50)]  # over the old memory
    for array, values in zip(arrays, expected):
        np.testing.assert_array_equal(array, values)
        assert array.flags.owndata or array.base is not None
        array[...] = 0  # theirs alone
    np.testing.assert_array_equal(part.frames(), expected[0][2:6])
    assert filtered.frames().shape == expected[0].shape and len(noise) == 50
    with pytest.raises(AttributeError):
        part.time_ms = 3


def test_threads_share_a_profile(whole):
    profile = palpate.load(whole)
    filtered = palpate.filter(profile, "median", "kalman")
    expected, smooth = profile.frames(), filtered.frames()
    wrong = []

    def work(seed):
        rng = random.Random(seed)
        for _ in range(60):
            i = rng.randrange(len(profile))
            if not np.array_equal(profile.frames(i, i + 1)[0], expected[i]):
                wrong.append(("plain", i))
            if not np.allclose(filtered.frames(i, i + 1)[0], smooth[i], rtol=1e-5, atol=1e-3):
                wrong.append(("filtered", i))
            palpate.slip(profile, 1)
            profile.matrices, profile.angles_at_frames()

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_long_work_lets_other_threads_go_on():
    began, done, turns = threading.Event(), threading.Event(), 0

    def work():
        began.set()
        palpate.slip_benchmark(trials=3)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    began.wait()
    while not done.is_set():
        turns += 1
        time.sleep(0.001)
    thread.join()
    assert turns > 10


def test_loading_lets_other_threads_go_on(tmp_path):
    """With this interval Python takes its lock from no thread: only a thread that gives it back lets others go on."""
    path = tmp_path / "a.dsa"
    PROFILE.save(path)
    usual, seen, loads = sys.getswitchinterval(), threading.Event(), 0

    def work():
        nonlocal loads
        while not seen.is_set() and loads < 1000:
            palpate.load(path)
            loads += 1

    sys.setswitchinterval(1000.0)
    try:
        thread = threading.Thread(target=work)
        thread.start()
        seen.set()
        thread.join()
    finally:
        sys.setswitchinterval(usual)
    assert loads < 1000


def test_ctrl_c_ends_long_work():
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        palpate.slip_benchmark(trials=1000)
    assert time.monotonic() - begin < 20
    timer.join()
    assert len(palpate.slip(PROFILE, 1)["dx"]) > 0  # all is well afterwards


def test_what_could_not_be_computed_is_nan():
    size = palpate.object_size(PROFILE, 0, 3)  # nothing is held yet
    assert not size["valid"] and size["trouble"]
    assert all(np.isnan(size[key]) for key in ("start_mm", "plateau_mm", "diameter_mm", "compression_mm"))
    fit = palpate.fit_step([], [])
    assert not fit["converged"] and fit["notes"]
    assert all(np.isnan(fit[key]) for key in ("K", "m", "T1", "T2", "T", "d", "rmse", "steady_s"))


def test_messages_name_the_argument_of_python(tmp_path):
    PROFILE.save(tmp_path / "a.palpate")
    with pytest.raises(OSError, match="force=True"):
        PROFILE.save(tmp_path / "a.palpate")
