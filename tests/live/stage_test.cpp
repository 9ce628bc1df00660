// Tests of the guarantees to a stage: all items, in order of time, from one thread; and of what a
// stage may do.
#include "palpate/live/stage.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/live/processing_chain.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::stage_test {
namespace {
using testing::ScriptedSession;

// Stores the items that it receives.
class NotingStage final : public Stage {
 public:
  explicit NotingStage(std::vector<std::string>& notes) : notes_(notes) {}
  void reset() override { notes_.push_back("reset"); }
  void onFrame(LiveResults& results, std::vector<Event>& out) override {
    notes_.push_back("frame " + std::to_string(testing::numberOf(*results.frame)) +
                     (results.angles ? " angles" : "") +
                     (results.temperatures ? " temperatures" : ""));
    if (testing::numberOf(*results.frame) == 2)
      out.push_back({results.frame->hostUs, results.frame->hostUs, "slip", 1, "slips", ""});
  }
  void onSample(const Sample& sample) override {
    notes_.push_back(sample.series == kAngleSeries ? "angles" : "temperatures");
  }
  void onEvent(const Event& event) override { notes_.push_back(event.kind); }

 private:
  std::vector<std::string>& notes_;
};

// Doubles a result of the stage before it.
class DoublingStage final : public Stage {
 public:
  void onFrame(LiveResults& results, std::vector<Event>&) override { results.peak.counts *= 2.0F; }
};
class ConstantStage final : public Stage {
 public:
  void onFrame(LiveResults& results, std::vector<Event>&) override { results.peak.counts = 21.0F; }
};

class ThrowingStage final : public Stage {
 public:
  void onFrame(LiveResults&, std::vector<Event>&) override {
    throw std::runtime_error("the stage broke");
  }
};

template <typename... Stages>
std::vector<std::unique_ptr<Stage>> stagesOf(Stages... stages) {
  std::vector<std::unique_ptr<Stage>> all;
  (all.push_back(std::move(stages)), ...);
  return all;
}

TEST(Stage, IsToldEverythingInOrderOfTime) {
  std::vector<std::string> notes;
  std::vector<Event> found;
  ChainOptions options;
  options.onEvent = [&](const Event& event) { found.push_back(event); };
  ScriptedSession scripted;
  ProcessingChain chain(stagesOf(std::make_unique<NotingStage>(notes)), options);
  chain.connect(*scripted.session);
  const std::int64_t t = testing::kWallStartUs;
  // Not in order of time, as two ports may deliver them.
  scripted.device->frame(1, t + 2'000);
  scripted.device->angles(0, t + 1'000);
  scripted.device->temperatures(30.0, t + 2'000);
  scripted.session->note({t + 2'000, t + 2'000, "settings", {}, "changed", ""});
  scripted.device->frame(2, t + 4'000);
  scripted.device->angles(1, t + 3'000);
  EXPECT_EQ(chain.step(), 2u);
  EXPECT_EQ(notes,
            (std::vector<std::string>{"reset",
                                      "angles",
                                      "settings",
                                      "temperatures",
                                      "frame 1 angles temperatures",
                                      "angles",
                                      "frame 2 angles temperatures"}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, "slip");
  EXPECT_EQ(found[0].matrix, 1);
}

TEST(Stage, SeesWhatTheStagesBeforeItFound) {
  ScriptedSession scripted;
  ProcessingChain chain(
      stagesOf(std::make_unique<ConstantStage>(), std::make_unique<DoublingStage>()));
  chain.connect(*scripted.session);
  scripted.device->frame(1, testing::kWallStartUs);
  chain.step();
  EXPECT_EQ(chain.take()->peak.counts, 42.0F);
}

TEST(Stage, ThatThrowsEndsTheProcessingAndSaysWhy) {
  ScriptedSession scripted;
  ProcessingChain chain(stagesOf(std::make_unique<ThrowingStage>()));
  chain.connect(*scripted.session);
  scripted.device->frame(1, testing::kWallStartUs);
  chain.run({});  // returns by itself
  EXPECT_EQ(chain.failure(), "the stage broke");
  // The device is not affected.
  scripted.device->frame(2, testing::kWallStartUs + 10'000);
  EXPECT_EQ(testing::numberOf(*scripted.session->takeFrame()), 2u);
}

}  // namespace
}  // namespace palpate::stage_test
