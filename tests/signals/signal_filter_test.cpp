#include "palpate/signals/signal_filter.h"

#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/filter/kalman.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::signal_filter_test {
namespace {

Recipe recipeOf(const std::string& text) { return parseRecipe(std::vector<std::string>{text}); }

std::vector<CharacteristicSignals> rowsAt(std::size_t i) {
  std::vector<CharacteristicSignals> rows(2);
  rows[0].mean = static_cast<double>(i * i % 97);
  rows[1].maximum = static_cast<double>(i * 7 % 31);
  rows[1].active = static_cast<int>(i % 5);
  return rows;
}

TEST(SignalFilter, SmoothsEverySignalAsASeriesOfItsOwn) {
  std::vector<std::vector<SignalValues>> got;
  SignalFilter filter(
      recipeOf("kalman"), 2, [&](std::int64_t us, std::span<const SignalValues> rows) {
        EXPECT_EQ(us, static_cast<std::int64_t>(got.size() + 1) * 30'000);
        got.emplace_back(rows.begin(), rows.end());
      });
  std::vector<double> means;
  std::vector<double> maxima;
  std::vector<double> actives;
  for (std::size_t i = 0; i < 60; ++i) {
    const auto rows = rowsAt(i);
    means.push_back(rows[0].mean);
    maxima.push_back(rows[1].maximum);
    actives.push_back(rows[1].active);
    filter.push(static_cast<std::int64_t>(i + 1) * 30'000, rows);
  }
  filter.finish();
  ASSERT_EQ(got.size(), 60u);
  const auto expectedMeans = kalmanFiltered(means);
  const auto expectedMaxima = kalmanFiltered(maxima);
  const auto expectedActives = kalmanFiltered(actives);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_NEAR(got[i][0][0], expectedMeans[i], 1e-4) << i;
    EXPECT_NEAR(got[i][1][2], expectedMaxima[i], 1e-4) << i;
    EXPECT_NEAR(got[i][1][5], expectedActives[i], 1e-4) << i;
    EXPECT_EQ(got[i][0][2], 0.0);
  }
}

TEST(SignalFilter, WhatNeedsLaterFramesComesAtTheEnd) {
  std::size_t came = 0;
  SignalFilter filter(
      recipeOf("rts"), 1, [&](std::int64_t, std::span<const SignalValues>) { ++came; });
  for (std::size_t i = 0; i < 20; ++i)
    filter.push(static_cast<std::int64_t>(i) * 30'000, std::vector<CharacteristicSignals>(1));
  EXPECT_EQ(came, 0u);
  filter.finish();
  EXPECT_EQ(came, 20u);
}

TEST(SignalFilter, RefusesFiltersOverSpace) {
  const auto emit = [](std::int64_t, std::span<const SignalValues>) {};
  for (const char* text : {"median", "gaussian", "median3d", "min-median", "kalman | box"})
    EXPECT_THROW(SignalFilter(recipeOf(text), 1, emit), std::invalid_argument) << text;
  EXPECT_NO_THROW(SignalFilter(recipeOf("kalman | (box)"), 1, emit));
  SignalFilter filter(recipeOf("kalman"), 2, emit);
  EXPECT_THROW(filter.push(0, std::vector<CharacteristicSignals>(3)), std::invalid_argument);
}

TEST(RequireBelowHalfRate, NamesTheFile) {
  ProfileBuilder builder(
      std::make_shared<const SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)}));
  for (std::int64_t i = 0; i < 4; ++i)
    builder.addFrame((i + 1) * 100'000, std::vector<float>{1.0F});
  const Profile profile = builder.finish({});  // 10 frames/s
  EXPECT_NO_THROW(requireBelowHalfRate(recipeOf("low-pass:cutoff=4"), profile, "a.dsa"));
  try {
    requireBelowHalfRate(recipeOf("low-pass:cutoff=6"), profile, "a.dsa");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("a.dsa: ")) << error.what();
  }
}

}  // namespace
}  // namespace palpate::signal_filter_test
