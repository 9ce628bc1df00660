#include "palpate/core/ordered_work.h"

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::ordered_work_test {
namespace {

TEST(OrderedWork, FinishesInOrderOnTheGiversThread) {
  for (const std::size_t threads : {0, 1, 5})
    for (const std::size_t mostPieces : {0, 1, 7}) {
      const auto giver = std::this_thread::get_id();
      std::atomic<int> worked = 0;
      std::vector<int> finished;
      std::vector<int> expected(200);
      std::iota(expected.begin(), expected.end(), 0);
      OrderedWork work(threads, mostPieces);
      for (const int i : expected) {
        work.add([&worked] { ++worked; },
                 [&finished, giver, i] {
                   EXPECT_EQ(std::this_thread::get_id(), giver);
                   finished.push_back(i);
                 });
        EXPECT_LE(static_cast<std::size_t>(i) + 1 - finished.size(), mostPieces);
      }
      work.finishAll();
      EXPECT_EQ(finished, expected);
      EXPECT_EQ(worked, 200);
    }
}

TEST(OrderedWork, AFailureIsThrownInItsPlaceAndStays) {
  for (const std::size_t threads : {0, 2}) {
    int finished = 0;
    OrderedWork work(threads, 10);
    const auto finish = [&finished] { ++finished; };
    work.add([] {}, finish);
    work.add([] { throw std::runtime_error("a piece"); }, finish);
    work.add([] {}, finish);
    for (int i = 0; i < 2; ++i) {
      EXPECT_THROW(work.finishAll(), std::runtime_error);
      EXPECT_EQ(finished, 1);
    }
  }
}

TEST(OrderedWork, WhatCouldNotBeFinishedIsTriedAgain) {
  int tries = 0;
  OrderedWork work(1, 10);
  work.add([] {},
           [&tries] {
             if (++tries == 1) throw std::runtime_error("the disk is full");
           });
  EXPECT_THROW(work.finishAll(), std::runtime_error);
  work.finishAll();
  EXPECT_EQ(tries, 2);
}

TEST(OtherThreads, AreOneLessThanAllAndNeverBelowNone) {
  EXPECT_EQ(otherThreads(1), 0u);
  EXPECT_EQ(otherThreads(5), 4u);
  EXPECT_LT(otherThreads(0), 1u << 20);
}

}  // namespace
}  // namespace palpate::ordered_work_test
