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

TEST(SlipRows, AreOneForEachFrameAndMatrixWithAContact) {
  std::size_t rows = 0, cells = 0;
  std::string first;
  forEachSlipRow(movedContact(), {}, {}, [&](const std::string& row) {
    if (rows++ == 0) first = row;
    cells = static_cast<std::size_t>(std::count(row.begin(), row.end(), ','));
  });
  EXPECT_EQ(rows, 2U * 90U);
  EXPECT_EQ(first.rfind("0,1031,1,", 0), 0U) << first;
  const std::string columns = kSlipColumns;
  EXPECT_EQ(cells, static_cast<std::size_t>(std::count(columns.begin(), columns.end(), ',')));
  std::size_t ofOne = 0;
  forEachSlipRow(movedContact(), {}, 3, [&](const std::string& row) {
    ofOne += row.find(",3,") != std::string::npos ? 1 : 0;
  });
  EXPECT_EQ(ofOne, 90U);
}

TEST(SlipRows, OfSlipsAreOneForEachSlip) {
  std::string rows;
  forEachSlipSegmentRow(
      movedContact(), {}, {}, [&](const std::string& row) { rows += row + "\n"; });
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1) << rows;
  EXPECT_EQ(std::count(rows.begin(), rows.end(), ','), 7) << rows;
  std::size_t ofThree = 0;
  forEachSlipSegmentRow(movedContact(), {}, 3, [&](const std::string&) { ++ofThree; });
  EXPECT_EQ(ofThree, 0U);
}

TEST(SlipRows, LeaveUnknownCellsEmpty) {
  std::string row = "x";
  appendSlipCell(row, false, 1.5);
  appendSlipCell(row, true, 1.5);
  EXPECT_EQ(row, "x,,1.5");
}

TEST(SlipRows, HaveAUnitForEachColumn) {
  const auto cells = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(cells(kSlipUnits), cells(kSlipColumns));
  EXPECT_EQ(cells(kSlipSegmentUnits), cells(kSlipSegmentColumns));
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
