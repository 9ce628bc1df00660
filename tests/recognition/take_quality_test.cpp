#include "palpate/recognition/take_quality.h"

#include <array>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"

namespace palpate::take_quality_test {
namespace {

// A recording with a frame every 50 ms: nothing, then `touched` frames in which ten taxels of every
// matrix read `counts`, then nothing.
class Take {
 public:
  Take() : builder_(sdh2()) {}
  Take& frames(int count, float counts = 0.0F) {
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    if (counts > 0.0F)
      for (std::size_t i = 0; i < values.size(); i += 8) values[i] = counts;
    for (int i = 0; i < count; ++i) builder_.addFrame(timeUs_ += 50'000, values);
    return *this;
  }
  Take& pause(double seconds) {
    timeUs_ += static_cast<std::int64_t>(seconds * 1e6);
    return *this;
  }
  Profile finish() { return builder_.finish({}); }

 private:
  ProfileBuilder builder_;
  std::int64_t timeUs_ = 1'700'000'000'000'000;
};

TakeQuality check(const Profile& profile,
                  std::int64_t lost = 0,
                  const TakeCheckOptions& options = {}) {
  return checkTake(std::array{profile}, lost, options);
}

TEST(TakeQuality, AGoodTakeHasNoProblem) {
  const TakeQuality take = check(Take().frames(20).frames(60, 800.0F).frames(21).finish());
  EXPECT_TRUE(take.good()) << take.problem();
  EXPECT_EQ(take.problem(), "");
  EXPECT_EQ(take.frames, 101u);
  EXPECT_NEAR(take.durationS, 5.0, 1e-9);
  EXPECT_TRUE(take.touched);
  // The same force in every frame, both ends inside: the best quality.
  ASSERT_TRUE(take.graspQuality);
  EXPECT_NEAR(*take.graspQuality, 1.0, 1e-6);
}

TEST(TakeQuality, EverythingThatIsWrongIsSaidInOneLine) {
  const TakeQuality take =
      check(Take().frames(5).pause(2.95).frames(5).finish(), 7, {.leastS = 5.0});
  EXPECT_EQ(take.problem(),
            "nothing was touched; only 3.4 s long, not 5.0 s; 1 gap of 3.0 s; 7 frames lost");
  EXPECT_FALSE(take.graspQuality);
}

TEST(TakeQuality, AFewActiveTaxelsAreNoContact) {
  EXPECT_FALSE(check(Take().frames(20).frames(2, 500.0F).frames(20).finish()).touched)
      << "two frames";
}

TEST(TakeQuality, SaturationIsAFractionOfTheFrames) {
  // sdh2: 3500 counts are saturated.
  const Profile profile = Take().frames(50).frames(40, 800.0F).frames(10, 3500.0F).finish();
  const TakeQuality take = check(profile);
  EXPECT_DOUBLE_EQ(take.saturated, 0.1);
  EXPECT_EQ(take.problem(), "saturated in 10 % of the frames");
  EXPECT_TRUE(check(profile, 0, {.mostSaturated = 0.1}).good());
}

// Half of the frames of the grasp are saturated, else it is held steadily: quality 1/2 and less.
TEST(TakeQuality, AGraspCanBeAskedFor) {
  const Profile half =
      Take().frames(50).frames(20, 3400.0F).frames(20, 3500.0F).frames(10).finish();
  const double quality = check(half).graspQuality.value();
  EXPECT_LT(quality, 0.55);
  const TakeQuality bad = check(half, 0, {.mostSaturated = 1.0, .leastQuality = 0.6});
  EXPECT_TRUE(bad.problem().starts_with("quality 0.") && bad.problem().ends_with(", not 0.60"))
      << bad.problem();
  EXPECT_TRUE(check(half, 0, {.mostSaturated = 1.0, .leastQuality = 0.3}).good());
  // Three frames are a contact, and no grasp.
  const TakeQuality none =
      check(Take().frames(20).frames(4, 500.0F).frames(40).finish(), 0, {.leastQuality = 0.1});
  EXPECT_EQ(none.problem(), "no grasp");
  EXPECT_THROW(checkTake({}, 0, {.leastQuality = 1.5}), std::invalid_argument);
}

TEST(TakeQuality, PartsAreOneTake) {
  const std::array parts{Take().frames(41).finish(), Take().frames(41, 800.0F).finish()};
  const TakeQuality take = checkTake(parts, 0, {.leastS = 3.9});
  EXPECT_TRUE(take.good()) << take.problem();
  EXPECT_NEAR(take.durationS, 4.0, 1e-9);
  EXPECT_FALSE(checkTake({}, 0).good()) << "no recording";
}

TEST(TakeQuality, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(checkTake({}, 0, {.leastS = -1.0}), std::invalid_argument);
  EXPECT_THROW(checkTake({}, 0, {.mostLost = -1}), std::invalid_argument);
  EXPECT_THROW(checkTake({}, 0, {.mostSaturated = 1.5}), std::invalid_argument);
  EXPECT_THROW(checkTake({}, 0, {.contact = {.taxels = 0}}), std::invalid_argument);
}

TEST(TakeQuality, CancelledItThrows) {
  const std::array parts{Take().frames(40).finish()};
  EXPECT_THROW(checkTake(parts, 0, {}, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::take_quality_test
