#include "palpate/signals/first_contact.h"

#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::first_contact_test {
namespace {

// Frames 100 ms apart with that many active taxels in row 7 on of matrix 1.
Profile withActive(const std::vector<int>& active) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < active.size(); ++i) {
    TactileFrame frame(sdh2().layout);
    for (int k = 0; k < active[i]; ++k) frame.matrix(1)(4 + k / 4, k % 4 + 1) = 50.0F;
    builder.addFrame(1'400'000'000'000'000 + static_cast<std::int64_t>(i) * 100'000, frame.values);
  }
  return builder.finish({});
}

TEST(FirstContact, IsTheFirstOfThreeFramesInARow) {
  const std::vector<int> active = {0, 3, 3, 2, 0, 3, 5, 4, 0};
  EXPECT_EQ(firstContact(active), 5u);
  EXPECT_EQ(firstContact(withActive(active)), 5u);
}

TEST(FirstContact, MayBeTheFirstFrame) {
  EXPECT_EQ(firstContact(std::vector<int>{3, 3, 3}), 0u);
  EXPECT_EQ(firstContact(withActive({9, 9, 9, 0})), 0u);
}

TEST(FirstContact, IsMissingWhereTouchesAreShortOrSmall) {
  EXPECT_EQ(firstContact(std::vector<int>{}), std::nullopt);
  EXPECT_EQ(firstContact(std::vector<int>{3, 3}), std::nullopt);
  EXPECT_EQ(firstContact(std::vector<int>{2, 2, 2, 2, 2}), std::nullopt);
  EXPECT_EQ(firstContact(std::vector<int>{4, 4, 0, 4, 4, 0, 4, 4}), std::nullopt);
  EXPECT_EQ(firstContact(withActive({})), std::nullopt);
  EXPECT_EQ(firstContact(withActive({0, 1, 2, 2, 2, 1})), std::nullopt);
}

TEST(FirstContact, FramesOnBothSidesOfAGapAreNotInARow) {
  const std::vector<int> active = {0, 4, 4, 4, 4, 4};
  const std::vector<std::size_t> gaps = {2};
  EXPECT_EQ(firstContact(active, gaps), 3u);
  EXPECT_EQ(firstContact(withActive(active), gaps), 3u);
  EXPECT_EQ(firstContact(active, std::vector<std::size_t>{0, 1, 2, 3, 4}), std::nullopt);
}

TEST(FirstContact, OptionsSayHowManyFramesAndTaxels) {
  const std::vector<int> active = {1, 0, 4, 4, 0, 2, 2, 2, 2};
  EXPECT_EQ(firstContact(active, {}, {.frames = 1, .taxels = 1}), 0u);
  EXPECT_EQ(firstContact(active, {}, {.frames = 2, .taxels = 4}), 2u);
  EXPECT_EQ(firstContact(active, {}, {.frames = 4, .taxels = 2}), 5u);
  EXPECT_THROW(firstContact(active, {}, {.frames = 0}), std::invalid_argument);
  EXPECT_THROW(firstContact(active, {}, {.taxels = -1}), std::invalid_argument);
}

TEST(FirstContact, OverAllMatricesButNotWhatIsMasked) {
  std::vector<MatrixLayout> matrices = {MatrixLayout::full(2, 2, 3.4),
                                        MatrixLayout::full(1, 2, 3.4)};
  matrices[0].dynamicMask[3] = 0;
  const auto layout = std::make_shared<const SensorLayout>(matrices);
  ProfileBuilder builder(layout);
  // Two in the first matrix, one in the second; then one of the three where nothing is scanned.
  for (int i = 0; i < 3; ++i)
    builder.addFrame(1'000 + i, std::vector<float>{5.0F, 5.0F, 0.0F, 0.0F, 0.0F, 5.0F});
  const Profile both = builder.finish({});
  EXPECT_EQ(firstContact(both), 0u);
  ProfileBuilder masked(layout);
  for (int i = 0; i < 3; ++i)
    masked.addFrame(1'000 + i, std::vector<float>{5.0F, 5.0F, 0.0F, 5.0F, 0.0F, 0.0F});
  EXPECT_EQ(firstContact(masked.finish({})), std::nullopt);
}

TEST(FirstContact, CanBeCancelled) {
  EXPECT_THROW(firstContact(withActive({0, 0, 0}), {}, {}, [](double) { return false; }),
               Cancelled);
}

TEST(FirstContactOfRealGrasps, NothingLastsBeforeIt) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  int seen = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(*folder / "grasps_by_class" / "dice_large")) {
    const Profile profile = openRecording(entry.path());
    const auto contact = firstContact(profile);
    ASSERT_TRUE(contact) << entry.path();
    // Counted once more, value by value.
    const auto touches = [&](std::size_t frame) {
      int active = 0;
      for (const float value : profile.frame(frame).values) active += value > 0.0F ? 1 : 0;
      return active >= 3;
    };
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(touches(*contact + i)) << entry.path();
    for (std::size_t i = 0; i < *contact; ++i)
      EXPECT_FALSE(touches(i) && touches(i + 1) && touches(i + 2)) << entry.path() << " " << i;
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace palpate::first_contact_test
