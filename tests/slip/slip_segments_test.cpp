#include "palpate/slip/slip_segments.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/slip/slip_rows.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"

namespace palpate::slip_segments_test {
namespace {

SlipDetection stateTextOf(bool slipping, double dx = 0.0) {
  SlipDetection detection;
  detection.slipping = slipping;
  detection.motion.active = 9;
  detection.motion.valid = true;
  detection.motion.dx = dx;
  detection.confidence = 0.7;
  return detection;
}

TEST(SlipSegmenter, BridgesShortPausesAndAddsTheWay) {
  SlipSegmenter segmenter(1, 2);
  const std::string pattern = "..##..###...#..";  // 2 between: one; 3 between: two
  for (std::size_t i = 0; i < pattern.size(); ++i)
    segmenter.add(i, static_cast<std::int64_t>(i) * 1000, {stateTextOf(pattern[i] == '#', 0.5)});
  const auto segments = segmenter.segments();
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].begin, 2U);
  EXPECT_EQ(segments[0].end, 8U);
  EXPECT_EQ(segments[0].endUs, 8000);
  EXPECT_DOUBLE_EQ(segments[0].pathTaxels, 3.5);  // seven frames
  EXPECT_DOUBLE_EQ(segments[0].confidence, 0.7);
  EXPECT_EQ(segments[1].begin, 12U);
  EXPECT_EQ(segments[1].end, 12U);
}

TEST(SlipSegmenter, LostContactEndsASegment) {
  SlipSegmenter segmenter(2, 5);
  segmenter.add(0, 0, {stateTextOf(true), stateTextOf(false)});
  SlipDetection lost;
  segmenter.add(1, 1, {lost, stateTextOf(true)});
  segmenter.add(2, 2, {stateTextOf(true), stateTextOf(true)});
  const auto segments = segmenter.segments();
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_EQ(segments[0].matrix, 0U);
  EXPECT_EQ(segments[1].matrix, 1U);
  EXPECT_EQ(segments[1].end, 2U);
  EXPECT_EQ(segments[2].begin, 2U);
}

// Matrix 1 slips by 2 taxels between frames 50 and 60, matrix 3 rests.
Profile slipping() {
  ProfileBuilder builder(sdh2().layout);
  SyntheticSensor sensor;
  sensor.layout = sdh2().layout->matrix(1);
  SyntheticSlip slip(sensor, 1);
  std::int64_t nowUs = 1'400'000'000'000'000;
  for (int i = 0; i < 90; ++i) {
    TactileFrame frame(sdh2().layout);
    slip.read({.y = 4.5 + 0.2 * std::clamp(i - 50, 0, 10)}, frame.matrix(1));
    slip.read({}, frame.matrix(3));
    builder.addFrame(nowUs += 31'500, frame.values);
  }
  return builder.finish({});
}

TEST(FindSlips, FindsTheSlipOfAProfile) {
  const auto segments = findSlips(slipping());
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].matrix, 1U);
  EXPECT_GE(segments[0].begin, 51U);
  EXPECT_LE(segments[0].begin, 53U);
  EXPECT_GE(segments[0].end, 60U);
  EXPECT_LE(segments[0].end, 75U);
  EXPECT_GT(segments[0].pathTaxels, 1.2);
  EXPECT_LT(segments[0].pathTaxels, 2.4);
}

TEST(PassSlip, TakesTheFrameThatIsGivenAsReference) {
  SlipRunOptions options;
  options.detector.reference = SlipReference::kGiven;
  options.referenceFrame = 45;
  double before = -1.0, at = -1.0, after = 0.0;
  runSlipDetector(slipping(), options, [&](std::size_t i, std::int64_t, const auto& detections) {
    if (i == 44) before = detections[1].motion.refValid ? 1.0 : 0.0;
    if (i == 45) at = detections[1].motion.refDy;
    if (i == 89) after = detections[1].motion.refDy;
  });
  EXPECT_EQ(before, 0.0);
  EXPECT_EQ(at, 0.0);
  EXPECT_NEAR(after, 2.0, 0.1);
  options.referenceFrame = 90;
  EXPECT_THROW(runSlipDetector(slipping(), options, [](auto, auto, const auto&) {}),
               std::invalid_argument);
  EXPECT_THROW(findSlips(slipping(), {}, [](double) { return false; }), Cancelled);
}

// The results of each frame as text, with all digits.
std::vector<std::string> rowsOf(const Profile& profile,
                                const SlipRunOptions& options,
                                UnreadableSamples* unreadable = nullptr) {
  std::vector<std::string> rows;
  runSlipDetector(
      profile,
      options,
      [&](std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections) {
        std::string& row = rows.emplace_back(std::to_string(frame) + " " + std::to_string(timeUs));
        RowTable<SlipDetection> table("", slipColumns(), detections);
        writeTableText(table, {}, [&](const std::string& text) { row += text; });
      },
      {},
      unreadable);
  return rows;
}

TEST(PassSlip, GivesTheSameOnSeveralThreads) {
  for (const SlipReference reference :
       {SlipReference::kFirst, SlipReference::kWhenAtRest, SlipReference::kGiven})
    for (const bool isDamaged : {false, true}) {
      SlipRunOptions options;
      options.detector.reference = reference;
      options.referenceFrame = 44;
      const Profile profile = isDamaged ? testing::withDamage(slipping(), 45, 46) : slipping();
      UnreadableSamples one, several;
      const std::vector<std::string> expected = rowsOf(profile, options, &one);
      options.threads = 3;
      EXPECT_EQ(rowsOf(profile, options, &several), expected);
      EXPECT_EQ(several.count, one.count);
    }
}

TEST(PassSlip, SeveralThreadsReadMoreThanABlock) {
  const Profile profile = synthesize({.durationS = 90.0, .grasps = 3, .noiseCounts = 4.0});
  ASSERT_GT(profile.numFrames(), 2100U);
  const std::vector<std::string> expected = rowsOf(profile, {});
  EXPECT_EQ(rowsOf(profile, {.threads = 0}), expected);
}

// The rows in front of the frame are there, as with one thread.
TEST(PassSlip, SeveralThreadsThrowAtTheFrameThatCannotBeRead) {
  const Profile damaged = testing::withDamage(slipping(), 45, 46);
  SlipRun run(damaged, {.threads = 2});
  for (std::size_t i = 0; i < 45; ++i) {
    ASSERT_TRUE(run.next());
    EXPECT_EQ(run.frame(), i);
  }
  EXPECT_THROW(run.next(), Error);
  EXPECT_THROW(run.next(), Error);
}

// Without it nothing would be compared with a reference, and no row would say so.
TEST(PassSlip, SaysWhenTheReferenceCannotBeRead) {
  SlipRunOptions options;
  options.detector.reference = SlipReference::kGiven;
  options.referenceFrame = 45;
  const Profile damaged = testing::withDamage(slipping(), 45, 46);
  UnreadableSamples unreadable;
  try {
    runSlipDetector(
        damaged, options, [](auto, auto, const auto&) {}, {}, &unreadable);
    ADD_FAILURE() << "the reference was left out";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "the reference frame can't be read: x.palpate: block 7 is damaged");
  }
  options.referenceFrame = 44;
  runSlipDetector(
      damaged, options, [](auto, auto, const auto&) {}, {}, &unreadable);
  EXPECT_EQ(unreadable.count, 2U);
}

}  // namespace
}  // namespace palpate::slip_segments_test
