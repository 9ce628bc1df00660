#include "palpate/core/parallel.h"

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

namespace palpate::parallel_test {
namespace {

TEST(Parallel, EveryPieceIsDoneOnce) {
  for (const std::size_t threads : {0, 1, 2, 7}) {
    std::vector<int> times(1000, 0);
    forEachInParallel(
        times.size(), [&](std::size_t i) { ++times[i]; }, {}, threads);
    EXPECT_EQ(times, std::vector<int>(1000, 1)) << threads;
  }
  forEachInParallel(0, [](std::size_t) { FAIL(); });
}

TEST(Parallel, ProgressRisesInTheCallersThread) {
  const auto caller = std::this_thread::get_id();
  double last = -1.0;
  forEachInParallel(
      50,
      [](std::size_t) {},
      [&](double fraction) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        return true;
      },
      3);
  EXPECT_GE(last, 0.0);
}

TEST(Parallel, CancellingBeginsNoFurtherPiece) {
  std::atomic<std::size_t> begun = 0;
  std::atomic<bool> cancelled = false;
  EXPECT_THROW(forEachInParallel(
                   1'000'000,
                   [&](std::size_t) {
                     ++begun;
                     while (begun > 100 && !cancelled) std::this_thread::yield();
                   },
                   [&](double fraction) {
                     if (fraction > 0.0) cancelled = true;
                     return fraction == 0.0;
                   },
                   2),
               Cancelled);
  EXPECT_LT(begun, 1'000'000u);
  EXPECT_THROW(forEachInParallel(
                   3, [](std::size_t) { FAIL(); }, [](double) { return false; }),
               Cancelled);
}

TEST(Parallel, TheErrorOfAPieceArrives) {
  for (const std::size_t threads : {1, 4}) {
    try {
      forEachInParallel(
          100,
          [](std::size_t i) {
            if (i == 17) throw std::runtime_error("piece " + std::to_string(i));
          },
          {},
          threads);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "piece 17");
    }
  }
  EXPECT_THROW(forEachInParallel(
                   100,
                   [](std::size_t) {},
                   [](double) -> bool { throw std::logic_error("of the progress"); },
                   2),
               std::logic_error);
}

}  // namespace
}  // namespace palpate::parallel_test
