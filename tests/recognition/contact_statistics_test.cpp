#include "palpate/recognition/contact_statistics.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"

namespace palpate::contact_statistics_test {
namespace {

constexpr std::size_t kPlaces = 256;

const HandDescription& pad() { return builtInHand("flat_pad_16x16"); }

GraspSegment whole(const Profile& profile) {
  return {.begin = 0, .end = profile.numFrames() - 1, .fingers = {}};
}

// Frames of a pad: the load of the taxels in turn.
Profile padProfile(const std::vector<std::vector<float>>& frames) {
  ProfileBuilder builder(pad());
  std::int64_t us = 0;
  for (const std::vector<float>& values : frames) builder.addFrame(us += 10'000, values);
  return builder.finish({});
}

std::map<std::string, double> named(const HandDescription& hand, const ContactStatistics& found) {
  const auto names = contactStatisticsNames(hand);
  std::map<std::string, double> values;
  EXPECT_EQ(names.size(), found.values.size());
  for (std::size_t i = 0; i < std::min(names.size(), found.values.size()); ++i)
    values[names[i]] = found.values[i];
  return values;
}

// Two taxels in a row with loads 100 and 300, by hand: centroid 0.75 of the way, second moment
// 0.25 * 0.75 along the columns, none along the rows.
TEST(ContactStatistics, AreThoseOfTheDefinition) {
  std::vector<float> values(kPlaces, 0.0F);
  values[16 * 3 + 6] = 100.0F;
  values[16 * 3 + 7] = 300.0F;
  const Profile profile = padProfile(std::vector<std::vector<float>>(5, values));
  const ContactStatistics found = contactStatistics(profile, whole(profile));
  EXPECT_EQ(found.problem, "");
  auto of = named(pad(), found);
  const auto fullScale = static_cast<double>(pad().maximumCounts);
  EXPECT_NEAR(of["ln_sum"], std::log(400.0 / fullScale + 0.001), 1e-6);
  EXPECT_NEAR(of["ln_peak"], std::log(300.0 / fullScale + 0.001), 1e-6);
  EXPECT_NEAR(of["ln_active"], std::log(3.0), 1e-12);
  EXPECT_EQ(of["touched"], 1.0);
  EXPECT_NEAR(of["m0_share"], 1.0, 1e-12);
  EXPECT_NEAR(of["m0_active"], 2.0 / 256.0, 1e-12);
  EXPECT_NEAR(of["m0_column"], 2.0 * 6.75 / 15.0 - 1.0, 1e-6);
  EXPECT_NEAR(of["m0_row"], 2.0 * 3.0 / 15.0 - 1.0, 1e-6);
  EXPECT_NEAR(of["m0_major"], std::log(0.1875 / 0.15 + 1.0), 1e-6);
  EXPECT_NEAR(of["m0_minor"], 0.0, 1e-9);
}

// Each matrix counts in relation to its own full scale: 100 of 1000 on one pad is as much as 25 of
// 250 on the other.
TEST(ContactStatistics, AreRelativeToTheFullScaleOfEachMatrix) {
  HandDescription hand = describeHand(
      SensorLayout({MatrixLayout::full(1, 2, 1.0), MatrixLayout::full(1, 2, 1.0)}), 0, 0);
  hand.maximumCounts = hand.saturationCounts = 1000.0F;
  hand.matrices[1].maximumCounts = 250.0F;
  ProfileBuilder builder(hand);
  for (std::int64_t us = 0; us < 50'000; us += 10'000)
    builder.addFrame(us, std::vector{100.0F, 0.0F, 25.0F, 0.0F});
  const Profile profile = builder.finish({});
  auto of = named(hand, contactStatistics(profile, whole(profile)));
  EXPECT_NEAR(of["ln_sum"], std::log(0.2 + 0.001), 1e-6);
  EXPECT_NEAR(of["ln_peak"], std::log(0.1 + 0.001), 1e-6);
  EXPECT_NEAR(of["m0_share"], 0.5, 1e-6);
  EXPECT_NEAR(of["m1_share"], 0.5, 1e-6);
}

// Frames below nine tenths of the largest load don't count.
TEST(ContactStatistics, AreThoseOfThePlateau) {
  std::vector<float> low(kPlaces, 0.0F), high(kPlaces, 0.0F);
  low[0] = 400.0F;
  high[255] = 1000.0F;
  const Profile profile = padProfile({low, high, high, low});
  const ContactStatistics found = contactStatistics(profile, whole(profile));
  EXPECT_EQ(found.startFrame, 0u) << "400 is more than a quarter of 1000";
  EXPECT_EQ(found.plateauEndFrame, 2u);
  auto of = named(pad(), found);
  EXPECT_NEAR(of["m0_column"], 1.0, 1e-9);
  EXPECT_NEAR(of["m0_row"], 1.0, 1e-9);
}

TEST(ContactStatistics, AMatrixWithoutContactIsAllZero) {
  const HandDescription& hand = builtInHand("four_fingers");
  ProfileBuilder builder(hand);
  std::vector<float> values(hand.layout->numCells(), 0.0F);
  values[hand.layout->offset(2)] = 50.0F;
  builder.addFrame(1000, values);
  const Profile profile = builder.finish({});
  auto of = named(hand, contactStatistics(profile, whole(profile)));
  EXPECT_NEAR(of["m2_share"], 1.0, 1e-12);
  for (const char* what : {"share", "active", "column", "row", "major", "minor"})
    EXPECT_EQ(of[std::string("m1_") + what], 0.0) << what;
}

TEST(ContactStatistics, WhatCannotBeComputedIsSaid) {
  const Profile empty = padProfile({std::vector<float>(kPlaces, 0.0F)});
  EXPECT_EQ(contactStatistics(empty, whole(empty)).problem, "no load");
  EXPECT_TRUE(contactStatistics(empty, whole(empty)).values.empty());
  EXPECT_THROW(contactStatistics(empty, {.begin = 0, .end = 1, .fingers = {}}), std::out_of_range);
}

}  // namespace
}  // namespace palpate::contact_statistics_test
