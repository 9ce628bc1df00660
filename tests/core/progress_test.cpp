#include "palpate/core/progress.h"

#include <vector>

#include "testing/testing.h"

namespace palpate::progress_test {
namespace {

TEST(ProgressSteps, ReportsEverySoManySteps) {
  std::vector<double> said;
  const Progress progress = [&](double fraction) {
    said.push_back(fraction);
    return true;
  };
  for (std::size_t i = 0; i < 8; ++i) reportProgress(progress, i, 8, 3);
  EXPECT_EQ(said, (std::vector{0.0, 0.375, 0.75}));
  said.clear();
  for (std::size_t i = 0; i < 2; ++i) reportProgress(progress, i, 2);
  EXPECT_EQ(said, (std::vector{0.0, 0.5}));
}

TEST(ProgressSteps, StopsWhereItIsAsked) {
  const Progress never = [](double) { return false; };
  EXPECT_THROW(reportProgress(never, 0, 8, 3), Cancelled);
  EXPECT_NO_THROW(reportProgress(never, 1, 8, 3));  // not asked
}

TEST(ProgressSteps, NobodyNeedsToListen) { EXPECT_NO_THROW(reportProgress({}, 0, 8)); }

TEST(PartOf, OutlivesTheWhole) {
  std::vector<double> said;
  Progress part;
  {
    const Progress whole = [&](double fraction) {
      said.push_back(fraction);
      return true;
    };
    part = partOf(partOf(whole, 0.5, 1.0), 0.0, 0.5);
  }
  EXPECT_TRUE(part(1.0));
  EXPECT_EQ(said, std::vector{0.75});
}

}  // namespace
}  // namespace palpate::progress_test
