#include "palpate/recognition/grasp_segments.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::grasp_segments_test {
namespace {

constexpr std::int64_t kStepUs = 40'000;

// One letter per frame: '.' nothing, 'a' finger 0 alone, 'b' fingers 0 and 2, 'p' proximal of 0 and
// distal of 1, 's' as b, saturated, 'm' matrices 1 and 5 with finger 1. '|': a gap of ten seconds.
Profile profileOf(const std::string& letters, double sum = 100.0) {
  ProfileBuilder builder(sdh2().layout);
  std::int64_t nowUs = 1'400'000'000'000'000;
  for (const char letter : letters) {
    if (letter == '|') {
      nowUs += 10'000'000;
      continue;
    }
    TactileFrame frame(sdh2().layout);
    const auto half = static_cast<float>(sum / 2);
    if (letter == 'a') frame.matrix(1)(5, 2) = half;
    if (letter == 'b' || letter == 'm' || letter == 's') {
      frame.matrix(1)(5, 2) = letter == 's' ? 3500.0F : half;
      frame.matrix(5)(5, 2) = half;
    }
    if (letter == 'm') frame.matrix(3)(2, 2) = 1.0F;
    if (letter == 'p') {
      frame.matrix(0)(5, 2) = half;
      frame.matrix(3)(5, 2) = half;
    }
    builder.addFrame(nowUs, frame.values);
    nowUs += kStepUs;
  }
  return builder.finish({});
}

std::string times(const char* letters, int n) {
  std::string out;
  for (int i = 0; i < n; ++i) out += letters;
  return out;
}

TEST(GraspSegments, AreWhereTwoFingersTouchLongEnough) {
  const Profile profile = profileOf("....." + times("b", 21) + "....." + times("a", 30) + "....." +
                                    times("p", 25) + ".");
  const auto grasps = findGrasps(profile);
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[0], (GraspSegment{5, 25, {0, 2}, 1.0})) << "steady, whole: quality 1";
  EXPECT_EQ(grasps[1].begin, 66u);
  EXPECT_EQ(grasps[1].end, 90u);
  EXPECT_EQ(grasps[1].fingers, (std::vector<int>{0, 1})) << "proximal or distal";
}

TEST(GraspSegments, TwentyFramesAreTooFew) {
  EXPECT_TRUE(findGrasps(profileOf("." + times("b", 20) + ".")).empty());
  EXPECT_EQ(findGrasps(profileOf("." + times("b", 21) + ".")).size(), 1u);
}

TEST(GraspSegments, LastLongerThanSixTenthsOfASecond) {
  // 30 frames at 75 Hz are 0.39 s, 50 are 0.65 s.
  for (const auto& [frames, found] : {std::pair(30, 0u), {50, 1u}}) {
    ProfileBuilder builder(sdh2().layout);
    for (int i = 0; i < 100; ++i) {
      TactileFrame frame(sdh2().layout);
      if (i >= 10 && i < 10 + frames) {
        frame.matrix(1)(5, 2) = 50.0F;
        frame.matrix(5)(5, 2) = 50.0F;
      }
      builder.addFrame(i * 13'333, frame.values);
    }
    const Profile profile = builder.finish({});
    EXPECT_EQ(findGrasps(profile).size(), found) << frames;
    EXPECT_EQ(findGrasps(profile, {.rule = GraspRule::kStudy}).size(), 1u) << "counts frames alone";
  }
}

TEST(GraspSegments, UpToThreeFramesAreBridged) {
  const std::string part = times("b", 12);
  const auto bridged = findGrasps(profileOf("." + part + "..." + part + "."));
  ASSERT_EQ(bridged.size(), 1u);
  EXPECT_EQ(bridged[0].begin, 1u);
  EXPECT_EQ(bridged[0].end, 27u);
  EXPECT_TRUE(findGrasps(profileOf("." + part + "...." + part + ".")).empty());
  EXPECT_TRUE(
      findGrasps(profileOf("." + part + "." + part + "."), {.rule = GraspRule::kStudy}).empty());
}

TEST(GraspSegments, AGapOfTheRecordingEndsThem) {
  const auto grasps = findGrasps(profileOf("." + times("b", 30) + "|" + times("b", 40) + "."));
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[0].end, 30u);
  EXPECT_EQ(grasps[1].begin, 31u);
  EXPECT_DOUBLE_EQ(grasps[0].quality, 0.5) << "one end lies beside the gap";
}

TEST(GraspSegments, OfTheStudyAreMatricesOneAndFive) {
  const Profile profile = profileOf("." + times("p", 30) + "." + times("m", 30) + ".");
  EXPECT_EQ(findGrasps(profile).size(), 1u) << "a frame without contact between them is bridged";
  const auto study = findGrasps(profile, {.rule = GraspRule::kStudy});
  ASSERT_EQ(study.size(), 1u);
  EXPECT_EQ(study[0].begin, 32u);
  EXPECT_EQ(study[0].fingers, (std::vector<int>{0, 1, 2}));
}

TEST(GraspSegments, QualityIsWhatItSays) {
  const auto quality = [](const std::string& letters) {
    const auto grasps = findGrasps(profileOf(letters, 200.0));
    return grasps.size() == 1 ? grasps[0].quality : -1.0;
  };
  EXPECT_DOUBLE_EQ(quality("." + times("b", 40) + "."), 1.0);
  EXPECT_DOUBLE_EQ(quality(times("b", 40) + "."), 0.5);
  EXPECT_DOUBLE_EQ(quality(times("b", 40)), 0.25);
  // Two frames are bridged in the first quarter, which does not affect the steadiness of the middle
  // half.
  EXPECT_DOUBLE_EQ(quality(".bb..." + times("b", 35) + "."), 37.0 / 40.0);
  // Saturated in the first ten of 40 frames.
  EXPECT_DOUBLE_EQ(quality("." + times("s", 10) + times("b", 30) + "."), 30.0 / 40.0);
}

TEST(GraspSegments, AnUnsteadySumCostsQuality) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 42; ++i) {
    TactileFrame frame(sdh2().layout);
    if (i > 0 && i < 41) {  // alternates between 100 and 300: mean 200, sd 100
      frame.matrix(1)(5, 2) = i % 2 == 0 ? 50.0F : 150.0F;
      frame.matrix(5)(5, 2) = i % 2 == 0 ? 50.0F : 150.0F;
    }
    builder.addFrame(i * kStepUs, frame.values);
  }
  const auto grasps = findGrasps(builder.finish({}));
  ASSERT_EQ(grasps.size(), 1u);
  EXPECT_NEAR(grasps[0].quality, 0.5, 1e-9);
}

TEST(GraspSegments, FromTheTableAreTheSame) {
  const Profile profile = synthesize({.durationS = 40.0, .grasps = 5, .noiseCounts = 10.0});
  const auto read = findGrasps(profile);
  EXPECT_EQ(read.size(), 5u);
  EXPECT_EQ(findGrasps(profile, SignalTable::of(profile), timingOf(profile)), read);
  EXPECT_THROW(findGrasps(profile, SignalTable(), timingOf(profile)), std::invalid_argument);
}

TEST(GraspSegments, OfSyntheticRecordingsLieWhereTheirTruthIs) {
  SyntheticTruth truth;
  const Profile profile = synthesize({.durationS = 40.0, .grasps = 6}, &truth);
  const auto grasps = findGrasps(profile);
  ASSERT_EQ(grasps.size(), truth.grasps.size());
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    EXPECT_NEAR(
        static_cast<double>(grasps[i].begin), static_cast<double>(truth.grasps[i].begin), 3);
    EXPECT_NEAR(static_cast<double>(grasps[i].end), static_cast<double>(truth.grasps[i].end), 3);
    EXPECT_EQ(grasps[i].fingers, (std::vector<int>{0, 2}));
  }
}

TEST(GraspSegments, OddRecordings) {
  EXPECT_TRUE(findGrasps(profileOf("")).empty());
  EXPECT_TRUE(findGrasps(profileOf("b")).empty());
  // Three seconds between frames are no gap if all frames are that far apart.
  ProfileBuilder slow(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  frame.matrix(1)(5, 2) = 50.0F;
  frame.matrix(5)(5, 2) = 50.0F;
  for (int i = 0; i < 25; ++i) slow.addFrame(i * 3'000'000, frame.values);
  EXPECT_EQ(findGrasps(slow.finish({})).size(), 1u);
  // Each pad without a finger counts as a finger.
  auto pads = std::make_shared<SensorLayout>(
      std::vector{MatrixLayout::full(4, 4, 3.4), MatrixLayout::full(4, 4, 3.4)});
  ProfileBuilder two(pads);
  TactileFrame both(pads);
  both.matrix(0)(1, 1) = both.matrix(1)(1, 1) = 9.0F;
  for (int i = 0; i < 30; ++i) two.addFrame(i * kStepUs, both.values);
  const Profile onPads = two.finish({});
  ASSERT_EQ(findGrasps(onPads).size(), 1u);
  EXPECT_EQ(findGrasps(onPads)[0].fingers, (std::vector<int>{0, 1}));
  EXPECT_TRUE(findGrasps(onPads, {.rule = GraspRule::kStudy, .studyMatrices = {1, 5}}).empty())
      << "has no matrix 5";
  EXPECT_THROW(findGrasps(onPads, {.rule = GraspRule::kStudy}), Error) << "no pads that pinch";
  // A single pad: no second finger is waited for.
  ProfileBuilder one(builtInHand("flat_pad_16x16"));
  std::vector<float> touched(256, 0.0F);
  touched[100] = 9.0F;
  for (int i = 0; i < 30; ++i) one.addFrame(i * kStepUs, touched);
  EXPECT_EQ(findGrasps(one.finish({})).size(), 1u);
}

TEST(GraspSegments, OfASensorWithManyPadsCountEveryPad) {
  const auto pads =
      std::make_shared<SensorLayout>(std::vector<MatrixLayout>(70, MatrixLayout::full(2, 2, 3.4)));
  ProfileBuilder builder(pads);
  for (int i = 0; i < 40; ++i) {
    TactileFrame frame(pads);
    if (i >= 5 && i < 35) frame.matrix(68)(0, 1) = frame.matrix(69)(1, 1) = 9.0F;
    builder.addFrame(i * kStepUs, frame.values);
  }
  const auto grasps = findGrasps(builder.finish({}));
  ASSERT_EQ(grasps.size(), 1u);
  EXPECT_EQ(grasps[0], (GraspSegment{5, 34, {68, 69}, 1.0}));
}

TEST(GraspSegments, OfAMaskedMatrixAreThoseOfTheOthers) {
  // The distal matrix of finger 0 is not scanned and gives no values; fingers 1 and 2 continue the
  // contact.
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  std::fill(matrices[1].dynamicMask.begin(), matrices[1].dynamicMask.end(), std::uint8_t{0});
  const auto layout = std::make_shared<SensorLayout>(matrices);
  ProfileBuilder builder(layout);
  for (int i = 0; i < 40; ++i) {
    TactileFrame frame(layout);
    if (i >= 5 && i < 35) frame.matrix(3)(6, 2) = frame.matrix(5)(6, 2) = 80.0F;
    builder.addFrame(i * kStepUs, frame.values);
  }
  const Profile profile = builder.finish({});
  ASSERT_EQ(findGrasps(profile).size(), 1u);
  EXPECT_EQ(findGrasps(profile)[0].fingers, (std::vector<int>{1, 2}));
  EXPECT_TRUE(findGrasps(profile, {.rule = GraspRule::kStudy}).empty());
}

TEST(GraspSegments, RefusesATableOfAnotherSensor) {
  const Profile profile = profileOf(times("b", 30));
  const auto pad =
      std::make_shared<SensorLayout>(std::vector<MatrixLayout>(7, MatrixLayout::full(2, 2, 3.4)));
  ProfileBuilder other(pad);
  for (int i = 0; i < 30; ++i) other.addFrame(i * kStepUs, TactileFrame(pad).values);
  EXPECT_THROW(findGrasps(profile, SignalTable::of(other.finish({})), timingOf(profile)),
               std::invalid_argument);
}

TEST(GraspSegments, RefusesBadOptionsAndCanBeCancelled) {
  const Profile profile = profileOf(times("b", 30));
  EXPECT_THROW(findGrasps(profile, {.minFingers = 0}), std::invalid_argument);
  EXPECT_THROW(findGrasps(profile, {.moreThanS = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(findGrasps(profile, {}, [](double) { return false; }), Cancelled);
}

// Segments of all shared grasps by the script of the study: exactly one per file.
TEST(GraspSegments, OfTheStudyAgreeWithTheGoldenOnes) {
  const auto golden = testing::goldenFolder();
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(golden);
  PALPATE_NEED(folder);
  std::ifstream in(*golden / "grasp_features.csv");
  std::string line;
  std::getline(in, line);
  int compared = 0;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string name, file, begin, end;
    std::getline(cells, name, ',');
    std::getline(cells, file, ',');
    std::getline(cells, begin, ',');
    std::getline(cells, end, ',');
    if (!std::filesystem::exists(*folder / file)) continue;
    const auto grasps = findGrasps(openRecording(*folder / file), {.rule = GraspRule::kStudy});
    ASSERT_EQ(grasps.size(), 1u) << file;
    EXPECT_EQ(std::to_string(grasps[0].begin), begin) << file;
    EXPECT_EQ(std::to_string(grasps[0].end), end) << file;
    ++compared;
  }
  EXPECT_GE(compared, 571);
}

// Grasps of several recordings, counted by an independent program (bz2, ElementTree, the rules as
// they are written). Over all 609 shared recordings it agrees with this program in every frame and
// finger.
TEST(GraspSegments, OfRealRecordingsAreThoseOfAnIndependentCount) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  struct Expected {
    const char* file;
    std::size_t general;
    std::size_t study;
    std::size_t begin;  // of the last one, `general`
    std::size_t end;
    double quality;
  };
  for (const Expected& expected : {
           Expected{"grasps/foam_ball.dsa", 10, 10, 2735, 2964, 0.9774406652814076},
           Expected{"grasps/hockey_ball.dsa", 15, 15, 2898, 2994, 0.9629557672122525},
           Expected{"classification_video/pen_thick.dsa", 17, 17, 1862, 1905, 0.9195651669768982},
           Expected{"classification_video/utah_teapot.dsa", 16, 16, 2072, 2119, 0.9078563651936047},
           Expected{"slip-detection/slip_test.dsa", 15, 15, 5222, 5249, 0.7678897072527066},
           Expected{"misc/reactive_grasping.dsa", 1, 0, 179, 238, 0.4858980799217745},
           Expected{"calibration_noise/temperature-noise.dsa", 1, 1, 0, 1296, 0.2467370395714707},
           Expected{"calibration_sensitivity/sensitivity_0.1-1.0.dsa", 0, 0, 0, 0, 0.0},
       }) {
    SCOPED_TRACE(expected.file);
    const Profile profile = openRecording(*folder / expected.file);
    const auto grasps = findGrasps(profile);
    ASSERT_EQ(grasps.size(), expected.general);
    EXPECT_EQ(findGrasps(profile, SignalTable::of(profile), timingOf(profile)), grasps);
    EXPECT_EQ(findGrasps(profile, {.rule = GraspRule::kStudy}).size(), expected.study);
    if (grasps.empty()) continue;
    EXPECT_EQ(grasps.back().begin, expected.begin);
    EXPECT_EQ(grasps.back().end, expected.end);
    EXPECT_NEAR(grasps.back().quality, expected.quality, 1e-12);
  }
}

}  // namespace
}  // namespace palpate::grasp_segments_test
