"""palpate.load(), Profile, save(): against the independent reader of the tests and NumPy's own."""
import contextlib
import copy
import json
import multiprocessing
import os
import pickle
import shutil
import sqlite3
import struct
import tempfile
import unittest
from pathlib import Path

import numpy as np

import independent_reader
import palpate

CORPUS = Path(os.environ["PALPATE_CORPUS"])
WHOLE = CORPUS / "palpate" / "whole.palpate"


def recordings():
    source = Path(os.environ["PALPATE_SOURCE"])
    folder = Path(os.environ.get("PALPATE_RECORDINGS", source.parent / "shared/data/recordings"))
    if not folder.is_dir():
        raise unittest.SkipTest("shared data is missing: set PALPATE_RECORDINGS")
    return folder


class AsASequence(unittest.TestCase):
    def setUp(self):
        self.profile = palpate.load(WHOLE)

    def test_frames_by_number_and_one_after_the_other(self):
        frames = self.profile.frames()
        np.testing.assert_array_equal(self.profile[3], frames[3])
        np.testing.assert_array_equal(self.profile[-1], frames[-1])
        np.testing.assert_array_equal(np.array(list(self.profile)), frames)
        for index in (len(frames), -len(frames) - 1):
            with self.assertRaises(IndexError):
                self.profile[index]
        with self.assertRaises(TypeError):
            self.profile["3"]

    def test_a_slice_is_a_profile(self):
        part = self.profile[2:-3]
        np.testing.assert_array_equal(part.frames(), self.profile.frames()[2:-3])
        np.testing.assert_array_equal(part.time_us, self.profile.time_us[2:-3])
        self.assertEqual(len(self.profile[:10_000_000]), len(self.profile))
        for wrong in (slice(0, 10, 2), slice(5, 5)):
            with self.assertRaises(ValueError):
                self.profile[wrong]

    def same(self, a, b):
        np.testing.assert_array_equal(a.frames(), b.frames())
        np.testing.assert_array_equal(a.time_us, b.time_us)
        np.testing.assert_array_equal(a.angles, b.angles)
        np.testing.assert_array_equal(a.angle_time_ms, b.angle_time_ms)
        np.testing.assert_array_equal(a.temperatures, b.temperatures)
        for name in ("hand", "format", "value_type", "serial", "firmware", "warnings", "axes"):
            self.assertEqual(getattr(a, name), getattr(b, name), name)

    def test_pickle_keeps_all(self):
        self.same(pickle.loads(pickle.dumps(self.profile)), self.profile)
        filtered = palpate.filter(self.profile, "gaussian")
        self.same(pickle.loads(pickle.dumps(filtered)), filtered)
        pad = palpate.record(np.full((3, 256), 0.5, np.float32), "flat_pad_16x16", rate=10)
        self.same(pickle.loads(pickle.dumps(pad)), pad)

    def test_other_processes_take_it(self):
        with multiprocessing.get_context("fork").Pool(1) as pool:
            self.assertEqual(pool.map(len, [self.profile]), [len(self.profile)])

    def test_what_is_no_profile_is_refused(self):
        reduced = self.profile.__reduce_ex__(2)
        for state in ((b"nonsense", "dsa", []), (b"",)):
            made = palpate.Profile.__new__(palpate.Profile)
            with self.assertRaises((ValueError, TypeError)):
                made.__setstate__(state)
        self.assertEqual(len(reduced[2]), 3)

    def test_copies_are_the_same(self):
        self.assertIs(copy.copy(self.profile), self.profile)
        self.assertIs(copy.deepcopy(self.profile), self.profile)


class Arrays(unittest.TestCase):
    def check(self, profile, path):
        frames, angles, temperatures = independent_reader.read(path)
        self.assertEqual(len(profile), len(frames))
        stacked = np.array([values for _, _, values in frames], dtype=np.float32)
        np.testing.assert_array_equal(profile.frames(), stacked)
        np.testing.assert_array_equal(profile.time_ms, [t // 1000 for t, _, _ in frames])
        begin = 0
        for m in range(6):
            rows = 14 if m % 2 == 0 else 13
            np.testing.assert_array_equal(
                profile.matrix(m), stacked[:, begin:begin + rows * 6].reshape(-1, rows, 6))
            begin += rows * 6
        if angles:
            np.testing.assert_array_equal(profile.angles, [v for _, _, v in angles])
        np.testing.assert_array_equal(profile.angle_time_ms, [t // 1000 for t, _, _ in angles])
        if temperatures:
            np.testing.assert_array_equal(profile.temperatures, [v for _, _, v in temperatures])
        np.testing.assert_array_equal(profile.temperature_time_ms,
                                      [t // 1000 for t, _, _ in temperatures])
        if angles:
            times = np.array([t for t, _, _ in angles])
            at = np.searchsorted(times, [t for t, _, _ in frames], side="right") - 1
            expected = np.array([v for _, _, v in angles])[np.clip(at, 0, None)]
            np.testing.assert_array_equal(profile.angles_at_frames(), expected)

    def test_equal_those_of_the_independent_reader(self):
        self.check(palpate.load(WHOLE), WHOLE)

    def test_real_recordings_equal_too(self):
        for name in ("misc/masked_matrix.dsa", "grasps/foam_ball.dsa"):
            with tempfile.TemporaryDirectory() as folder:
                native = os.path.join(folder, "a.palpate")
                profile = palpate.load(recordings() / name)
                profile.save(native)
                self.check(profile, native)
                self.check(palpate.load(native), native)

    def test_types_and_slices(self):
        profile = palpate.load(WHOLE)
        self.assertEqual(profile.frames().dtype, np.float32)
        self.assertEqual(profile.matrix(0).shape, (12, 14, 6))
        self.assertEqual(profile.time_ms.dtype, np.int64)
        self.assertEqual(profile.angles.dtype, np.float64)
        every = profile.frames()
        for start, stop in ((0, 5), (3, 3), (-4, None), (2, -2), (5, 100), (9, 2)):
            np.testing.assert_array_equal(profile.frames(start, stop), every[start:stop])
        np.testing.assert_array_equal(profile.matrix(-1), profile.matrix(5))
        self.assertEqual(profile.serial, "1D9B0057")


class FurtherSeries(unittest.TestCase):
    @staticmethod
    def add_wrist(path, rows):
        """Adds a series to a native recording by docs/notes/palpate_format.md: (host us, device us, fx, fz)."""
        columns = '[{"name":"fx","unit":"N"},{"name":"fz","unit":""}]'
        begin = rows[0][0]
        data = b"".join(struct.pack("<Iqdd", t - begin, device, fx, fz) for t, device, fx, fz in rows)
        block = (3, 0, len(rows), begin, rows[-1][0], 3 | 8)
        with contextlib.closing(sqlite3.connect(path)) as db:
            db.execute("CREATE TABLE series(idx INTEGER PRIMARY KEY, name TEXT NOT NULL, role TEXT NOT NULL,"
                       " source TEXT NOT NULL, columns TEXT NOT NULL, crc32 INTEGER NOT NULL)")
            series = (3, "wrist", "trigger", "tcp:1", columns)
            crc = independent_reader.row_crc(3, "wrist", "trigger", "tcp:1", columns)
            db.execute("INSERT INTO series VALUES(?, ?, ?, ?, ?, ?)", (*series, crc))
            db.execute("INSERT INTO block(stream, first, n, t0_us, t1_us, coding, crc32, data)"
                       " VALUES(?, ?, ?, ?, ?, ?, ?, ?)", (*block, independent_reader.block_crc(*block, data), data))
            db.execute("PRAGMA user_version=3")
            db.commit()

    def test_series_of_the_hand(self):
        profile = palpate.load(WHOLE)
        angles = profile.series["angles"]
        np.testing.assert_array_equal(angles.values, profile.angles)
        self.assertEqual((angles.role, angles.columns), ("joint_angles", profile.axes))
        self.assertIsNone(angles.device_times_us)

    def test_values_times_and_pickling(self):
        rows = [(10**15 + 7, 1001, 0.1, 2.5), (10**15 + 9, -2**63, 0.3, float("nan"))]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.palpate")
            shutil.copy(WHOLE, path)
            self.add_wrist(path, rows)
            profile = palpate.load(path)
            for each in (profile, pickle.loads(pickle.dumps(profile))):
                self.assertEqual(list(each.series), ["angles", "temperatures", "wrist"])
                wrist = each.series["wrist"]
                self.assertEqual((len(wrist), wrist.role, wrist.source), (2, "trigger", "tcp:1"))
                self.assertEqual((wrist.columns, wrist.units), (["fx", "fz"], ["N", ""]))
                np.testing.assert_array_equal(wrist.times_us, [row[0] for row in rows])
                np.testing.assert_array_equal(wrist.device_times_us, [row[1] for row in rows])
                np.testing.assert_array_equal(wrist.values, [row[2:] for row in rows])
            self.assertIn("2 samples of wrist", repr(profile))


class Saving(unittest.TestCase):
    @staticmethod
    def static_mask():
        distal = np.ones((13, 6))
        distal[:5, [0, 5]] = 0
        return np.concatenate([np.ones(84), distal.ravel()] * 3).astype(np.float32)

    def test_every_form(self):
        profile = palpate.load(WHOLE)
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("dsa", "palpate"):
                path = Path(folder) / f"a.{ending}"
                profile.save(path)
                again = palpate.load(path)
                expected = profile.frames()
                if ending == "dsa":  # its reader knows that there is no taxel in the cut corners
                    expected = expected * self.static_mask()
                np.testing.assert_array_equal(again.frames(), expected)
                np.testing.assert_array_equal(again.angles, profile.angles)
            profile.save(Path(folder) / "a.npz")
            arrays = np.load(Path(folder) / "a.npz", allow_pickle=False)
            self.assertEqual(set(arrays.files), {
                "time_ms", "time_us", "m0", "m1", "m2", "m3", "m4", "m5", "angles", "angle_time_ms", "angle_time_us",
                "temperatures", "temperature_time_ms", "temperature_time_us", "static_mask", "meta"})
            for m in range(6):
                self.assertEqual(arrays[f"m{m}"].dtype, np.uint16)
                np.testing.assert_array_equal(arrays[f"m{m}"], profile.matrix(m))
            np.testing.assert_array_equal(arrays["angles"], profile.angles)
            np.testing.assert_array_equal(arrays["time_ms"], profile.time_ms)
            np.testing.assert_array_equal(arrays["time_us"], profile.time_us)
            self.assertEqual(arrays["static_mask"].sum(), 456)
            self.assertEqual(json.loads(str(arrays["meta"]))["serial"], "1D9B0057")
            profile.save(Path(folder) / "a.csv")
            table = np.loadtxt(Path(folder) / "a.csv", delimiter=",", skiprows=1)
            matrix = profile.matrix(0)
            for frame, _, m, y, x, value, _ in table:
                if m == 0:
                    self.assertEqual(matrix[int(frame), int(y), int(x)], value)
            self.assertEqual(len(table), np.count_nonzero(profile.frames() > 0))

    def test_nothing_is_replaced_without_force(self):
        profile = palpate.load(WHOLE)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.palpate")
            profile.save(path)
            with self.assertRaisesRegex(OSError, "exists already"):
                profile.save(path)
            profile.save(path, force=True)
            with self.assertRaisesRegex(OSError, "must end in"):
                profile.save(os.path.join(folder, "a.txt"))


class Errors(unittest.TestCase):
    def test_are_pythons_own(self):
        profile = palpate.load(WHOLE)
        with self.assertRaises(IndexError):
            profile.matrix(6)
        with self.assertRaises(IndexError):
            profile.matrix(-7)
        with self.assertRaisesRegex(ValueError, "no times of the sender's clock"):
            palpate.from_arrays([0, 10], np.zeros((2, 486))).fitted_times()
        with self.assertRaises(OSError):
            palpate.load("missing.palpate")
        for name in ("mask", "view", "counts", "page"):
            with self.assertRaises(ValueError, msg=name):
                palpate.load(CORPUS / "palpate" / f"{name}.palpate").frames()
        with self.assertRaises(ValueError):
            palpate.load(__file__)
        with self.assertRaises(ValueError):
            palpate.load(CORPUS / "palpate" / "pad.palpate").angles_at_frames()


if __name__ == "__main__":
    unittest.main()
