#include "palpate/imports/recording_import.h"

#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"

#include "imports/import_samples.h"

namespace palpate::recording_import_test {
namespace {
namespace fs = std::filesystem;

using testing::handOf;
using testing::importText;
using testing::pad;
using testing::TemporaryFolder;
using testing::twoPads;

// A recording of an SDH-2 with fractions, angles, temperatures, a gap, and a frame without contact.
Profile original(bool withEmptyFrame) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 40; ++i) {
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    for (std::size_t m = 0; m < 6; ++m) {
      const MatrixLayout& matrix = sdh2().layout->matrix(m);
      for (std::size_t k = 0; k < matrix.numCells(); k += 3)
        if (matrix.staticMask[k] != 0)
          values[sdh2().layout->offset(m) + k] =
              static_cast<float>((i * 97 + static_cast<int>(k) * 31) % 4000) + 0.25F;
    }
    if (withEmptyFrame && i == 20) std::fill(values.begin(), values.end(), 0.0F);
    const std::int64_t us = 1'417'084'265'000'000 + i * 31'000 + (i >= 30 ? 5'000'000 : 0);
    builder.addFrame(us, values);
    const double angle = 0.1 * i;
    builder.addAngles(us + 3000, std::vector<double>{angle, 1, 2, 3, 4, 5, -angle});
    if (i % 4 == 0)
      builder.addTemperatures(us + 1000,
                              std::vector<double>(sdh2().temperatureSensors.size(), 20.5 + i));
  }
  return builder.finish({});
}

// Equal values and times.
void expectSame(const Profile& expected, const Profile& found) {
  ASSERT_EQ(found.numFrames(), expected.numFrames());
  for (std::size_t i = 0; i < expected.numFrames(); ++i) {
    EXPECT_EQ(found.frameTimeUs(i), expected.frameTimeUs(i));
    EXPECT_EQ(found.frame(i).values, expected.frame(i).values) << i;
  }
  ASSERT_EQ(found.numAngles(), expected.numAngles());
  for (std::size_t i = 0; i < expected.numAngles(); ++i) {
    EXPECT_EQ(found.angleTimeUs(i), expected.angleTimeUs(i));
    EXPECT_EQ(found.angles(i).values, expected.angles(i).values);
  }
  ASSERT_EQ(found.numTemperatures(), expected.numTemperatures());
  for (std::size_t i = 0; i < expected.numTemperatures(); ++i) {
    EXPECT_EQ(found.temperatureTimeUs(i), expected.temperatureTimeUs(i));
    EXPECT_EQ(found.temperatures(i).values, expected.temperatures(i).values);
  }
}

TEST(RecordingImport, OurOwnExportsComeBack) {
  for (const char* name : {"a.npz", "a.csv"}) {
    const TemporaryFolder folder;
    const Profile before = original(false);
    saveRecording(before, {}, folder / name);
    const ImportReport report = importRecording(folder / name, sdh2(), {}, folder / "b.palpate");
    expectSame(before, openRecording(folder / "b.palpate"));
    EXPECT_EQ(report.frames, 40u);
    EXPECT_EQ(report.gaps, 1u);
    EXPECT_NEAR(report.longestGapS, 5.031, 1e-9);
    EXPECT_EQ(report.refused.total(), 0u);
    EXPECT_EQ(report.notes, std::vector<std::string>());
    EXPECT_EQ(verifyRecording(folder / "b.palpate").state, VerifyReport::State::kSound);
    EXPECT_EQ(readRecordingMeta(folder / "b.palpate").at("imported_from"), name);
  }
}

// arrays A1: two frames share each millisecond.
TEST(RecordingImport, OurOwnExportsOf2kHzComeBack) {
  HandDescription hand = handOf({MatrixLayout::full(1, 2, 2.0)}, 1, 1);
  hand.axes[0].isSliding = true;
  ProfileBuilder builder(hand);
  for (int i = 0; i < 400; ++i) {
    const std::int64_t us = 1'417'084'265'000'250 + i * 500;
    builder.addFrame(us, std::vector<float>{static_cast<float>(1 + i), 0.0F});
    builder.addAngles(us + 100, std::vector<double>{0.5 * i});
    builder.addTemperatures(us + 200, std::vector<double>{20.0 + i});
  }
  const Profile before = builder.finish({});
  for (const char* name : {"a.npz", "a.csv"}) {
    const TemporaryFolder folder;
    saveRecording(before, {}, folder / name);
    const ImportReport report = importRecording(folder / name, hand, {}, folder / "b.palpate");
    expectSame(before, openRecording(folder / "b.palpate"));
    EXPECT_EQ(report.refused.total(), 0u) << report.refused.first;
    EXPECT_EQ(report.absentFrames, 0u);
    EXPECT_EQ(report.notes, std::vector<std::string>()) << name;
  }
}

// arrays A1: a list without time_us, as earlier releases wrote it.
TEST(RecordingImport, ARefusedFrameOfAListIsNotAFrameWithoutContact) {
  const TemporaryFolder folder;
  const auto made = importText(folder,
                               "frame,time_ms,matrix,y,x,value\n"
                               "0,10,0,0,0,1\n"
                               "1,10,0,0,0,2\n1,10,0,0,1,2\n"
                               "2,11,0,0,0,3\n"
                               "4,12,0,0,0,4\n",
                               pad(1, 2));
  EXPECT_EQ(made.report.frames, 3u);
  EXPECT_EQ(made.report.refused.notLater, 2u) << "both rows of frame 1";
  EXPECT_EQ(made.report.absentFrames, 1u) << "frame 3";
}

// No whole number holds this one.
TEST(RecordingImport, AFrameOfAListFarBelowZeroIsRefused) {
  const TemporaryFolder folder;
  const auto made = importText(folder,
                               "frame,time_ms,matrix,y,x,value\n"
                               "0,10,0,0,0,1\n"
                               "-1e30,11,0,0,0,2\n"
                               "1,12,0,0,0,3\n",
                               pad(1, 2));
  EXPECT_EQ(made.report.frames, 2u);
  EXPECT_EQ(made.report.refused.notLater, 1u);
  EXPECT_EQ(made.report.absentFrames, 0u);
}

TEST(RecordingImport, OfTwoColumnsOfTheSameTimesTheFinerIsTaken) {
  const TemporaryFolder folder;
  const char* table = "stamp_ms,stamp_us,p0,p1\n10,10250,1,2\n10,10750,3,4\n";
  const auto made = importText(folder, table, pad(1, 2));
  ASSERT_EQ(made.profile.numFrames(), 2u) << made.report.refused.first;
  EXPECT_EQ(made.profile.frameTimeUs(1), 10'750);
  // imports 13: the parts of a time are joined: seconds, and nanoseconds within the second.
  const char* parts = "stamp_s,stamp_ns,p0,p1\n10,250000000,1,2\n11,500000000,3,4\n";
  const auto seconds = importText(folder, parts, pad(1, 2));
  EXPECT_EQ(seconds.profile.frameTimeUs(0), 10'250'000);
  EXPECT_EQ(seconds.profile.frameTimeUs(1), 11'500'000);
}

TEST(RecordingImport, AFrameThatAListOfTaxelsDoesNotHoldIsCounted) {
  const TemporaryFolder folder;
  saveRecording(original(true), {}, folder / "a.csv");
  const ImportReport report = importRecording(folder / "a.csv", sdh2(), {}, folder / "b.palpate");
  EXPECT_EQ(report.frames, 39u);
  EXPECT_EQ(report.absentFrames, 1u);
}

TEST(RecordingImport, PlotJugglersExport) {
  const TemporaryFolder folder;
  // Series of two rates, joined by time; sorted by name; numbers with nine decimals.
  const auto made = importText(folder,
                               "__time,/hand/joint0,/hand/joint1,/pad/p[0],/pad/p[1],/pad/p[10],"
                               "/pad/p[11],/pad/p[2],/pad/p[3],/pad/p[4],/pad/p[5],/pad/p[6],"
                               "/pad/p[7],/pad/p[8],/pad/p[9]\n"
                               "1700000000.010000,,,0.000000000,1.000000000,10.000000000,"
                               "11.000000000,2.000000000,3.000000000,4.000000000,5.000000000,"
                               "6.000000000,7.000000000,8.000000000,9.500000000\n"
                               "1700000000.015000,12.500000000,-3.000000000,,,,,,,,,,,,\n"
                               "1700000000.020000,13.500000000,-4.000000000,0.000000000,"
                               "1.000000000,10.000000000,11.000000000,2.000000000,3.000000000,"
                               "4.000000000,5.000000000,6.000000000,7.000000000,8.000000000,"
                               "9.000000000\n",
                               handOf({MatrixLayout::full(3, 4, 1.0)}, 2));
  ASSERT_EQ(made.profile.numFrames(), 2u);
  EXPECT_EQ(made.profile.frameTimeUs(0), 1'700'000'000'010'000);
  EXPECT_EQ(made.profile.frame(0).values,
            (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9.5F, 10, 11}));
  ASSERT_EQ(made.profile.numAngles(), 2u);
  EXPECT_EQ(made.profile.angleTimeUs(0), 1'700'000'000'015'000);
  EXPECT_EQ(made.profile.angles(0).values, (std::vector<double>{12.5, -3.0}));
  EXPECT_EQ(made.report.refused.total(), 0u);
}

TEST(RecordingImport, ArduinosShapes) {
  const std::vector<float> second{5, 6, 7, 8};
  for (const char* text :
       {"millis:10 t0:1 t1:2 t2:3 t3:4\nmillis:20 t0:5 t1:6 t2:7 t3:8\n",
        "millis:10,t0:1,t1:2,t2:3,t3:4\nmillis:20,t0:5,t1:6,t2:7,t3:8\n",
        "10,1,2,3,4\n20,5,6,7,8\n",
        "10\t1\t2\t3\t4\t\n20\t5\t6\t7\t8\t\n",
        "10 1 2 3 4\n20 5 6 7 8\n",
        "time;p1;p2;p3;p4\nms;counts;counts;counts;counts\n10;1;2;3;4\n20;5;6;7;8\n",
        "t [s],a,b,c,d\n0.01,1,2,3,4\n0.02,5,6,7,8\n",
        "time_us,a,b,c,d\n10000,1,2,3,4\n20000,5,6,7,8\n",
        "stamp,a,b,c,d\n1970-01-01T00:00:00.010Z,1,2,3,4\n"
        "1970-01-01 00:00:00.020,5,6,7,8\n"}) {
    const TemporaryFolder folder;
    const auto made = importText(folder, text, pad(2, 2));
    ASSERT_EQ(made.profile.numFrames(), 2u) << text;
    EXPECT_EQ(made.profile.frameTimeUs(0), 10'000) << text;
    EXPECT_EQ(made.profile.frameTimeUs(1), 20'000) << text;
    EXPECT_EQ(made.profile.frame(1).values, second) << text;
    EXPECT_EQ(made.report.refused.total(), 0u) << text << made.report.refused.first;
    EXPECT_EQ(made.profile.info().valueType, ValueType::kCounts);
  }
}

TEST(RecordingImport, ARateMakesTheTimes) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 200.0;
  mapping.time.startUs = 1'417'084'265'000'000;
  const auto made = importText(folder, "1,2,3,4\n1,2,x,4\n5,6,7,8\n", pad(2, 2), mapping);
  ASSERT_EQ(made.profile.numFrames(), 2u);
  EXPECT_EQ(made.profile.frameTimeUs(0), 1'417'084'265'000'000);
  EXPECT_EQ(made.profile.frameTimeUs(1), 1'417'084'265'010'000);  // the refused row took its time
}

TEST(RecordingImport, UnitsAndScalesAreConverted) {
  HandDescription hand = handOf({MatrixLayout::full(1, 2, 1.0)}, 2, 1);
  hand.unit = "kPa";
  hand.axes[1].isSliding = true;
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.angles.values.unit = "";
  const auto made = importText(folder,
                               "t [ms],p0 [Pa],p1 [Pa],joint0 [rad],joint1 [m],temperature [K]\n"
                               "1,2500,500,3.14159265358979323846,0.012,300\n",
                               hand);
  EXPECT_EQ(made.profile.frame(0).values, (std::vector<float>{2.5F, 0.5F}));
  EXPECT_NEAR(made.profile.angles(0).values[0], 180.0, 1e-12);
  EXPECT_NEAR(made.profile.angles(0).values[1], 12.0, 1e-12);
  EXPECT_NEAR(made.profile.temperatures(0).values[0], 26.85, 1e-12);
  mapping.matrices = {{0, "p*", {0.5, -1.0, "N/cm2"}, false}};
  const auto scaled = importText(folder, "t,p0,p1\n1,4,2\n", hand, mapping);
  EXPECT_EQ(scaled.profile.frame(0).values, (std::vector<float>{10.0F, 0.0F}));
  const auto strange = importText(folder, "t,p0 [furlong],p1 [furlong]\n1,4,2\n", hand);
  ASSERT_EQ(strange.report.notes.size(), 2u);  // and of the guessed unit of the time
  EXPECT_NE(strange.report.notes[0].find("furlong"), std::string::npos);
}

TEST(RecordingImport, RowsThatCanNotBeUsedAreCountedByKind) {
  const std::string text =
      "t,a,b,c,d\n"
      "1,1,2,3,4\n"
      "2,1,2,3\n"
      "3,1,2,oops,4\n"
      "4,1,inf,3,4\n"
      "5,1,,3,4\n"
      ",1,2,3,4\n"
      "soon,1,2,3,4\n"
      "1,1,2,3,4\n"
      "0.5,1,2,3,4\n"
      "6,,,,\n"
      "7,5,6,7,8\n";
  const TemporaryFolder folder;
  const auto made = importText(folder, text, pad(2, 2));
  EXPECT_EQ(made.report.rows, 11u);
  EXPECT_EQ(made.report.frames, 2u);
  const RefusedRows& refused = made.report.refused;
  EXPECT_EQ(refused.wrongCount, 1u);
  EXPECT_EQ(refused.text, 2u);
  EXPECT_EQ(refused.notFinite, 1u);
  EXPECT_EQ(refused.missing, 2u);
  EXPECT_EQ(refused.notLater, 2u);
  EXPECT_EQ(refused.total(), 8u);
  EXPECT_EQ(refused.first, "line 3 has 4 cells instead of 5");
  EXPECT_EQ(refused.summary(),
            "8 rows refused: 1 of another form, 2 with text, 1 with NaN or too large "
            "values, 2 with missing values, 2 with a time that is not later");
  EXPECT_EQ(RefusedRows().summary(), "");
  EXPECT_EQ(
      made.report.lossText(),
      refused.summary() +
          "; the first: line 3 has 4 cells instead of 5; where times repeat, --rate keeps all "
          "rows");
}

TEST(RecordingImport, StrictStopsAtTheFirstRefusedRowAndWritesNothing) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"2,1,2,3\n", "line 3 has 4 cells instead of 5"},
      {"2,1,2,oops,4\n", "line 3, column 4: \"oops\" is not a number"},
      {"2,1,nan,3,4\n", "line 3, column 3: \"nan\", not finite"},
      {"2,1,,3,4\n", "line 3, column 3 is empty"},
      {"2,1,2,3,1e50\n", "line 3, column 5: \"1e50\""},
      {"1,1,2,3,4\n", "line 3: the time 1 is not later"},
      {"soon,1,2,3,4\n", "line 3: \"soon\" is not a time"}};
  for (const auto& [row, words] : cases) {
    const TemporaryFolder folder;
    const std::string what = testing::errorOf([&, &row = row] {
      importText(folder, "t,a,b,c,d\n1,1,2,3,4\n" + row, pad(2, 2), {}, {.strict = true});
    });
    EXPECT_NE(what.find(words), std::string::npos) << what;
    EXPECT_NE(what.find("table.csv: "), std::string::npos) << what;
    EXPECT_FALSE(fs::exists(folder / "out.palpate"));
    // Nothing but the table is left in the folder.
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  }
}

TEST(RecordingImport, NothingIsLeftWhenItFailsOrIsCancelled) {
  const TemporaryFolder folder;
  const auto numFiles = [&] {
    return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
  };
  std::string text = "t,a,b,c,d\n";
  for (int i = 0; i < 2000; ++i) text += std::to_string(10 * i) + ",1,2,3,4\n";
  testing::writeFile(folder / "t.csv", text);
  int asked = 0;
  EXPECT_THROW(importRecording(folder / "t.csv",
                               pad(2, 2),
                               {},
                               folder / "o.palpate",
                               {},
                               [&](double fraction) {
                                 EXPECT_GE(fraction, 0.0);
                                 EXPECT_LE(fraction, 1.0);
                                 return ++asked < 4;
                               }),
               Cancelled);
  EXPECT_EQ(numFiles(), 1);
  const std::string none = testing::errorOf([&] {
    testing::writeFile(folder / "u.csv", "t,a,b,c,d\n1,x,2,3,4\n2,1,2,3,y\n");
    importRecording(folder / "u.csv", pad(2, 2), {}, folder / "o.palpate");
  });
  EXPECT_NE(none.find("no row can be used; the first: line 2"), std::string::npos) << none;
  EXPECT_EQ(numFiles(), 2);
  EXPECT_NE(testing::errorOf([&] {
              importRecording(folder / "t.csv", pad(2, 2), {}, folder / "o.csv");
            }).find("written as .palpate"),
            std::string::npos);
  testing::writeFile(folder / "mine.palpate", "mine");
  EXPECT_THROW(importRecording(folder / "t.csv", pad(2, 2), {}, folder / "mine.palpate"),
               FileError);
  EXPECT_EQ(testing::readFile(folder / "mine.palpate"), "mine");
  importRecording(
      folder / "t.csv", pad(2, 2), {}, folder / "mine.palpate", {.overwrite = Overwrite::kReplace});
  EXPECT_EQ(openRecording(folder / "mine.palpate").numFrames(), 2000u);
}

TEST(RecordingImport, ArraysOfNumpyAndHdf5AreTheSameRecording) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
left = (np.arange(50 * 4 * 3) % 997).reshape(50, 4, 3).astype('<u2')
right = (np.arange(50 * 2 * 5) % 89).reshape(50, 2, 5).astype('>i4')
time = 1700000000000000000 + np.arange(50) * 10_000_000
joints = np.linspace(0, 1, 120).reshape(60, 2)
joint_time = 1700000000.0 + np.arange(60) * 0.0085
np.savez_compressed(folder + 'a.npz', left=left, right=np.asfortranarray(right), time_ns=time,
                    joint_rad=joints, joint_time=joint_time)
np.savez(folder + 'rows.npz', left=left.reshape(50, 12), right=right.reshape(50, 10),
         time=time.astype('datetime64[ns]'), joint_rad=joints, joint_time=joint_time)
with h5py.File(folder + 'a.h5', 'w') as f:
  f['hand/left'] = left; f['hand/right'] = right; f['hand/time_ns'] = time
  f['arm/joint_rad'] = joints; f['arm/joint_time'] = joint_time
)");
  const HandDescription hand =
      handOf({MatrixLayout::full(4, 3, 1.0), MatrixLayout::full(2, 5, 1.0)}, 2);
  for (const char* name : {"a.npz", "rows.npz", "a.h5"}) {
    const ImportReport report = importRecording(
        folder / name, hand, {}, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
    const Profile profile = openRecording(folder / "o.palpate");
    ASSERT_EQ(profile.numFrames(), 50u) << name;
    std::vector<std::string> notes = {
        "time: the unit of \"" + std::string(name == std::string("a.h5") ? "arm/" : "") +
        "joint_time\" is guessed to be s; choose another one by --time-unit"};
    if (name == std::string("rows.npz"))
      notes.push_back("time: the dates have no offset and are taken as UTC");
    EXPECT_EQ(report.notes, notes) << name;
    for (std::size_t i = 0; i < 50; ++i) {
      EXPECT_EQ(profile.frameTimeUs(i),
                1'700'000'000'000'000 + static_cast<std::int64_t>(i) * 10'000);
      const auto values = profile.frame(i).values;
      for (std::size_t k = 0; k < 12; ++k)
        EXPECT_EQ(values[k], static_cast<float>((i * 12 + k) % 997)) << name;
      for (std::size_t k = 0; k < 10; ++k)
        EXPECT_EQ(values[12 + k], static_cast<float>((i * 10 + k) % 89)) << name;
    }
    ASSERT_EQ(profile.numAngles(), 60u) << name;
    EXPECT_NEAR(profile.angles(59).values[1], 57.29577951308232, 1e-12);
    EXPECT_EQ(profile.angleTimeUs(2), 1'700'000'000'017'000);
  }
}

// The values of frame t of pad(2, 3) are 6 t, 6 t + 1, .. row by row.
void expectCounting(const Profile& profile, const std::string& name) {
  ASSERT_EQ(profile.numFrames(), 8u) << name;
  for (std::size_t t = 0; t < 8; ++t) {
    EXPECT_EQ(profile.frameTimeUs(t), static_cast<std::int64_t>(t) * 10'000) << name;
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_EQ(profile.frame(t).values[k], static_cast<float>(6 * t + k)) << name << " " << t;
  }
}

// Arrays whose axes are not frames, rows, columns, by NumPy and as MATLAB 7.3 and 5 write them.
constexpr const char* kArraysOfOtherAxes = R"(
import h5py
folder = sys.argv[1] + '/'
pad = np.arange(48).reshape(8, 2, 3)
time = np.arange(8) * 0.01
swapped = pad.transpose(0, 2, 1)
np.savez(folder + 'columns.npz', pad=swapped, time_s=time)
np.savez(folder + 'fortran.npz', pad=np.asfortranarray(swapped), time_s=time)
np.savez(folder + 'last.npz', pad=np.moveaxis(pad, 0, 2), time_s=time.reshape(1, 8))
np.savez(folder + 'last_fortran.npz', pad=np.asfortranarray(np.moveaxis(pad, 0, 2)), time_s=time.reshape(1, 8))
np.savez(folder + 'within.npz', table=np.column_stack([time, pad.reshape(8, 6)]))
np.savez(folder + 'extra.npz', pad=pad, time_s=time, extra=np.zeros((8, 3)))
with h5py.File(folder + 'last.h5', 'w') as f:
  f.create_dataset('pad', data=np.moveaxis(pad, 0, 2), chunks=(1, 3, 3), compression='gzip')
  f['time_s'] = time.reshape(1, 8)
def matlab(name, **arrays):
  with h5py.File(folder + name, 'w', userblock_size=512) as f:
    for key, values in arrays.items():
      f[key] = values.T
      f[key].attrs['MATLAB_class'] = np.bytes_('double')
  with open(folder + name, 'r+b') as f: f.write(b'MATLAB 7.3 MAT-file'.ljust(512))
row, column = time.reshape(1, 8), time.reshape(8, 1)
matlab('rcf.mat', pad=np.moveaxis(pad, 0, 2), time_s=row)
matlab('rcf_column.mat', pad=np.moveaxis(pad, 0, 2), time_s=column)
matlab('frc.mat', pad=pad, time_s=column)
matlab('ft.mat', pad=pad.reshape(8, 6), time_s=column)
matlab('tf.mat', pad=pad.reshape(8, 6).T, time_s=row)
pad = pad.astype('f8')
for name, first, second in [('rcf', np.moveaxis(pad, 0, 2), row), ('rcf_column', np.moveaxis(pad, 0, 2), column),
                            ('frc', pad, column), ('ft', pad.reshape(8, 6), column), ('tf', pad.reshape(8, 6).T, row)]:
  write(folder + name + '.5.mat', packed(array('pad', first, 'u1')), array('time_s', second))
)";

TEST(RecordingImport, TheShapeOfAnArrayTellsItsAxes) {
  const TemporaryFolder folder;
  testing::runPython(folder, std::string(testing::kMat5Writer) + kArraysOfOtherAxes);
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::string>>{
           {"columns.npz", "transposed"},
           {"fortran.npz", "transposed"},
           {"last.npz", "taken for the frames"},
           {"last_fortran.npz", "taken for the frames"},
           {"last.h5", "taken for the frames"},
           {"rcf.mat", "transposed"},
           {"rcf_column.mat", "transposed"},
           {"frc.mat", "taken for the frames"},
           {"ft.mat", "taken for the frames"},
           {"tf.mat", "row by row"},
           {"rcf.5.mat", "transposed"},
           {"rcf_column.5.mat", "transposed"},
           {"frc.5.mat", "taken for the frames"},
           {"ft.5.mat", "taken for the frames"},
           {"tf.5.mat", "row by row"},
           {"within.npz", "table[0] ascends and is taken for the time"}}) {
    const ImportReport report = importRecording(
        folder / name, pad(2, 3), {}, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
    expectCounting(openRecording(folder / "o.palpate"), name);
    EXPECT_TRUE(
        std::any_of(report.notes.begin(),
                    report.notes.end(),
                    [&](const std::string& note) { return note.find(words) != std::string::npos; }))
        << name << ": " << Json(jsonList(report.notes)).text();
    EXPECT_FALSE(report.isPartial()) << name;
  }
  // An array that is no matrix is a series.
  importRecording(folder / "extra.npz",
                  pad(2, 3),
                  {},
                  folder / "o.palpate",
                  {.overwrite = Overwrite::kReplace});
  const Profile extra = openRecording(folder / "o.palpate");
  expectCounting(extra, "extra.npz");
  ASSERT_EQ(extra.series().size(), kHandSeries + 1);
  EXPECT_EQ(extra.series().back().name, "extra");
  EXPECT_EQ(extra.series().back().columns, (std::vector<Column>{{"0", ""}, {"1", ""}, {"2", ""}}));
  EXPECT_EQ(extra.numSamples(kHandSeries), 8u);
  // Chosen by name the shape decides as well, and numbers of an array can be chosen.
  const auto choose = [&](const char* name, const char* columns, const char* time) {
    ImportMapping mapping;
    mapping.matrices = {{0, columns, {}, false}};
    mapping.time.column = time;
    mapping.time.unit = "s";
    importRecording(folder / name,
                    pad(2, 3),
                    mapping,
                    folder / "o.palpate",
                    {.overwrite = Overwrite::kReplace});
    expectCounting(openRecording(folder / "o.palpate"), std::string(name) + " " + columns);
  };
  choose("columns.npz", "pad", "time_s");
  choose("rcf.mat", "pad", "time_s");
  choose("frc.mat", "pad", "time_s");
  choose("frc.5.mat", "pad", "time_s");
  choose("within.npz", "table[1]..table[6]", "table[0]");
  ImportMapping noSuchMatrix;
  noSuchMatrix.matrices = {{7, "pad", {}, false}};
  EXPECT_NE(testing::errorOf([&] {
              importRecording(folder / "last.npz", pad(2, 3), noSuchMatrix, folder / "no.palpate");
            }).find("the hand has no matrix 7"),
            std::string::npos);
  EXPECT_NE(testing::errorOf([&] {
              choose("within.npz", "table[6]..table[1]", "table[0]");
            }).find("the numbers \"table[6]..table[1]\" end before they begin"),
            std::string::npos);
}

TEST(RecordingImport, ASquareOfMatlabIsTransposedAndOneOfNumpyIsNot) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
pad = np.arange(20).reshape(5, 2, 2)
time = np.arange(5) * 0.01
np.savez(folder + 'a.npz', pad=pad, time_s=time)
with h5py.File(folder + 'a.mat', 'w', userblock_size=512) as f:
  f['pad'] = np.moveaxis(pad, 0, 2).T
  f['pad'].attrs['MATLAB_class'] = np.bytes_('double')
  f['time_s'] = time.reshape(5, 1)
np.savez(folder + 'other.npz', pad=np.zeros((5, 4, 1)), time_s=time)
np.savez(folder + 'wrong.npz', pad=np.zeros((5, 4, 3)), time_s=time)
np.savez(folder + 'stack.npz', pad=np.arange(40).reshape(5, 4, 2), time_s=time)
)");
  const auto import = [&](const char* name, const HandDescription& hand, const char* chosen = "") {
    ImportMapping mapping;
    if (*chosen) mapping.matrices = {{std::nullopt, chosen, {}, false}};
    importRecording(
        folder / name, hand, mapping, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
    return openRecording(folder / "o.palpate").frame(1).values;
  };
  EXPECT_EQ(import("a.npz", pad(2, 2)), (std::vector<float>{4, 5, 6, 7}));
  EXPECT_EQ(import("a.mat", pad(2, 2)), (std::vector<float>{4, 5, 6, 7}));
  EXPECT_EQ(import("other.npz", pad(2, 2)), (std::vector<float>{0, 0, 0, 0}));
  // The rows of two matrices of 2 x 2 one below the other.
  EXPECT_EQ(import("stack.npz", twoPads()), (std::vector<float>{8, 9, 10, 11, 12, 13, 14, 15}));
  // Other rows and columns are refused, however many numbers there are.
  for (const char* chosen : {"", "pad"}) {
    const std::string refusal = testing::errorOf([&] { import("wrong.npz", pad(2, 6), chosen); });
    EXPECT_NE(refusal.find("pad[4][3]"), std::string::npos) << refusal;
  }
}

// As many frames as columns: the shape tells nothing.
TEST(RecordingImport, AFirstAxisAsLongAsTheLastIsNoted) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
pad = np.arange(8).reshape(2, 2, 2)
time = np.arange(2) * 0.01
np.savez(folder + 'a.npz', pad=pad, time_s=time)
with h5py.File(folder + 'a.mat', 'w', userblock_size=512) as f:
  f['pad'] = pad
  f['pad'].attrs['MATLAB_class'] = np.bytes_('double')
  f['time_s'] = time
)");
  const auto noted = [&](const char* name, const char* chosen, const std::string& axis) {
    ImportMapping mapping;
    if (*chosen) mapping.matrices = {{0, chosen, {}, false}};
    const ImportReport report = importRecording(folder / name,
                                                pad(2, 2),
                                                mapping,
                                                folder / "o.palpate",
                                                {.overwrite = Overwrite::kReplace});
    return std::any_of(report.notes.begin(), report.notes.end(), [&](const std::string& note) {
      return note.starts_with("the " + axis + " axis of pad is taken for the frames, but");
    });
  };
  EXPECT_TRUE(noted("a.npz", "", "first"));
  EXPECT_TRUE(noted("a.mat", "", "last"));
  EXPECT_FALSE(noted("a.npz", "pad", "first"));
}

// S5, B1, S8, S13. Of a hand with matrices of 2 x 3: left 1 to 6, right 7 to 12 in frame 0.
TEST(RecordingImport, SeveralMatricesInArrays) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
pads = (1 + np.arange(96)).reshape(8, 2, 2, 3)
time = np.arange(8) * 0.01
def save(name, **arrays): np.savez(folder + name, time_s=time, **arrays)
save('first.npz', pads=pads)
save('last.npz', pads=np.moveaxis(pads, 1, 3))
save('below.npz', pads=pads.reshape(8, 4, 3))
save('flat.npz', pads=pads.reshape(8, 12))
save('named.npz', tactile_right=pads[:, 1], tactile_left=pads[:, 0])
save('turned.npz', Right=pads[:, 1].transpose(0, 2, 1), left=pads[:, 0])
save('unknown.npz', b=pads[:, 0], a=pads[:, 1])
save('side.npz', pads=np.concatenate([pads[:, 0], pads[:, 1]], axis=2))
three = (1 + np.arange(8 * 18)).reshape(8, 3, 2, 3)
save('side3.npz', pads=np.concatenate([three[:, 0], three[:, 1], three[:, 2]], axis=2))
save('middle.npz', pads=np.zeros((2, 8, 3)))
save('fingers.npz', palm=np.full((8, 2, 2), 3), index=np.full((8, 3, 2), 2), thumb=np.full((8, 2, 3), 1))
with h5py.File(folder + 'groups.h5', 'w') as f:
  f['a_right/taxels'] = pads[:, 1]; f['b_left/taxels'] = pads[:, 0]; f['time_s'] = time
with h5py.File(folder + 'scaled.h5', 'w') as f:
  f['pads'] = (pads * 2 - 10).astype('<i2'); f['time_s'] = time
  f['pads'].attrs['scale_factor'] = 0.5; f['pads'].attrs['add_offset'] = 5.0
with open(folder + 'twice.npy', 'wb') as f:
  np.save(f, pads); np.save(f, pads)
)");
  const HandDescription twins =
      handOf({MatrixLayout::full(2, 3, 1.0), MatrixLayout::full(2, 3, 1.0)});
  const auto import = [&](const std::string& name, const HandDescription& hand) {
    ImportMapping mapping;
    if (name == "twice.npy") mapping.time.rateHz = 100.0;
    return importRecording(
        folder / name, hand, mapping, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
  };
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::string>>{
           {"first.npz", ""},
           {"last.npz", "the last index of pads is taken for the matrix"},
           {"below.npz", "one below the other in pads"},
           {"flat.npz", ""},
           {"named.npz", ""},
           {"turned.npz", "transposed"},
           {"unknown.npz", "taken in the order of the file: left = b, right = a"},
           {"groups.h5", ""},
           {"scaled.h5", "scale_factor"},
           {"twice.npy", "bytes after the array are not read"}}) {
    const ImportReport report = import(name, twins);
    const Profile profile = openRecording(folder / "o.palpate");
    ASSERT_EQ(profile.numFrames(), 8u) << name;
    for (std::size_t k = 0; k < 12; ++k) {
      EXPECT_EQ(profile.frame(0).values[k], static_cast<float>(1 + k)) << name;
      EXPECT_EQ(profile.frame(7).values[k], static_cast<float>(85 + k)) << name;
    }
    const std::string notes = Json(jsonList(report.notes)).text();
    if (words.empty())
      EXPECT_TRUE(report.notes.empty()) << name << ": " << notes;
    else
      EXPECT_NE(notes.find(words), std::string::npos) << name << ": " << notes;
  }
  // Matrix and number, or side by side.
  const std::string either = testing::errorOf([&] { import("side.npz", twins); });
  EXPECT_NE(either.find("one after the other, or side by side"), std::string::npos) << either;
  const auto three = MatrixLayout::full(2, 3, 1.0);
  const ImportReport side = import("side3.npz", handOf({three, three, three}));
  const Profile sideBySide = openRecording(folder / "o.palpate");
  for (std::size_t k = 0; k < 18; ++k)
    EXPECT_EQ(sideBySide.frame(0).values[k], static_cast<float>(1 + k));
  ASSERT_FALSE(side.notes.empty());
  EXPECT_NE(side.notes[0].find("side by side"), std::string::npos) << side.notes[0];
  const std::string middle = testing::errorOf([&] { import("middle.npz", twins); });
  EXPECT_NE(middle.find("arrays are read as frames x rows x columns"), std::string::npos) << middle;
  // Called as the matrices, one of them by a word that is often a counter.
  HandDescription fingers = handOf({MatrixLayout::full(2, 3, 1.0),
                                    MatrixLayout::full(3, 2, 1.0),
                                    MatrixLayout::full(2, 2, 1.0)});
  fingers.matrices[0].name = "thumb";
  fingers.matrices[1].name = "index";
  fingers.matrices[2].name = "palm";
  import("fingers.npz", fingers);
  const std::vector<float> values = openRecording(folder / "o.palpate").frame(0).values;
  EXPECT_EQ(values, (std::vector<float>{1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3}));
}

TEST(RecordingImport, OtherArraysSayWhyTheyAreNotUsed) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
time = np.arange(5) * 0.01
np.savez(folder + 'bool.npz', pad=np.zeros((5, 2, 2), dtype=bool), time_s=time)
np.savez(folder + 'objects.npz', pad=np.array([[1], [2, 3]], dtype=object), time_s=time)
np.save(folder + 'record.npy', np.zeros(5, dtype=[('time', 'f8'), ('pad', 'u2', (2, 2))]))
with h5py.File(folder + 'record.h5', 'w') as f:
  f['pad'] = np.zeros(5, dtype=[('a', 'f8'), ('b', 'u2')]); f['time_s'] = time
with h5py.File(folder + 'lists.h5', 'w') as f:
  f.create_dataset('pad', (5,), dtype=h5py.vlen_dtype('u2')); f['time_s'] = time
with h5py.File(folder + 'lzf.h5', 'w') as f:
  f.create_dataset('pad', data=np.zeros((5, 2, 2)), compression='lzf'); f['time_s'] = time
)");
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::string>>{
           {"bool.npz", "no numbers: pad (bool)"},
           {"objects.npz", "no numbers: pad (Python objects)"},
           {"record.npy", "no numbers: array (structure: save each field as a separate array)"},
           {"record.h5", "no numbers: pad (structure: save each field as a separate array)"},
           {"lists.h5", "no numbers: pad (lists of different lengths)"},
           {"lzf.h5", "filter that is not available (32000"}}) {
    const std::string refusal = testing::errorOf(
        [&] { importRecording(folder / name, pad(2, 2), {}, folder / "o.palpate"); });
    EXPECT_NE(refusal.find(words), std::string::npos) << name << ": " << refusal;
  }
}

HandDescription maskedPad() {
  MatrixLayout matrix = MatrixLayout::full(2, 2, 1.0);
  matrix.staticMask[1] = 0;
  matrix.dynamicMask[1] = 0;
  return handOf({matrix});
}

TEST(RecordingImport, PlacesWithoutATaxelAreNotLookedAt) {
  for (const char* cell : {"nan", "99999", "-1", "inf", "", "x"}) {
    const TemporaryFolder folder;
    const auto made =
        importText(folder,
                   "time_ms,p0,p1,p2,p3\n10,1," + std::string(cell) + ",3,4\n20,1,2,3,4\n",
                   maskedPad());
    EXPECT_EQ(made.report.frames, 2u) << cell;
    EXPECT_FALSE(made.report.isPartial()) << cell << made.report.lossText();
    EXPECT_EQ(made.profile.frame(0).values, (std::vector<float>{1, 0, 3, 4})) << cell;
  }
}

TEST(RecordingImport, ValuesOutsideOfTheRangeAreKeptAndCounted) {
  const TemporaryFolder folder;
  HandDescription hand = pad(2, 2);
  hand.maximumCounts = 1023.0F;
  const std::string text =
      "time_ms,p0,p1,p2,p3\n10,1,1023,0,4\n20,1,nan,1024,4\n30,-0.5,nan,-3,2000\n40,nan,nan,nan,"
      "nan\n";
  const auto made = importText(folder, text, hand);
  EXPECT_EQ(made.report.frames, 3u);
  EXPECT_EQ(made.report.outside.above, 2u);
  EXPECT_EQ(made.report.outside.below, 2u);
  EXPECT_EQ(made.report.outside.notANumber, 2u);
  EXPECT_EQ(made.report.outside.first, "line 3, left, row 0, column 1: nan, not in 0..1023");
  EXPECT_EQ(made.report.refused.notFinite, 1u);  // a frame without any number
  EXPECT_EQ(made.profile.frame(1).values, (std::vector<float>{1, 0, 1024, 4}));
  EXPECT_EQ(made.profile.frame(2).values, (std::vector<float>{-0.5F, 0, -3, 2000}));
  EXPECT_EQ(made.report.outside.summary(),
            "6 values outside the hand's range: 2 above full scale, 2 below 0, 2 NaN (taken as 0)");
  EXPECT_TRUE(made.report.isPartial());
  EXPECT_EQ(ImportReport().lossText(), "");
  // The recording knows it, too.
  const auto events = readEvents(folder / "out.palpate").events;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "alarm");
  EXPECT_EQ(events[0].tUs, made.profile.frameTimeUs(0));
  EXPECT_NE(events[0].text.find("2 NaN (taken as 0)"), std::string::npos) << events[0].text;
}

TEST(RecordingImport, AGarbledCounterDoesNotShiftTheRest) {
  const TemporaryFolder folder;
  const auto timesOf = [&](const std::vector<std::string>& counters, std::uint64_t notLater) {
    std::string text = "time_us,a,b,c,d\n";
    for (const std::string& counter : counters) text += counter + ",1,2,3,4\n";
    const auto made = importText(folder, text, pad(2, 2));
    EXPECT_EQ(made.report.refused.notLater, notLater) << text;
    std::vector<std::int64_t> times;
    for (std::size_t i = 0; i < made.profile.numFrames(); ++i)
      times.push_back(made.profile.frameTimeUs(i));
    return times;
  };
  using Times = std::vector<std::int64_t>;
  // A digit lost; all but two lost near the turn; a turn that goes on; one with which the file
  // ends.
  EXPECT_EQ(timesOf({"3000123456", "300012345", "3000133456"}, 1),
            (Times{3'000'123'456, 3'000'133'456}));
  EXPECT_EQ(timesOf({"4294900000", "42", "4294920000", "4294930000"}, 1),
            (Times{4'294'900'000, 4'294'920'000, 4'294'930'000}));
  EXPECT_EQ(timesOf({"4294960000", "2704", "12704"}, 0),
            (Times{4'294'960'000, 4'294'970'000, 4'294'980'000}));
  EXPECT_EQ(timesOf({"4294950000", "4294960000", "2704"}, 1),
            (Times{4'294'950'000, 4'294'960'000}));
}

TEST(RecordingImport, ALastLineWithoutAnEndIsNoted) {
  const TemporaryFolder folder;
  const auto notes = [&](const std::string& end) {
    return importText(folder, "time_ms,a,b,c,d\n10,1,2,3,4\n20,1,2,3,17" + end, pad(2, 2))
        .report.notes;
  };
  EXPECT_EQ(notes(""),
            std::vector<std::string>{
                "line 3, the last one, has no line end: its last number may be cut off"});
  EXPECT_EQ(notes("\n"), std::vector<std::string>());
  EXPECT_EQ(notes("\r\n"), std::vector<std::string>());
}

TEST(RecordingImport, OurOwnJsonLinesComeBackWithTheirTimes) {
  const TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 5; ++i) {
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    for (std::size_t m = 0; m < 6; ++m)
      for (std::size_t k = 0; k < sdh2().layout->matrix(m).numCells(); k += 3)
        if (sdh2().layout->matrix(m).staticMask[k] != 0)
          values[sdh2().layout->offset(m) + k] =
              static_cast<float>(100 * i + 7 * static_cast<int>(m) + static_cast<int>(k));
    builder.addFrame(1'417'084'265'000'250 + i * 31'000, values);
  }
  const Profile before = builder.finish({});
  saveRecording(before, {}, folder / "a.jsonl");
  const ImportReport report = importRecording(folder / "a.jsonl", sdh2(), {}, folder / "b.palpate");
  EXPECT_EQ(report.refused.total(), 0u) << report.refused.first;
  expectSame(before, openRecording(folder / "b.palpate"));
}

TEST(RecordingImport, WhatIsMissingIsNamedWithWhatIsThere) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
np.savez(folder + 'a.npz', left=np.zeros((50, 3, 4)), time=10 * np.arange(50))
np.savez(folder + 'b.npz', pad=np.zeros((50, 4, 3)), time=10 * np.arange(49))
with h5py.File(folder + 'a.h5', 'w') as f: f['raw/pad'] = np.zeros((50, 4, 3)); f['raw/time'] = 10 * np.arange(50)
)");
  const HandDescription hand = pad(4, 3);
  const auto refusal = [&](const char* name, const ImportMapping& mapping) {
    return testing::errorOf([&] {
      importRecording(
          folder / name, hand, mapping, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
    });
  };
  ImportMapping mapping;
  mapping.matrices = {{0, "/tactile/pad", {}, false}};
  const std::string absent = refusal("a.h5", mapping);
  EXPECT_NE(absent.find("there is no column \"/tactile/pad\"; there are raw/pad[4][3], raw/time"),
            std::string::npos)
      << absent;
  mapping.matrices = {{0, "/raw/pad", {}, false}};
  EXPECT_EQ(refusal("a.h5", mapping), "");
  // 3 x 4 numbers of a pad of 4 x 3 are column by column.
  ImportMapping shape;
  shape.matrices = {{0, "left", {}, true}};
  EXPECT_EQ(testing::errorOf(
                [&] { importRecording(folder / "a.npz", hand, shape, folder / "p.palpate"); }),
            "");
  const std::string rows = refusal("b.npz", {});
  EXPECT_NE(rows.find("\"time\" has 49 rows, but pad has 50 rows; save as many times as frames, or "
                      "give the rate of the rows (--rate)"),
            std::string::npos)
      << rows;
  ImportMapping time;
  time.time.column = "time";
  EXPECT_NE(refusal("b.npz", time).find("\"time\" has 49 rows, but pad has 50"), std::string::npos);
}

TEST(RecordingImport, APreviewShowsWhatAnImportWouldDo) {
  const TemporaryFolder folder;
  std::string text = "time_ms,p0,p1,note\n";
  for (int i = 0; i < 3000; ++i)
    text += std::to_string(i * 10 + (i > 100 ? 3000 : 0)) + "," + std::to_string(i % 7) + "," +
            (i == 50 ? "x" : "1.5") + ",hm\n";
  testing::writeFile(folder / "t.csv", text);
  const ImportPreview preview = previewImport(folder / "t.csv", pad(1, 2), {});
  EXPECT_EQ(preview.problem, "");
  EXPECT_EQ(preview.form, "text, separated by commas, names in line 1");
  ASSERT_EQ(preview.columns.size(), 4u);
  ASSERT_EQ(preview.rows.size(), kShownPreviewRows);
  EXPECT_EQ(preview.rows[1], (std::vector<std::string>{"10", "1", "1.5", "hm"}));
  EXPECT_EQ(preview.time, "time_ms [ms, by the file]");
  ASSERT_EQ(preview.choices.size(), 1u);
  EXPECT_NE(preview.choices[0].find("p0 to p1"), std::string::npos) << preview.choices[0];
  EXPECT_EQ(preview.sample.rows, kPreviewRows);
  EXPECT_EQ(preview.sample.frames, kPreviewRows - 1);
  EXPECT_EQ(preview.sample.gaps, 1u);
  EXPECT_DOUBLE_EQ(preview.rateHz, 100.0) << "whatever the gap is";
  EXPECT_EQ(preview.sample.refused.text, 1u);
  EXPECT_FALSE(preview.isWhole);
  const ImportPreview wrong = previewImport(folder / "t.csv", pad(3, 3), {});
  EXPECT_NE(wrong.problem.find("1 matrix of 3 x 3"), std::string::npos) << wrong.problem;
  EXPECT_EQ(wrong.rows.size(), kShownPreviewRows);
}

}  // namespace
}  // namespace palpate::recording_import_test
