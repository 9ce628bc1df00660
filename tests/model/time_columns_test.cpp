#include "palpate/model/time_columns.h"

#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/matrix_rows.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::time_columns_test {
namespace {

// 2014-05-13 16:53:20 UTC, and 31.25 ms later.
Profile twoFrames() {
  ProfileBuilder builder(sdh2().layout);
  const TactileFrame frame(sdh2().layout);
  builder.addFrame(1'400'000'000'000'000, frame.values);
  builder.addFrame(1'400'000'000'031'250, frame.values);
  return builder.finish({});
}

std::string textOf(TimeColumn which) {
  using Row = MatrixRow<int>;
  auto rows = std::make_unique<RowTable<Row>>(
      "rows", matrixRowColumns<int>({}), std::vector<Row>{{1, 1'400'000'000'031'250, 3, 0}});
  std::string text;
  writeTableText(*withTimeColumns(std::move(rows), twoFrames(), which),
                 {.unitsRow = true},
                 [&](const std::string& lines) { text += lines; });
  return text;
}

TEST(TimeColumns, StandBehindTheMilliseconds) {
  EXPECT_EQ(textOf(TimeColumn::kSeconds),
            "frame,time_ms,time_s,matrix\n,ms,s,\n1,1400000000031,0.031250,3\n");
  EXPECT_EQ(
      textOf(TimeColumn::kUtc),
      "frame,time_ms,time_utc,matrix\n,ms,,\n1,1400000000031,2014-05-13T16:53:20.031250Z,3\n");
}

TEST(TimeColumns, NeedATime) {
  auto none =
      std::make_unique<RowTable<int>>("none", std::vector<ColumnOf<int>>(), std::vector<int>());
  EXPECT_THROW(withTimeColumns(std::move(none), twoFrames(), TimeColumn::kUtc),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::time_columns_test
