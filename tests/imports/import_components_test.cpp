// Tables of hands with three components per taxel.
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "palpate/imports/import_plan.h"
#include "palpate/model/hand_file.h"

#include "imports/component_choice.h"
#include "imports/import_samples.h"

namespace palpate::import_components_test {
namespace {

using testing::errorOf;
using testing::importText;
using testing::pad;
using testing::TemporaryFolder;
using Values = std::vector<float>;

HandDescription skin(int rows, int columns, TouchRule rule = {.components = 3, .isSigned = true}) {
  HandDescription hand = pad(rows, columns);
  MatrixLayout matrix = hand.layout->matrix(0);
  matrix.touch = rule;
  hand.layout = std::make_shared<SensorLayout>(std::vector<MatrixLayout>{matrix});
  return hand;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

// The readings of the first frame of a table.
Values readingsOf(const TemporaryFolder& folder,
                  const std::string& text,
                  const HandDescription& hand,
                  const ImportMapping& mapping = {}) {
  return importText(folder, text, hand, mapping).profile.frame(0).readings;
}

TEST(ImportComponents, ComponentsAreFoundByTheLettersOfTheNames) {
  const TemporaryFolder folder;
  const HandDescription hand = skin(1, 2);
  const Values expected{1, 2, -3, 4, 5, 6};
  // Interleaved and planar in the file, with the letter at the end, in the middle, and a load.
  EXPECT_EQ(readingsOf(folder, "time_s,t0_x,t0_y,t0_z,t1_x,t1_y,t1_z\n0,1,2,-3,4,5,6\n", hand),
            expected);
  EXPECT_EQ(readingsOf(folder, "time_s,bx0,bx1,by0,by1,bz0,bz1\n0,1,4,2,5,-3,6\n", hand), expected);
  const auto made = importText(folder, "time_s,load_N,X1,Y1,Z1,X2,Y2,Z2\n0,7,1,2,-3,4,5,6\n", hand);
  EXPECT_EQ(made.profile.frame(0).readings, expected);
  EXPECT_EQ(made.report.series.size(), 1u);
  EXPECT_EQ(made.profile.sample(kHandSeries, 0).values, std::vector<double>{7});
  EXPECT_FALSE(made.report.isPartial()) << made.report.lossText();
  // Rows and columns of the names.
  EXPECT_EQ(readingsOf(folder,
                       "time_s,m[1][0].x,m[1][0].y,m[1][0].z,m[0][0].x,m[0][0].y,m[0][0].z\n"
                       "0,4,5,6,1,2,-3\n",
                       skin(2, 1)),
            expected);
}

TEST(ImportComponents, NumbersWithoutNamesAreInterleavedUnlessTheMappingSaysPlanar) {
  const TemporaryFolder folder;
  const HandDescription hand = skin(1, 2);
  const std::string text = "time_s,a0,a1,a2,a3,a4,a5\n0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n";
  const auto found = importText(folder, text, hand);
  EXPECT_EQ(found.profile.frame(0).readings, (Values{1, 2, 3, 4, 5, 6}));
  EXPECT_NE(joined(found.report.notes).find("taken as x, y, z of each taxel"), std::string::npos)
      << joined(found.report.notes);
  ImportMapping mapping;
  mapping.components = ComponentOrder::kPlanar;
  const auto planar = importText(folder, text, hand, mapping);
  EXPECT_EQ(planar.profile.frame(0).readings, (Values{1, 3, 5, 2, 4, 6}));
  EXPECT_EQ(joined(planar.report.notes).find("taken as x, y, z"), std::string::npos);
  mapping.matrices = {{0, "a0..a5", {10.0, 0.0, ""}, false}};
  EXPECT_EQ(readingsOf(folder, text, hand, mapping), (Values{10, 30, 50, 20, 40, 60}));
  mapping.components = ComponentOrder::kInterleaved;
  EXPECT_EQ(readingsOf(folder, text, hand, mapping), (Values{10, 20, 30, 40, 50, 60}));
  mapping.matrices = {{0, "a{i}", {}, false}};
  EXPECT_NE(errorOf([&] { importText(folder, text, hand, mapping); }).find("no place for the comp"),
            std::string::npos);
}

TEST(ImportComponents, ArraysHaveTheComponentsAsAnAxis) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np
a = np.arange(24.).reshape(2, 2, 2, 3)
np.savez(sys.argv[1] + '/last.npz', skin=a, time=[0., 1.])
np.savez(sys.argv[1] + '/first.npz', skin=np.moveaxis(a, 3, 1), time=[0., 1.])
np.savez(sys.argv[1] + '/flat.npz', skin=a.reshape(2, 12), time=[0., 1.])
)");
  Values expected;
  for (int i = 12; i < 24; ++i) expected.push_back(static_cast<float>(i));
  for (const char* name : {"last.npz", "first.npz", "flat.npz"}) {
    importRecording(
        folder / name, skin(2, 2), {}, folder / "out.palpate", {.overwrite = Overwrite::kReplace});
    EXPECT_EQ(openRecording(folder / "out.palpate").frame(1).readings, expected) << name;
  }
}

TEST(ImportComponents, WhatDoesNotFitTheHandIsSaid) {
  const TemporaryFolder folder;
  const std::string text = "time_s,t0_x,t0_y,t0_z,t1_x,t1_y,t1_z\n0,1,2,-3,4,5000,6\n";
  // A hand of one component.
  EXPECT_NE(errorOf([&] { importText(folder, text, pad(1, 2)); }).find("\"components\": 3"),
            std::string::npos);
  // One without a sign, and a value above full scale.
  const auto made = importText(folder, text, skin(1, 2, {.components = 3}));
  EXPECT_TRUE(made.report.isPartial());
  EXPECT_EQ(made.report.outside.below, 1u);
  EXPECT_EQ(made.report.outside.above, 1u);
  EXPECT_EQ(made.report.outside.first, "line 2, left, row 0, column 0, z: -3, not in 0..4095");
  EXPECT_NE(joined(made.report.notes).find("\"signed\": true"), std::string::npos);
  const auto beyond = importText(folder, "time_s,x,y,z\n0,1,2,-9000\n", skin(1, 1));
  EXPECT_EQ(beyond.report.outside.summary(),
            "1 value outside the hand's range: 1 below minus full scale");
  // Two numbers per taxel.
  EXPECT_NE(errorOf([&] {
              importText(folder, "time_s,t0_x,t0_y,t1_x,t1_y\n0,1,2,3,4\n", skin(1, 2));
            }).find("1 matrix of 1 x 2 x 3, 2 places, 6 numbers"),
            std::string::npos);
  // A list of active taxels has one value per taxel.
  EXPECT_NE(errorOf([&] {
              importText(folder, "frame,time_ms,matrix,y,x,value\n0,0,0,0,0,1\n", skin(1, 2));
            }).find("list of active taxels"),
            std::string::npos);
}

TEST(ImportComponents, TheNumbersOfARowAreALayout) {
  MatrixLayout matrix = MatrixLayout::full(2, 2, 1.0);
  matrix.staticMask = {1, 0, 1, 1};
  MatrixLayout plain = matrix;
  matrix.touch.components = 3;
  const SensorLayout hand({plain, matrix});
  const SensorLayout interleaved = numbersLayout(hand, ComponentOrder::kFound);
  EXPECT_EQ(interleaved.matrix(0), plain);
  EXPECT_EQ(interleaved.matrix(1).columns, 6);
  EXPECT_EQ(interleaved.matrix(1).staticMask, (Mask{1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  const SensorLayout planar = numbersLayout(hand, ComponentOrder::kPlanar);
  EXPECT_EQ(planar.matrix(1).rows, 6);
  EXPECT_EQ(planar.matrix(1).staticMask, (Mask{1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1}));
  // Of the second matrix, whose first reading is 4: place 5 of the planar one is y of taxel 1.
  EXPECT_EQ(readingAt(3, hand, ComponentOrder::kPlanar), 3u);
  EXPECT_EQ(readingAt(4 + 5, hand, ComponentOrder::kPlanar), 4u + 3 * 1 + 1);
  EXPECT_EQ(readingAt(4 + 5, hand, ComponentOrder::kInterleaved), 9u);
  matrix = MatrixLayout::full(2, 100, 1.0);
  matrix.touch.components = 3;
  EXPECT_THROW(numbersLayout(SensorLayout({matrix}), ComponentOrder::kFound), Error);
}

std::vector<std::vector<double>> tableOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

// A magnetic skin of five places: over the baselines of its makers its magnitudes are theirs.
TEST(ImportComponents, EfleshOverItsBaselinesHasTheMagnitudesOfItsMakers) {
  const auto arrays = testing::arraysFolder();
  if (!arrays) GTEST_SKIP() << "no files of other makers: set PALPATE_ARRAYS";
  const std::filesystem::path eflesh = *arrays / "eflesh";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "hand");
  testing::writeFile(
      folder / "hand" / "hand.json",
      R"({"format": "palpate-hand", "version": 1, "name": "eFlesh", "full_scale": 40000,
          "components": 3, "signed": true, "touch_threshold": 20,
          "matrices": [{"name": "skin", "rows": 5, "columns": 1, "pitch_mm": 8.0}]})");
  ImportOptions options;
  options.series = {{"probe", eflesh / "normal_force_states.csv", std::nullopt}};
  const ImportReport report = importRecording(eflesh / "normal_force_sensor.csv",
                                              readHandFolder(folder / "hand"),
                                              {},
                                              folder / "o.palpate",
                                              options);
  EXPECT_EQ(report.frames, 3600u);
  EXPECT_FALSE(report.isPartial()) << report.lossText();
  const Profile raw = openRecording(folder / "o.palpate");
  EXPECT_EQ(raw.sample(kHandSeries, 0).values, (std::vector<double>{315, -100, 288, 4.36}));
  const auto sent = tableOf(eflesh / "normal_force_sensor.csv");
  const auto over = tableOf(eflesh / "normal_force_sensor_post_baselines.csv");
  ASSERT_EQ(sent.size(), raw.numFrames());
  ASSERT_EQ(over.size(), raw.numFrames());
  // Their baseline was taken anew several times: wherever the difference of both files changes.
  Baselines baselines;
  std::vector<double> last(15, 1e9);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    Baseline baseline;
    bool isNew = false;
    for (std::size_t k = 0; k < last.size(); ++k) {
      const double rest = sent[i].at(k + 1) - over[i].at(k + 1);
      baseline.rest.push_back(static_cast<float>(rest));
      isNew = isNew || std::abs(rest - last[k]) > 0.01;
    }
    if (!isNew) continue;
    last.assign(baseline.rest.begin(), baseline.rest.end());
    baselines.emplace_back(raw.frameTimeUs(i), std::make_shared<const Baseline>(baseline));
  }
  EXPECT_EQ(baselines.size(), 10u);
  const Profile profile = raw.withBaselines(baselines);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame frame = profile.frame(i);
    for (int y = 0; y < 5; ++y) {
      const auto force = forceAt(frame, {0, y, 0});
      const double* theirs = &over[i].at(static_cast<std::size_t>(3 * y + 1));
      const double norm = std::hypot(theirs[0], theirs[1], theirs[2]);
      ASSERT_NEAR(std::hypot(force[0], force[1], force[2]), norm, 0.02) << i << " " << y;
      ASSERT_EQ(frame.values[static_cast<std::size_t>(y)] > 0.0F, norm > 20.0) << i << " " << y;
    }
  }
}

}  // namespace
}  // namespace palpate::import_components_test
