// Tests of LiveHand with a tactile controller that falls silent, sends random bytes or sends single
// bytes slowly (reliability R9). Used by babble_test and babble_slow_test.
#pragma once

#include <gtest/gtest.h>

#include "palpate/device/live_hand.h"

#include "device/babbling_channel.h"
#include "device/collecting_sink.h"
#include "testing/process_facts.h"

namespace palpate::testing {

// Streams correctly, misbehaves, and streams correctly again. Returns the time until the state
// "silent" [ms].
inline double misbehave(Behaviour behaviour, std::uint64_t bytes) {
  using Clock = std::chrono::steady_clock;
  BabblerControls controls;
  controls.most = bytes;
  LiveHandOptions options;
  options.dsaPort = "babbler";
  options.open = [&](const std::string&) { return std::make_unique<BabblingChannel>(controls); };
  CollectingSink sink;
  LiveHand hand(options);
  hand.start(sink);
  EXPECT_TRUE(sink.awaitFrames(20));
  const ProcessFacts before = processFacts();
  controls.behaviour = behaviour;
  const auto from = Clock::now();
  EXPECT_TRUE(sink.await([&] { return hand.status().tactile.state != PortState::kStreaming; }));
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - from).count();
  if (bytes > 0) {
    EXPECT_TRUE(
        sink.await([&] { return controls.bytes >= controls.most; }, std::chrono::minutes(4)));
  }
  const ProcessFacts after = processFacts();
  if (kMemoryIsOurs) {
    EXPECT_LT(after.residentBytes, before.residentBytes + (4u << 20));
  }
  EXPECT_EQ(after.descriptors, before.descriptors);
  EXPECT_EQ(after.threads, before.threads);
  const std::size_t frames = sink.numFrames();
  controls.behaviour = Behaviour::kHonest;
  EXPECT_TRUE(sink.awaitFrames(frames + 10, std::chrono::seconds(20))) << "came back";
  hand.stop();
  std::size_t gaps = 0;
  for (const Event& event : sink.takeEvents())
    if (event.kind == "gap") ++gaps;
  EXPECT_EQ(gaps, 1u);
  return ms;
}

}  // namespace palpate::testing
