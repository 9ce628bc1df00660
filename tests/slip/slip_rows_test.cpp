#include "palpate/slip/slip_rows.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::slip_rows_test {
namespace {

// Matrix 1 slips by 2 taxels between frames 50 and 60, matrix 3 rests, the others are empty.
Profile movedContact() {
  ProfileBuilder builder(sdh2().layout);
  SyntheticSensor sensor;
  sensor.layout = sdh2().layout->matrix(1);
  SyntheticSlip slip(sensor, 1);
  std::int64_t nowUs = 1'000'000;
  for (int i = 0; i < 90; ++i) {
    TactileFrame frame(sdh2().layout);
    slip.read({.y = 4.5 + 0.2 * std::clamp(i - 50, 0, 10)}, frame.matrix(1));
    slip.read({}, frame.matrix(3));
    builder.addFrame(nowUs += 31'000, frame.values);
  }
  return builder.finish({});
}

std::string csvOf(const SlipRowsOptions& options) {
  std::string csv;
  writeTableText(*slipTable(movedContact(), options), {}, [&](const auto& text) { csv += text; });
  return csv;
}

TEST(SlipRows, AreOneForEachFrameAndMatrixWithAContact) {
  const std::string csv = csvOf({});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 90);
  EXPECT_EQ(csv.rfind("frame,time_ms,matrix,active,valid,dx,dy,ref_dx,ref_dy,rotation_valid,"
                      "rotation_deg,ref_rotation_deg,orientation_deg,eccentricity,roundness,"
                      "residual,confidence,p_moved,state,slipping\n0,1031,1,",
                      0),
            0U)
      << csv.substr(0, 300);
  const std::string ofOne = csvOf({.matrix = 3});
  EXPECT_EQ(std::count(ofOne.begin(), ofOne.end(), '\n'), 1 + 90);
  EXPECT_NE(ofOne.find("\n89,3790,3,"), std::string::npos);
}

// As the detector says them, frame by frame.
TEST(SlipRows, HaveTheValuesOfTheDetector) {
  const auto table = slipTable(movedContact(), {.matrix = 1});
  std::vector<Cell> cells;
  std::size_t known = 0;
  runSlipDetector(movedContact(), {}, [&](std::size_t frame, std::int64_t, const auto& detections) {
    ASSERT_TRUE(table->next(cells));
    const SlipDetection& detection = detections[1];
    EXPECT_EQ(std::get<std::int64_t>(cells[0]), static_cast<std::int64_t>(frame));
    EXPECT_EQ(std::get<bool>(cells[4]), detection.motion.valid);
    EXPECT_EQ(std::holds_alternative<std::monostate>(cells[5]), !detection.motion.valid);
    if (detection.motion.valid) {
      EXPECT_EQ(std::get<double>(cells[6]), detection.motion.dy + 0.0);
      ++known;
    }
    EXPECT_EQ(std::get<std::string>(cells[18]), nameOf(detection.state));
    EXPECT_EQ(std::get<bool>(cells[19]), detection.slipping);
  });
  EXPECT_GT(known, 50u);
  EXPECT_FALSE(table->next(cells));
}

TEST(SlipRows, OfSlipsAreOneForEachSlip) {
  const std::string csv = csvOf({.segments = true});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 1) << csv;
  EXPECT_EQ(csv.rfind("begin,end,begin_ms,end_ms,matrix,path_taxels,rotation_deg,confidence\n", 0),
            0U);
  const std::string ofThree = csvOf({.matrix = 3, .segments = true});
  EXPECT_EQ(std::count(ofThree.begin(), ofThree.end(), '\n'), 1);
}

TEST(SlipRows, CanHaveTheCentroid) {
  const std::string csv = csvOf({.matrix = 3, .withCentroid = true});
  EXPECT_EQ(csv.rfind("frame,time_ms,matrix,active,x,y,valid,dx,", 0), 0U) << csv.substr(0, 100);
  const auto columns = slipColumns(true);
  EXPECT_EQ(columns.size(), slipColumns().size() + 2);
  runSlipDetector(movedContact(), {}, [&](std::size_t, std::int64_t, const auto& detections) {
    for (const char* name : {"x", "y"}) {
      const SlipMotion& motion = detections[1].motion;
      EXPECT_EQ(numberOf(columnNamed(columns, name).cell(detections[1])),
                *name == 'x' ? motion.x : motion.y);
    }
  });
}

TEST(SlipRows, SayWhereNoRotationIsMeasured) {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(3, 3, TaxelPitch(2.0, 5.0))});
  ProfileBuilder builder(layout);
  builder.addFrame(1'000'000, TactileFrame(layout).values);
  const Profile oblong = builder.finish({});
  for (const bool segments : {false, true}) {
    const SlipRowsOptions options{.segments = segments};
    EXPECT_EQ(slipTable(oblong, options)->notes(),
              std::vector<std::string>{"no rotation is measured where taxels aren't square"});
    EXPECT_TRUE(slipTable(movedContact(), options)->notes().empty());
  }
}

TEST(SlipRows, HaveUnits) {
  EXPECT_EQ(columnNamed(slipColumns(), "ref_dx").column.unit, "taxels");
  EXPECT_EQ(columnNamed(slipColumns(), "orientation_deg").column.unit, "deg");
  EXPECT_EQ(columnNamed(slipColumns(), "p_moved").column.unit, "");
  EXPECT_THROW(columnNamed(slipColumns(), "speed"), std::out_of_range);
}

TEST(SlipRowsOptions, TakesTheWordsOfTheCommand) {
  SlipRowsOptions table;
  setSlipMethod(table, "register");
  EXPECT_EQ(table.pass.detector.method, SlipMethod::kRegister);
  EXPECT_FALSE(table.pass.detector.hypothesisAlarm);
  setSlipMethod(table, "contest");
  EXPECT_TRUE(table.pass.detector.hypothesisAlarm);
  EXPECT_THROW(setSlipMethod(table, "guess"), std::invalid_argument);
  setSlipReference(table, "rest");
  EXPECT_EQ(table.pass.detector.reference, SlipReference::kWhenAtRest);
  setSlipReference(table, "17");
  EXPECT_EQ(table.pass.detector.reference, SlipReference::kGiven);
  EXPECT_EQ(table.pass.referenceFrame, 17u);
  setSlipReference(table, "first");
  EXPECT_EQ(table.pass.detector.reference, SlipReference::kFirst);
  for (const char* word : {"", "-1", "1.5", "later"})
    EXPECT_THROW(setSlipReference(table, word), std::invalid_argument) << word;
}

TEST(SlipRowsOptions, NamesAFrameThatIsNotThere) {
  SlipRowsOptions table;
  setSlipReference(table, "90");
  try {
    requireThere("a.dsa", movedContact(), table);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.dsa: has no frame 90 to be the reference; it has 90");
  }
  setSlipReference(table, "89");
  EXPECT_NO_THROW(requireThere("a.dsa", movedContact(), table));
  table.matrix = 6;
  EXPECT_THROW(requireThere("a.dsa", movedContact(), table), Error);
}

}  // namespace
}  // namespace palpate::slip_rows_test
