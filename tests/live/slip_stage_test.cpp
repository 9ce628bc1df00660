#include "palpate/live/slip_stage.h"

#include <memory>
#include <stdexcept>

#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/live/processing_chain.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::slip_stage_test {
namespace {

// 3 s of rest on matrix 3, then a slip of 0.25 taxel per frame over 12 frames, then rest again.
Profile slipOnce() {
  SyntheticSensor sensor;
  sensor.layout = sdh2().layout->matrix(3);
  SyntheticSlip slip(sensor, 5);
  SyntheticContact contact;
  contact.shape = SlipShape::kFlatEllipse;
  contact.y = 4.0;
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 200; ++i) {
    if (i >= 95 && i < 107) contact.y += 0.25;
    TactileFrame frame(sdh2().layout);
    slip.read(contact, frame.matrix(3));
    builder.addFrame(1'400'000'000'000'000 + 31'500 * i, frame.values);
  }
  return builder.finish({});
}

struct Found {
  std::vector<std::vector<SlipDetection>> detections;
  std::vector<Event> events;
};

Found processed(const Profile& profile,
                const std::function<void(SlipStage&)>& prepare = {},
                const std::function<void(SlipStage&, std::size_t)>& before = {},
                std::vector<Event> events = {}) {
  auto stage = std::make_unique<SlipStage>(sdh2());
  SlipStage& slip = *stage;
  if (prepare) prepare(slip);
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::move(stage));
  Found found;
  ChainOptions options;
  options.onResults = [&](const LiveResults& results) {
    found.detections.push_back(results.slip);
    if (before) before(slip, found.detections.size());
  };
  options.onEvent = [&](const Event& event) { found.events.push_back(event); };
  ProcessingChain(std::move(stages), options).runOver(profile, std::move(events));
  return found;
}

TEST(SlipStage, ShowsTheVectorOfEveryMatrixAndTellsOfSlip) {
  const Profile profile = slipOnce();
  const Found found = processed(profile);
  ASSERT_EQ(found.detections.size(), 200U);
  ASSERT_EQ(found.detections[50].size(), 6U);
  EXPECT_EQ(found.detections[50][0].motion.active, 0);
  EXPECT_TRUE(found.detections[50][3].motion.valid);
  EXPECT_FALSE(found.detections[90][3].slipping);
  EXPECT_NEAR(found.detections[100][3].motion.dy, 0.25, 0.1);
  EXPECT_TRUE(found.detections[104][3].slipping);
  EXPECT_FALSE(found.detections[199][3].slipping);
  ASSERT_EQ(found.events.size(), 2U);
  const Event& begins = found.events[0];
  EXPECT_EQ(begins.kind, "slip");
  EXPECT_EQ(begins.matrix, 3);
  EXPECT_EQ(begins.tUs, begins.t1Us);
  EXPECT_GE(begins.tUs, profile.frameTimeUs(95));
  EXPECT_LE(begins.tUs, profile.frameTimeUs(104));
  const Event& ends = found.events[1];
  EXPECT_EQ(ends.tUs, begins.tUs);
  EXPECT_GT(ends.t1Us, profile.frameTimeUs(106));
  EXPECT_GT(Json::parse(ends.json).at("dy_taxels").asDouble(), 1.0);
}

// The slip lasts from frame 95 to 106.
TEST(SlipStage, DoesNotTellOfSlipWhileTheHandLetsGo) {
  const auto at = [](int frame, const std::string& json) {
    const std::int64_t tUs = 1'400'000'000'000'000 + 31'500 * frame - 1;
    return Event{tUs, tUs, "grasp", {}, "opening", json};
  };
  const Event begins = at(80, R"({"mode":"plain","preshape":"centrical","close":0})");
  const Event ends =
      at(90, R"({"mode":"plain","preshape":"centrical","close":0,"outcome":"finished"})");
  const Event closes = at(90, R"({"mode":"plain","preshape":"centrical","close":1})");
  const Profile profile = slipOnce();
  const Found opening = processed(profile, {}, {}, {begins});
  EXPECT_TRUE(opening.events.empty());
  for (int frame = 95; frame < 120; ++frame) {
    const SlipDetection& here = opening.detections[static_cast<std::size_t>(frame)][3];
    EXPECT_FALSE(here.slipping || here.alarm);
    EXPECT_EQ(here.indicator, SlipIndicator::kNotComputable) << "no lamp is red";
  }
  EXPECT_TRUE(opening.detections[100][3].motion.valid) << "the motion is measured nevertheless";
  // Changed settings don't end the opening; what slipped before its end is not told after it.
  Event settings = at(92, {});
  settings.kind = "settings";
  Event ended = ends;
  ended.tUs = ended.t1Us = at(104, {}).tUs;
  EXPECT_TRUE(processed(profile, {}, {}, {begins, settings}).events.empty());
  EXPECT_TRUE(processed(profile, {}, {}, {begins, ended}).events.empty());
  EXPECT_EQ(processed(profile, {}, {}, {begins, ends}).events.size(), 2U);
  // The end of the opening was not received before another source begins.
  const auto before = [&](SlipStage& slip) { slip.onEvent(begins); };
  EXPECT_EQ(processed(profile, before).events.size(), 2U);
  EXPECT_EQ(processed(profile, {}, {}, {begins, closes}).events.size(), 2U);
  EXPECT_EQ(processed(profile, {}, {}, {at(80, "[")}).events.size(), 2U) << "no event of ours";
}

// As a scene of the emulated hand does, without an event.
TEST(SlipStage, DoesNotTellOfSlipWhileTheHandOpensByItself) {
  const auto slips = [](int first, int last) {
    int frame = 0;
    return processed(slipOnce(),
                     [&](SlipStage& stage) {
                       stage.opensByItself = [&frame, first, last] {
                         const int now = frame++;
                         return now >= first && now <= last;
                       };
                     })
        .events.size();
  };
  EXPECT_EQ(slips(80, 120), 0U);
  EXPECT_EQ(slips(80, 104), 0U) << "what slipped before the end is not told after it";
  EXPECT_EQ(slips(60, 70), 2U);
}

TEST(SlipStage, ReferenceIsTakenFromTheNextFrame) {
  const Found found = processed(slipOnce(), {}, [](SlipStage& stage, std::size_t frames) {
    if (frames == 101) stage.setReference(3);
  });
  EXPECT_NEAR(found.detections[102][3].motion.refDy, 0.25, 0.12);
  EXPECT_NEAR(found.detections[103][3].motion.refDy, 0.5, 0.15);
}

TEST(SlipStage, OtherOptionsBeginAnew) {
  const Found found = processed(slipOnce(), {}, [](SlipStage& stage, std::size_t frames) {
    if (frames != 50) return;
    SlipDetectorOptions options = stage.options();
    options.method = SlipMethod::kRegister;
    stage.setOptions(options);
  });
  EXPECT_TRUE(found.detections[49][3].motion.valid);
  EXPECT_FALSE(found.detections[50][3].motion.valid);
  EXPECT_TRUE(found.detections[51][3].motion.valid);
  SlipStage stage(sdh2());
  EXPECT_EQ(stage.options().method, SlipMethod::kCentroid);
  SlipDetectorOptions wrong;
  wrong.tracker.saturationCounts = -1.0;
  EXPECT_THROW(stage.setOptions(wrong), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::slip_stage_test
