#include "palpate/core/latest_value.h"

#include <atomic>
#include <thread>

#include "testing/testing.h"

namespace palpate::latest_value_test {
namespace {

TEST(LatestValue, GivesTheNewestOnceAndCountsWhatWasSkipped) {
  LatestValue<int> box;
  EXPECT_EQ(box.take(), std::nullopt);
  box.put(1);
  box.put(2);
  box.put(3);
  EXPECT_EQ(box.take(), 3);
  EXPECT_EQ(box.take(), std::nullopt);
  EXPECT_EQ(box.stats().puts, 3u);
  EXPECT_EQ(box.stats().takes, 1u);
  EXPECT_EQ(box.stats().skipped, 2u);
}

TEST(LatestValue, AccountsForEveryValueBetweenThreads) {
  constexpr int kValues = 20'000;
  LatestValue<int> box;
  std::atomic<bool> done = false;
  std::jthread writer([&] {
    for (int i = 1; i <= kValues; ++i) box.put(i);
    done = true;
  });
  int last = 0;
  while (last < kValues) {
    if (const auto value = box.take()) {
      ASSERT_GT(*value, last);  // never an older value after a newer one
      last = *value;
    }
  }
  writer.join();
  EXPECT_EQ(box.stats().takes + box.stats().skipped, box.stats().puts);
}

}  // namespace
}  // namespace palpate::latest_value_test
