#include "palpate/live/processing_chain.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "palpate/capture/replay.h"
#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/live/signals_stage.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/characteristic_signals.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::processing_chain_test {
namespace {
using testing::ScriptedSession;

std::vector<std::unique_ptr<Stage>> signalsOnly() {
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<SignalsStage>());
  return stages;
}

void append(std::string& bytes, double value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

// All results of a frame as bytes, for an exact comparison.
std::string bitsOf(const LiveResults& results) {
  std::string bytes;
  append(bytes, static_cast<double>(results.frame->hostUs));
  for (const CharacteristicSignals& s : results.matrixSignals)
    for (const double value :
         {s.mean, s.filteredMean, s.minimum, s.maximum, s.sum, s.areaMm2, double(s.active)})
      append(bytes, value);
  append(bytes, static_cast<double>(results.peak.matrix));
  append(bytes, results.peak.row);
  append(bytes, results.peak.column);
  append(bytes, static_cast<double>(results.peak.counts));
  append(bytes, results.angles ? static_cast<double>(results.angles->hostUs) : -1.0);
  if (results.angles)
    for (const double deg : results.angles->values) append(bytes, deg);
  append(bytes, results.temperatures ? static_cast<double>(results.temperatures->hostUs) : -1.0);
  return bytes;
}

// C-A14: reported to the caller; on the chain's thread the exception would end the process.
TEST(ProcessingChain, IsNotStartedWithoutASession) {
  ProcessingChain chain(signalsOnly());
  EXPECT_THROW(chain.start(), std::logic_error);
  chain.stop();
}

std::vector<std::string> offline(const Profile& profile) {
  std::vector<std::string> found;
  ChainOptions options;
  options.onResults = [&](const LiveResults& results) { found.push_back(bitsOf(results)); };
  ProcessingChain chain(signalsOnly(), options);
  chain.runOver(profile);
  return found;
}

std::vector<std::string> replayed(const Profile& profile, std::size_t waitingFrames) {
  std::vector<std::string> found;
  std::atomic<std::size_t> count = 0;
  ChainOptions options;
  options.lossless = true;
  options.waitingFrames = waitingFrames;
  options.onResults = [&](const LiveResults& results) {
    found.push_back(bitsOf(results));
    ++count;
  };
  ReplayOptions fast;
  fast.pace = ReplayPace::kUnpaced;
  CaptureSession session(std::make_unique<Replay>(profile, fast));
  ProcessingChain chain(signalsOnly(), options);
  chain.connect(session);
  chain.start();
  session.start();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (count < profile.numFrames() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  chain.stop();
  session.stop();
  EXPECT_EQ(chain.stats().skipped, 0u);
  EXPECT_EQ(chain.stats().frames, profile.numFrames());
  EXPECT_EQ(chain.failure(), "");
  return found;
}

void expectSame(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i], b[i]) << "frame " << i;
}

// R17; the values equal those of the offline table.
void expectDeterministic(const Profile& profile) {
  const auto expected = offline(profile);
  ASSERT_EQ(expected.size(), profile.numFrames());
  expectSame(offline(profile), expected);
  expectSame(replayed(profile, 16), expected);
  expectSame(replayed(profile, 1), expected);
  const SignalTable table = SignalTable::of(profile);
  std::size_t frame = 0;
  ChainOptions options;
  options.onResults = [&](const LiveResults& results) {
    for (std::size_t m = 0; m < table.numMatrices(); ++m) {
      ASSERT_EQ(results.matrixSignals.at(m).filteredMean, table.at(frame, m).filteredMean);
      ASSERT_EQ(results.matrixSignals.at(m).sum, table.at(frame, m).sum);
    }
    ++frame;
  };
  ProcessingChain chain(signalsOnly(), options);
  chain.runOver(profile);
  EXPECT_EQ(frame, profile.numFrames());
}

TEST(ProcessingChain, ReplayAndOfflineGiveTheSameBits) {
  SyntheticOptions options;
  options.durationS = 20.0;
  options.noiseCounts = 8.0;
  expectDeterministic(synthesize(options));
}

TEST(ProcessingChain, ReplayAndOfflineGiveTheSameBitsForARealRecording) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  expectDeterministic(openRecording(*folder / "grasps" / "foam_ball.dsa"));
}

TEST(ProcessingChain, CountsWhatItSkipsAndTellsTheStages) {
  struct Gaps final : Stage {
    explicit Gaps(std::vector<Event>& all) : gaps(all) {}
    void onFrame(LiveResults&, std::vector<Event>&) override {}
    void onEvent(const Event& event) override {
      if (event.kind == "gap") gaps.push_back(event);
    }
    std::vector<Event>& gaps;
  };
  std::vector<Event> gaps;
  auto stages = signalsOnly();
  stages.push_back(std::make_unique<Gaps>(gaps));
  ChainOptions options;
  options.waitingFrames = 8;
  ScriptedSession scripted;
  ProcessingChain chain(std::move(stages), options);
  chain.connect(*scripted.session);
  const auto stamp = [](std::size_t n) {
    return testing::kWallStartUs + static_cast<std::int64_t>(n) * 10'000;
  };
  // frames arrive while nothing is processed
  for (std::size_t n = 0; n < 20; ++n) scripted.device->frame(n, stamp(n));
  EXPECT_EQ(chain.step(), 8u);
  for (std::size_t n = 20; n < 25; ++n) scripted.device->frame(n, stamp(n));
  EXPECT_EQ(chain.step(), 5u);
  EXPECT_EQ(chain.stats().frames, 13u);
  EXPECT_EQ(chain.stats().skipped, 12u);
  EXPECT_EQ(testing::numberOf(*chain.take()->frame), 24u);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].tUs, stamp(8));
  EXPECT_EQ(gaps[0].t1Us, stamp(19));
}

TEST(ProcessingChain, HandsOutTheNewestResultsOnce) {
  ScriptedSession scripted;
  ProcessingChain chain(signalsOnly());
  chain.connect(*scripted.session);
  EXPECT_FALSE(chain.take().has_value());
  for (std::size_t n = 1; n <= 3; ++n)
    scripted.device->frame(n, testing::kWallStartUs + static_cast<std::int64_t>(n));
  chain.step();
  EXPECT_EQ(testing::numberOf(*chain.take()->frame), 3u);
  EXPECT_FALSE(chain.take().has_value());
}

TEST(ProcessingChain, OutlivesItsSessionAndTakesAnotherOne) {
  ProcessingChain chain(signalsOnly());
  {
    ScriptedSession first;
    chain.connect(*first.session);
    first.device->frame(1, testing::kWallStartUs);
    chain.step();
  }
  chain.run({});  // ends: the source is closed
  EXPECT_EQ(chain.stats().frames, 1u);
  ScriptedSession second;
  chain.connect(*second.session);
  EXPECT_FALSE(chain.take().has_value());
  second.device->frame(7, testing::kWallStartUs);
  chain.step();
  EXPECT_EQ(chain.stats().frames, 1u);
  EXPECT_EQ(testing::numberOf(*chain.take()->frame), 7u);
}

TEST(ProcessingChain, IsCancelledOffline) {
  SyntheticOptions options;
  options.durationS = 20.0;
  ProcessingChain chain(signalsOnly());
  EXPECT_THROW(chain.runOver(synthesize(options), {}, [](double done) { return done < 0.3; }),
               Cancelled);
  EXPECT_GT(chain.stats().frames, 0u);
  EXPECT_LT(chain.stats().frames, 600u);
}

TEST(ProcessingChain, RefusesNothingToDo) {
  EXPECT_THROW(ProcessingChain({}), std::invalid_argument);
  ChainOptions none;
  none.waitingFrames = 0;
  EXPECT_THROW(ProcessingChain(signalsOnly(), none), std::invalid_argument);
  ProcessingChain chain(signalsOnly());
  EXPECT_THROW(chain.step(), std::logic_error);
}

TEST(ProcessingChain, ResultsHaveTheLastSamplesOfFurtherSeries) {
  const Profile profile = testing::withWrist(synthesize({.durationS = 1.0, .grasps = 0}), 10);
  std::size_t frames = 0;
  ChainOptions options;
  options.onResults = [&](const LiveResults& results) {
    const std::int64_t sinceUs = results.frame->hostUs - profile.frameTimeUs(0) - 30'000;
    ++frames;
    ASSERT_EQ(results.further.size(), sinceUs < 0 ? 0u : 1u);
    if (sinceUs < 0) return;
    EXPECT_EQ(*results.further[0].series, testing::wristSeries());
    EXPECT_EQ(results.further[0].sample.values.at(0),
              static_cast<double>(std::min<std::int64_t>(sinceUs / 50'000, 9)) + 0.5);
  };
  ProcessingChain chain(signalsOnly(), options);
  chain.runOver(profile);
  EXPECT_EQ(frames, profile.numFrames());
}

// The columns of a live source may be known only at its first row.
TEST(ProcessingChain, ASeriesThatNobodyDescribesHasNumbersForNames) {
  ScriptedSession scripted;
  std::vector<SeriesDescription> described;
  ChainOptions options;
  options.furtherSeries = [&] { return described; };
  ProcessingChain chain(signalsOnly(), options);
  chain.connect(*scripted.session);
  const std::int64_t t = 1'400'000'000'000'000;
  const auto deliver = [&](int i, std::vector<double> values) {
    scripted.device->sink->onSample({t + i * 30'000, std::move(values), kHandSeries + 1});
    scripted.device->frame(static_cast<std::size_t>(i), t + i * 30'000 + 1'000);
    chain.step();
    return chain.take()->further.at(0);
  };
  EXPECT_EQ(*deliver(0, {1.0, 2.0}).series,
            (SeriesDescription{"series_3", "", {{"1", ""}, {"2", ""}}, ""}));
  described = {testing::wristSeries(), {"imu", "", {{"x", "g"}, {"y", "g"}, {"z", "g"}}, ""}};
  EXPECT_EQ(*deliver(1, {1.0, 2.0, 3.0}).series, described[1]);
  EXPECT_EQ(deliver(2, {4.0, 5.0, 6.0}).sample.values, (std::vector{4.0, 5.0, 6.0}));
}

TEST(ProcessingChain, EverySampleIsToldAndARemovedSeriesIsForgotten) {
  ScriptedSession scripted;
  std::vector<SeriesDescription> described{testing::wristSeries()};
  ChainOptions options;
  options.furtherSeries = [&] { return described; };
  std::vector<double> told;
  options.onFurther = [&](const FurtherSample& sample) {
    EXPECT_EQ(*sample.series, testing::wristSeries());
    told.push_back(sample.sample.values[0]);
  };
  ProcessingChain chain(signalsOnly(), options);
  chain.connect(*scripted.session);
  const std::int64_t t = 1'400'000'000'000'000;
  for (int i = 0; i < 5; ++i)
    scripted.device->sink->onSample({t + i * 1000, {1.0 * i, 0.0, 0.0}, kHandSeries});
  scripted.device->frame(0, t + 30'000);
  chain.step();
  EXPECT_EQ(told, (std::vector{0.0, 1.0, 2.0, 3.0, 4.0}));
  EXPECT_EQ(chain.take()->further.size(), 1u);
  described = {{}};
  scripted.device->sink->onEvent({t + 31'000, t + 31'000, "link", {}, "removed", ""});
  scripted.device->frame(1, t + 60'000);
  chain.step();
  EXPECT_TRUE(chain.take()->further.empty());
}

}  // namespace
}  // namespace palpate::processing_chain_test
