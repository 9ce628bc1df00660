// What a file says of its own numbers: the names of its parts, axes, missing values and units.
#include <gtest/gtest.h>

#include "palpate/imports/recording_import.h"

#include "imports/import_samples.h"
#include "testing/testing.h"

namespace palpate::import_origin_test {
namespace {

using testing::errorOf;
using testing::handOf;
using testing::Imported;
using testing::importText;
using testing::pad;
using testing::runPython;
using testing::TemporaryFolder;
using testing::twoPads;
using Values = std::vector<float>;

std::string notesOf(const ImportReport& report) {
  std::string text;
  for (const std::string& note : report.notes) text += note + "\n";
  return text;
}

TEST(ImportOrigin, MatricesInAListAreTakenByTheirIds) {
  const TemporaryFolder folder;
  const Imported found = importText(
      folder,
      R"({"t": 0.0, "tactile_matrix": [{"matrix_id": 1, "cells_x": 2, "tactile_array": [5, 6, 7, 8]}, {"matrix_id": 0, "cells_x": 2, "tactile_array": [1, 2, 3, 4]}]}
{"t": 0.1, "tactile_matrix": [{"matrix_id": 0, "cells_x": 2, "tactile_array": [11, 12, 13, 14]}, {"matrix_id": 1, "cells_x": 2, "tactile_array": [15, 16, 17, 18]}]}
{"t": 0.2, "tactile_matrix": [{"matrix_id": 1, "cells_x": 2, "tactile_array": [25, 26, 27, 28]}, {"matrix_id": 1, "cells_x": 2, "tactile_array": [21, 22, 23, 24]}]}
{"t": 0.3, "tactile_matrix": [{"matrix_id": 1, "cells_x": 2, "tactile_array": [35, 36, 37, 38]}, {"cells_x": 2, "tactile_array": [31, 32, 33, 34]}]}
)",
      twoPads());
  ASSERT_EQ(found.profile.numFrames(), 2u);
  EXPECT_EQ(found.profile.frame(0).values, (Values{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(found.profile.frame(1).values, (Values{11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(found.report.refused.wrongCount, 2u);
  EXPECT_EQ(found.report.refused.first,
            "line 3 has parts of tactile_matrix with the same matrix_id");
  EXPECT_EQ(notesOf(found.report).find("matrix_id"), std::string::npos);
}

TEST(ImportOrigin, MatricesInAListAreTakenByTheirNames) {
  const TemporaryFolder folder;
  const Imported found = importText(
      folder,
      R"({"t": 0.0, "pads": [{"name": "right", "data": [5, 6, 7, 8]}, {"name": "left", "data": [1, 2, 3, 4]}]}
{"t": 0.1, "pads": [{"name": "left", "data": [11, 12, 13, 14]}, {"name": "right", "data": [15, 16, 17, 18]}]}
{"t": 0.2, "pads": [{"name": "left", "data": [11, 12, 13, 14]}, {"name": "other", "data": [15, 16, 17, 18]}]}
)",
      twoPads());
  ASSERT_EQ(found.profile.numFrames(), 2u);
  EXPECT_EQ(found.profile.frame(0).values, (Values{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(found.profile.frame(1).values, (Values{11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(found.report.refused.total(), 1u);
}

TEST(ImportOrigin, ListsAreTakenByTheNamesBesideThem) {
  const TemporaryFolder folder;
  const Imported found =
      importText(folder,
                 R"({"t": 0.0, "names": ["right", "left"], "data": [[5, 6, 7, 8], [1, 2, 3, 4]]}
{"t": 0.1, "names": ["left", "right"], "data": [[11, 12, 13, 14], [15, 16, 17, 18]]}
)",
                 twoPads());
  ASSERT_EQ(found.profile.numFrames(), 2u);
  EXPECT_EQ(found.profile.frame(0).values, (Values{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(found.profile.frame(1).values, (Values{11, 12, 13, 14, 15, 16, 17, 18}));
}

TEST(ImportOrigin, JointsAreTakenByTheirNames) {
  HandDescription hand = pad(1, 2);
  hand.axes.resize(2);
  hand.axes[0].name = "grip";
  hand.axes[1].name = "wrist";
  const TemporaryFolder folder;
  const std::string text =
      R"({"t": 0.0, "pad": [1, 2], "joint": {"name": ["wrist", "grip"], "position": [10, 20], "velocity": [7, 8]}}
{"t": 0.1, "pad": [1, 2], "joint": {"name": ["grip", "wrist"], "position": [21, 11], "velocity": [7, 8]}}
)";
  const Imported found = importText(folder, text, hand);
  ASSERT_EQ(found.profile.numAngles(), 2u);
  EXPECT_EQ(found.profile.angles(0).values, (std::vector<double>{20, 10}));
  EXPECT_EQ(found.profile.angles(1).values, (std::vector<double>{21, 11}));
  // Names that the hand doesn't know are kept apart all the same.
  hand.axes[0].name = "a";
  hand.axes[1].name = "b";
  const Imported others = importText(folder, text, hand);
  ASSERT_EQ(others.profile.numAngles(), 2u);
  EXPECT_EQ(others.profile.angles(0).values, (std::vector<double>{10, 20}));
  EXPECT_EQ(others.profile.angles(1).values, (std::vector<double>{11, 21}));
  EXPECT_NE(notesOf(others.report).find("in the order of the file: a = joint.position.wrist"),
            std::string::npos)
      << notesOf(others.report);
}

TEST(ImportOrigin, RowsOfAnotherSensorAreLeftOutAndCounted) {
  const TemporaryFolder folder;
  for (const char* text :
       {"{\"t\": 0.0, \"sensor\": \"a\", \"data\": [1, 2]}\n"
        "{\"t\": 0.001, \"sensor\": \"b\", \"data\": [9, 9]}\n"
        "{\"t\": 0.1, \"sensor\": \"a\", \"data\": [3, 4]}\n"
        "{\"t\": 0.05, \"sensor\": \"b\", \"data\": [9, 9]}\n",
        "time_s,sensor,p0,p1\n0.0,a,1,2\n0.001,b,9,9\n0.1,a,3,4\n0.05,b,9,9\n",
        "time_s,device_id,p0,p1\n0.0,4,1,2\n0.001,6,9,9\n0.1,4,3,4\n0.05,6,9,9\n"}) {
    const Imported found = importText(folder, text, pad(1, 2));
    ASSERT_EQ(found.profile.numFrames(), 2u) << text;
    EXPECT_EQ(found.profile.frame(1).values, (Values{3, 4}));
    EXPECT_TRUE(found.report.isPartial());
    EXPECT_EQ(found.report.refused.total(), 0u) << found.report.refused.first;
    const bool isId = std::string_view(text).find("device_id") != std::string_view::npos;
    EXPECT_EQ(found.report.lossText(),
              isId ? "2 rows from \"6\" left out: only \"4\" is imported; save each of them in a "
                     "separate file"
                   : "2 rows from \"b\" left out: only \"a\" is imported; save each of them in a "
                     "separate file");
    EXPECT_NE(
        errorOf([&] {
          importText(
              folder, text, pad(1, 2), {}, {.strict = true, .overwrite = Overwrite::kReplace});
        }).find("line "),
        std::string::npos);
  }
  // One sensor alone is nothing to speak of.
  const Imported one = importText(folder, "time_s,sensor,p0,p1\n0,a,1,2\n1,a,3,4\n", pad(1, 2));
  EXPECT_FALSE(one.report.isPartial());
}

// As rosbridge records topics; a topic of other values is no loss.
TEST(ImportOrigin, OfSeveralTopicsTheFirstOneWithTaxelsIsRead) {
  const TemporaryFolder folder;
  const Imported found =
      importText(folder,
                 R"({"op": "publish", "topic": "/pad", "msg": {"t": 0.0, "data": [1, 2]}}
{"op": "publish", "topic": "/imu", "msg": {"t": 0.005, "data": [9, 9]}}
{"op": "publish", "topic": "/pad", "msg": {"t": 0.01, "data": [3, 4]}}
{"op": "publish", "topic": "/imu", "msg": {"t": 0.015, "data": [9, 9]}}
)",
                 pad(1, 2));
  ASSERT_EQ(found.profile.numFrames(), 2u);
  EXPECT_EQ(found.profile.frame(1).values, (Values{3, 4}));
  EXPECT_EQ(found.profile.frameTimeUs(1), 10'000);
  EXPECT_NE(found.report.lossText().find("2 rows from \"/imu\" left out"), std::string::npos);
  const Imported other = importText(folder,
                                    R"({"topic": "/pad", "t": 0.0, "data": [1, 2]}
{"topic": "/joints", "t": 0.005, "position": [9]}
{"topic": "/pad", "t": 0.01, "data": [3, 4]}
{"topic": "/pad", "t": 0.02, "data": [3, 4]}
)",
                                    pad(1, 2));
  ASSERT_EQ(other.profile.numFrames(), 3u);
  EXPECT_TRUE(other.report.doubts.empty());
}

TEST(ImportOrigin, AHoleInTheNumbersOfTheTaxelsIsSaid) {
  const TemporaryFolder folder;
  const auto lossOf = [&](const std::string& names, const HandDescription& hand) {
    const auto count = static_cast<std::size_t>(std::count(names.begin(), names.end(), ','));
    std::string text = names + "\n";
    for (const char* time : {"0.0", "0.1", "0.2"}) {
      text += time;
      for (std::size_t i = 0; i < count; ++i) text += "," + std::to_string(9 - i);
      text += "\n";
    }
    return importText(folder, text, hand).report.lossText();
  };
  EXPECT_EQ(lossOf("time_s,taxel1,taxel2,taxel3,taxel4,taxel5,taxel7", pad(2, 3)),
            "of taxel1 to taxel7 the file has no taxel6: the others are taken in their order, and "
            "may belong to other taxels (--matrix chooses columns)");
  EXPECT_NE(lossOf("time_s,p0,p1,p2,p3,p4,p6", pad(2, 3)).find("no p5"), std::string::npos);
  EXPECT_NE(lossOf("time_s,taxel2,taxel3,taxel4,taxel5", pad(2, 2)).find("begin at taxel2"),
            std::string::npos);
  // Nobody counts up to that.
  EXPECT_NE(lossOf("time_s,p900000000000,p900000000001,p900000000002,p900000000003", pad(2, 2))
                .find("begin at p900000000000"),
            std::string::npos);
  EXPECT_EQ(lossOf("time_s,taxel0,taxel1,taxel2,taxel3", pad(2, 2)), "");
  EXPECT_EQ(lossOf("time_s,taxel1,taxel2,taxel3,taxel4", pad(2, 2)), "");
  EXPECT_EQ(lossOf("time_s,left0,left1,left2,left3,right4,right5,right6,right7", twoPads()), "");
  // By place, where one place has no taxel.
  MatrixLayout masked = MatrixLayout::full(2, 3, 2.0);
  masked.staticMask[4] = 0;
  EXPECT_EQ(lossOf("time_s,p0,p1,p2,p3,p5", handOf({masked})), "");
}

TEST(ImportOrigin, AUnitOfTimeMayHaveANumber) {
  const TemporaryFolder folder;
  const auto secondFrameUs = [&](const std::string& time, const std::string& value) {
    const Imported found =
        importText(folder, time + ",p0,p1\n0,1,2\n" + value + ",3,4\n", pad(1, 2));
    EXPECT_NE(notesOf(found.report).find("is taken to count"), std::string::npos) << time;
    return found.profile.frameTimeUs(1) - found.profile.frameTimeUs(0);
  };
  EXPECT_EQ(secondFrameUs("time_100us", "100"), 10'000);
  EXPECT_EQ(secondFrameUs("time_100ns", "200000"), 20'000);
  EXPECT_EQ(secondFrameUs("time_0.1s", "2"), 200'000);
  EXPECT_EQ(secondFrameUs("timestamp_2ms", "10"), 20'000);
  EXPECT_EQ(secondFrameUs("time_10ms", "2"), 20'000);
  EXPECT_EQ(secondFrameUs("time in 0.1 ms", "200"), 20'000);
  EXPECT_EQ(secondFrameUs("t [0.1 ms]", "200"), 20'000);
  EXPECT_EQ(secondFrameUs("time (10us)", "2000"), 20'000);
  // The unit that is chosen counts.
  ImportMapping mapping;
  mapping.time.unit = "ms";
  const Imported chosen =
      importText(folder, "time_10ms,p0,p1\n0,1,2\n10,3,4\n", pad(1, 2), mapping);
  EXPECT_EQ(chosen.profile.frameTimeUs(1) - chosen.profile.frameTimeUs(0), 10'000);
  // No factor: the number belongs to the name.
  const Imported other = importText(folder, "time1_ms,p0,p1\n0,1,2\n10,3,4\n", pad(1, 2));
  EXPECT_EQ(other.profile.frameTimeUs(1) - other.profile.frameTimeUs(0), 10'000);
}

TEST(ImportOrigin, ATableOfRHasNamesOfRows) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 100.0;
  const Imported found = importText(folder,
                                    "\"V1\" \"V2\" \"V3\" \"V4\"\n\"1\" 3 40 77 114\n\"2\" 14 51 "
                                    "88 125\n\"3\" 25 62 99 136\n",
                                    pad(2, 2),
                                    mapping);
  ASSERT_EQ(found.profile.numFrames(), 3u);
  EXPECT_EQ(found.profile.frame(0).values, (Values{3, 40, 77, 114}));
  EXPECT_EQ(found.profile.frame(2).values, (Values{25, 62, 99, 136}));
  EXPECT_NE(notesOf(found.report).find("not used: row names"), std::string::npos)
      << notesOf(found.report);
  // With a time among the columns.
  const Imported timed =
      importText(folder, "time_s,p0,p1\na,0.0,1,2\nb,0.1,3,4\nc,0.2,5,6\n", pad(1, 2));
  ASSERT_EQ(timed.profile.numFrames(), 3u);
  EXPECT_EQ(timed.profile.frame(1).values, (Values{3, 4}));
  EXPECT_EQ(timed.profile.frameTimeUs(2), 200'000);
}

TEST(ImportOrigin, FortransExponentsAreNumbers) {
  const TemporaryFolder folder;
  const Imported found = importText(
      folder, "time_s,p0,p1\n0.0D+00,1.0D+02,2.5d0\n1.0D-01,3.0D+00,4.0D+00\n", pad(1, 2));
  ASSERT_EQ(found.profile.numFrames(), 2u);
  EXPECT_EQ(found.profile.frame(0).values, (Values{100, 2.5}));
  EXPECT_EQ(found.profile.frameTimeUs(1), 100'000);
}

TEST(ImportOrigin, LinesMayEndWithACarriageReturn) {
  const TemporaryFolder folder;
  const Imported found = importText(folder, "time_s,p0,p1\r0.0,1,2\r0.1,3,4\r", pad(1, 2));
  ASSERT_EQ(found.profile.numFrames(), 2u);
  EXPECT_EQ(found.profile.frame(1).values, (Values{3, 4}));
}

TEST(ImportOrigin, ANameThatIsThereTwiceIsSaid) {
  const TemporaryFolder folder;
  const std::string error =
      errorOf([&] { importText(folder, "time_s,p1,p2,p1\n0,1,2,9\n1,3,4,9\n", pad(1, 2)); });
  EXPECT_NE(error.find("the name \"p1\" is there twice"), std::string::npos) << error;
}

// Two frames of 2 x 2: rows [[1, 2], [3, 4]] and [[5, 6], [7, 8]].
TEST(ImportOrigin, TheNamesOfAxesOfHdf5Count) {
  const TemporaryFolder folder;
  runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
frames = np.array([[[1, 2], [3, 4]], [[5, 6], [7, 8]], [[9, 10], [11, 12]]])
def file(name, axes, scales):
  with h5py.File(folder + name, 'w') as f:
    order = [('time', 'y', 'x').index(a) for a in axes]
    pad = f.create_dataset('pad', data=frames.transpose(order))
    if 'time' not in f: f['time'] = [0.0, 0.1, 0.2]
    if not scales:
      for i, a in enumerate(axes): pad.dims[i].label = a
      return
    f['x'] = f['y'] = [0.0, 1.0]
    f['y2'] = [0.0, 1.0]
    del f['y']; f.move('y2', 'y')
    for a in axes: f[a].make_scale(a)
    for i, a in enumerate(axes): pad.dims[i].attach_scale(f[a])
file('labels_yx.h5', ('time', 'y', 'x'), False)
file('labels_xy.h5', ('time', 'x', 'y'), False)
file('labels_last.h5', ('y', 'x', 'time'), False)
file('scales_xy.nc', ('time', 'x', 'y'), True)
file('middle.h5', ('y', 'time', 'x'), False)
)");
  for (const char* name : {"labels_yx.h5", "labels_xy.h5", "labels_last.h5", "scales_xy.nc"}) {
    const ImportReport report = importRecording(
        folder / name, pad(2, 2), {}, folder / "out.palpate", {.overwrite = Overwrite::kReplace});
    const Profile profile = openRecording(folder / "out.palpate");
    ASSERT_EQ(profile.numFrames(), 3u) << name;
    EXPECT_EQ(profile.frame(0).values, (Values{1, 2, 3, 4})) << name;
    EXPECT_EQ(profile.frame(2).values, (Values{9, 10, 11, 12})) << name;
    const bool isTold = notesOf(report).find("transposed") != std::string::npos ||
                        notesOf(report).find("the last axis of the arrays") != std::string::npos;
    EXPECT_EQ(isTold, std::string_view(name) != "labels_yx.h5") << notesOf(report);
  }
  const std::string error = errorOf(
      [&] { importRecording(folder / "middle.h5", pad(2, 2), {}, folder / "middle.palpate"); });
  EXPECT_NE(error.find("the axis \"time\" of pad"), std::string::npos) << error;
}

TEST(ImportOrigin, MissingValuesOfNetcdfAreCounted) {
  const TemporaryFolder folder;
  runPython(folder, R"(
import sys, numpy as np, h5py
with h5py.File(sys.argv[1] + '/a.nc', 'w') as f:
  pad = f.create_dataset('pad', data=np.array([[1, 999], [3, 4], [-5, 6]], 'i2'))
  pad.attrs['_FillValue'] = np.int16(999)
  pad.attrs['missing_value'] = np.array([-5], 'i2')
  f['time'] = [0.0, 0.1, 0.2]
)");
  const ImportReport report =
      importRecording(folder / "a.nc", pad(1, 2), {}, folder / "out.palpate");
  const Profile profile = openRecording(folder / "out.palpate");
  ASSERT_EQ(profile.numFrames(), 3u);
  EXPECT_EQ(profile.frame(0).values, (Values{1, 0}));
  EXPECT_EQ(profile.frame(2).values, (Values{0, 6}));
  EXPECT_EQ(report.outside.notANumber, 2u);
  EXPECT_EQ(report.outside.total(), 2u);
  EXPECT_NE(notesOf(report).find("999 in pad is a missing value"), std::string::npos);
}

TEST(ImportOrigin, ReadingsWithASignAreStoredAsTheyAre) {
  const TemporaryFolder folder;
  const auto handWith = [](TouchRule rule) {
    HandDescription hand = pad(1, 2);
    MatrixLayout matrix = hand.layout->matrix(0);
    matrix.touch = rule;
    hand.layout = std::make_shared<SensorLayout>(std::vector<MatrixLayout>{matrix});
    return hand;
  };
  const std::string text = "time_ms,p0,p1\n0,-7,2\n10,8,-9000\n";
  const Imported found = importText(folder, text, handWith({.isSigned = true, .threshold = 5.0F}));
  ASSERT_TRUE(found.profile.givesReadings());
  EXPECT_EQ(found.profile.frame(0).readings, (Values{-7, 2}));
  EXPECT_EQ(found.profile.frame(0).values, (Values{7, 0}));
  EXPECT_EQ(found.profile.frame(1).readings, (Values{8, -9000}));
  EXPECT_EQ(found.report.outside.below, 1u) << "beyond the full scale of 4095";
  EXPECT_NE(found.report.outside.first.find("-9000, not in -4095..4095"), std::string::npos)
      << found.report.outside.first;
}

}  // namespace
}  // namespace palpate::import_origin_test
