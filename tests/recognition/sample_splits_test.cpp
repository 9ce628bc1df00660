#include "palpate/recognition/sample_splits.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::sample_splits_test {
namespace {

std::vector<int> labels(std::initializer_list<int> counts) {
  std::vector<int> y;
  int label = 0;
  for (const int count : counts) y.insert(y.end(), static_cast<std::size_t>(count), label++);
  return y;
}

void expectPartition(const SampleSplit& split, std::size_t samples) {
  std::set<std::size_t> all(split.train.begin(), split.train.end());
  all.insert(split.test.begin(), split.test.end());
  EXPECT_EQ(all.size(), samples);
  EXPECT_EQ(split.train.size() + split.test.size(), samples);
  EXPECT_TRUE(std::is_sorted(split.train.begin(), split.train.end()));
}

std::vector<std::size_t> countsOf(const std::vector<std::size_t>& part, const std::vector<int>& y) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(*std::max_element(y.begin(), y.end())) +
                                  1);
  for (const std::size_t i : part) ++counts[static_cast<std::size_t>(y[i])];
  return counts;
}

TEST(SampleSplits, ShufflesKeepTheProportionsOfClasses) {
  const auto y = labels({50, 25, 13, 12});
  for (const SampleSplit& split : stratifiedSplits(y, 20, 1)) {
    expectPartition(split, 100);
    EXPECT_EQ(split.test.size(), 20u);
    const auto counts = countsOf(split.test, y);
    EXPECT_EQ(counts[0], 10u);
    EXPECT_EQ(counts[1], 5u);
    EXPECT_EQ(counts[2], 3u) << "2.6 and 2.4: the larger remainder is rounded up";
    EXPECT_EQ(counts[3], 2u);
  }
}

TEST(SampleSplits, EqualRemaindersGoByLot) {
  // 5 of 22 are test samples: 2.5 of each class.
  const auto y = labels({11, 11});
  std::set<std::size_t> seen;
  for (const SampleSplit& split : stratifiedSplits(y, 40, 1)) {
    EXPECT_EQ(split.test.size(), 5u);
    seen.insert(countsOf(split.test, y)[0]);
  }
  EXPECT_EQ(seen, (std::set<std::size_t>{2, 3}));
}

TEST(SampleSplits, TheSeedDecides) {
  const auto y = labels({20, 20});
  const auto once = stratifiedSplits(y, 3, 7), again = stratifiedSplits(y, 3, 7),
             other = stratifiedSplits(y, 3, 8);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(once[i].test, again[i].test);
  EXPECT_NE(once[0].test, other[0].test);
  EXPECT_NE(once[0].test, once[1].test);
}

TEST(SampleSplits, ASingleSampleOnlyTeaches) {
  const auto y = labels({1, 9});
  for (const SampleSplit& split : stratifiedSplits(y, 10, 1))
    EXPECT_EQ(countsOf(split.test, y)[0], 0u);
  for (const SampleSplit& split : blockSplits(y)) EXPECT_EQ(countsOf(split.test, y)[0], 0u);
}

TEST(SampleSplits, BlocksAreContiguousAndExamineEverySampleOnce) {
  const auto y = labels({11, 10});
  const auto splits = blockSplits(y, 5);
  ASSERT_EQ(splits.size(), 5u);
  std::vector<std::size_t> testPredictions;
  for (const SampleSplit& split : splits) {
    expectPartition(split, 21);
    testPredictions.insert(testPredictions.end(), split.test.begin(), split.test.end());
    // Each class has one contiguous block.
    for (std::size_t i = 1; i < split.test.size(); ++i)
      EXPECT_TRUE(y[split.test[i]] != y[split.test[i - 1]] ||
                  split.test[i] == split.test[i - 1] + 1);
  }
  std::sort(testPredictions.begin(), testPredictions.end());
  EXPECT_EQ(testPredictions.size(), 21u);
  EXPECT_EQ(std::unique(testPredictions.begin(), testPredictions.end()), testPredictions.end());
}

TEST(SampleSplits, LeavesOneClassOut) {
  const auto splits = leaveClassOutSplits({0, 2, 2, 0, 2});
  ASSERT_EQ(splits.size(), 2u) << "class 1 has no sample";
  EXPECT_EQ(splits[0].test, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(splits[1].test, (std::vector<std::size_t>{1, 2, 4}));
}

TEST(SampleSplits, RefuseWhatCantBeSplit) {
  EXPECT_THROW(stratifiedSplits({}, 1, 1), std::invalid_argument);
  EXPECT_THROW(stratifiedSplits({0, 0}, 1, 1, 0.0), std::invalid_argument);
  EXPECT_THROW(stratifiedSplits({0, 1, 2}, 1, 1), std::invalid_argument);
  EXPECT_THROW(blockSplits({0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(blockSplits({0, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sample_splits_test
