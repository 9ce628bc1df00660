#include "palpate/signals/signal_rows.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::signal_rows_test {
namespace {

// Two frames at 1 s and 1.031 s; in the second one taxel of matrix 0 reads 16.
Profile oneTaxel() {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  builder.addFrame(1'000'000, frame.values);
  frame.matrix(0)(5, 2) = 16.0F;
  builder.addFrame(1'031'000, frame.values);
  return builder.finish({});
}

std::string rowsOf(std::optional<std::int64_t> matrix,
                   const Recipe& smooth = {},
                   bool unitsRow = false) {
  std::string rows;
  writeTableText(*signalTable(oneTaxel(), {.matrix = matrix, .smooth = smooth}),
                 {.unitsRow = unitsRow},
                 [&](const std::string& lines) { rows += lines; });
  return rows;
}

TEST(SignalRows, HaveTheColumnsOfTheHeader) {
  // All taxels of matrix 0 exist; the Gaussian spreads 16 over nine of them: 16 / 9. A taxel is
  // 3.4 mm x 3.4 mm: 11.56 mm2.
  const std::string rows = rowsOf(0);
  EXPECT_EQ(rows.rfind("frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2\n"
                       "0,1000,0,0,0,0,0,0,0,0\n1,1031,0,16,1.77",
                       0),
            0U)
      << rows;
  EXPECT_NE(rows.find(",16,16,16,1,11.5"), std::string::npos) << rows;
}

TEST(SignalRows, AreOneForEachFrameAndMatrix) {
  const std::string rows = rowsOf({});
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 2 * 6);
}

TEST(SignalRows, AreNotOfAMatrixThatIsNotThere) {
  for (const std::int64_t matrix : {-1, 6}) {
    EXPECT_THROW(signalTable(oneTaxel(), {.matrix = matrix}), std::invalid_argument);
    EXPECT_THROW(signalTable(oneTaxel(), {.matrix = matrix, .centres = true}),
                 std::invalid_argument);
  }
}

TEST(SignalRows, CanBeOfTheWholeHand) {
  const std::vector<std::string> kalman = {"kalman"};
  for (const Recipe& smooth : {Recipe(), parseRecipe(kalman)}) {
    const auto table = signalTable(oneTaxel(), {.ofHand = true, .smooth = smooth});
    std::vector<Cell> cells;
    ASSERT_TRUE(table->next(cells));
    EXPECT_EQ(numberOf(cells[7]), 0.0);
    ASSERT_TRUE(table->next(cells));
    EXPECT_EQ(numberOf(cells[2]), 6.0);  // behind the matrices 0 to 5
    EXPECT_GT(numberOf(cells[7]), 0.0);  // sum
    if (smooth.empty()) {
      EXPECT_EQ(numberOf(cells[7]), 16.0);
      EXPECT_EQ(numberOf(cells[8]), 1.0);
    }
    EXPECT_FALSE(table->next(cells));
  }
}

TEST(SignalRows, AreSmoothedOverTime) {
  const std::vector<std::string> kalman = {"kalman"};
  const std::string rows = rowsOf(0, parseRecipe(kalman));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 2);
  EXPECT_NE(rows, rowsOf(0));
  const std::vector<std::string> median = {"median"};
  EXPECT_THROW(rowsOf(0, parseRecipe(median)), std::invalid_argument);
}

// Files of other forms store a column by its kind.
TEST(SignalRows, HaveCellsOfTheKindOfTheirColumn) {
  const std::vector<std::string> kalman = {"kalman"};
  for (const Recipe& smooth : {Recipe(), parseRecipe(kalman)}) {
    const auto table = signalTable(oneTaxel(), {.smooth = smooth});
    const auto kindOf = [&](std::size_t c) { return table->columns()[c].kind; };
    EXPECT_EQ(kindOf(8), smooth.empty() ? CellKind::kInteger : CellKind::kNumber);
    for (std::vector<Cell> cells; table->next(cells);)
      for (std::size_t c = 0; c < cells.size(); ++c)
        EXPECT_EQ(std::holds_alternative<std::int64_t>(cells[c]), kindOf(c) == CellKind::kInteger)
            << table->columns()[c].name;
  }
}

TEST(SignalRows, CanBeCancelled) {
  const auto table = signalTable(oneTaxel(), {}, [](double) { return false; });
  std::vector<Cell> cells;
  EXPECT_THROW(table->next(cells), Cancelled);
}

TEST(SignalRows, HaveAUnitForEachColumn) {
  EXPECT_NE(rowsOf(0, {}, true).find("\n,ms,,counts,counts,counts,counts,counts,taxels,mm^2\n"),
            std::string::npos);
  EXPECT_EQ(columnNamed(signalColumns("kPa"), "max").column.unit, "kPa");
  EXPECT_EQ(columnNamed(signalColumns("kPa"), "active").column.unit, "taxels");
}

// Two taxels, x, y, z each, over a baseline of 1 everywhere: 3, -2, 60 and 1, 0, -4.
Profile threeAxes() {
  MatrixLayout matrix = MatrixLayout::full(1, 2, 2.0);
  matrix.touch = {.components = 3, .isSigned = true, .threshold = 2.0F};
  ProfileBuilder builder(std::make_shared<SensorLayout>(std::vector{matrix}));
  const std::vector<float> readings = {4.0F, -1.0F, 61.0F, 2.0F, 1.0F, -3.0F};
  builder.addReadings(1'000'000, readings);
  const Baseline rest{.rest = std::vector<float>(6, 1.0F), .noise = {}};
  return builder.finish({}).withBaselines({{0, std::make_shared<const Baseline>(rest)}});
}

std::string csvOf(const Profile& profile, const SignalRowsOptions& options = {}) {
  std::string rows;
  writeTableText(
      *signalTable(profile, options), {}, [&](const std::string& text) { rows += text; });
  return rows;
}

TEST(SignalRows, OfReadingsHaveTheSumsOfTheComponents) {
  EXPECT_EQ(signalColumns("counts", true).size(), 11U);
  EXPECT_EQ(columnNamed(signalColumns("kPa", true), "norm").column.unit, "kPa");
  // The magnitudes of z are 60 and 4; x = 3 + 1, y = -2, z = 60 - 4, and sqrt(16 + 4 + 3136).
  const std::string rows = csvOf(threeAxes());
  EXPECT_NE(rows.find("area_mm2,x,y,z,norm\n"), std::string::npos) << rows;
  EXPECT_NE(rows.find(",4,60,64,2,8,4,-2,56,56.17"), std::string::npos) << rows;
  // Signs stay where the signals are filtered; one frame is its own filtered value.
  const std::string smoothed =
      csvOf(threeAxes(), {.smooth = parseRecipe(std::vector<std::string>{"kalman"})});
  EXPECT_NE(smoothed.find(",4,-2,56,56.17"), std::string::npos) << smoothed;
  // A filtered frame has no readings any more.
  const std::vector<std::string> median = {"median"};
  const std::string filtered = csvOf(filteredProfile(threeAxes(), parseRecipe(median)));
  EXPECT_EQ(std::count(filtered.begin(), filtered.end(), ','), 2 * 9) << filtered;
}

}  // namespace
}  // namespace palpate::signal_rows_test
