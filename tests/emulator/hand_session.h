// Helpers for tests of an emulated hand: requests, options, and waiting for its state.
#pragma once

#include <chrono>
#include <utility>
#include <vector>

#include "palpate/emulator/emulated_hand.h"

#include "emulator/line_client.h"
#include "testing/awaited.h"

namespace palpate::testing {

// Literal bytes of the protocol document, section 1.6.1.
inline const Octets kPush = octets("AA AA AA 03 03 00 81 01 00 7C 5C");
inline const Octets kPushRaw = octets("AA AA AA 03 03 00 80 01 00 DE 36");
inline const Octets kSingle = octets("AA AA AA 03 03 00 81 00 00 2F 68");
inline const Octets kStop = octets("AA AA AA 03 03 00 01 00 00 2F 6A");

// Options without pacing, for tests that don't depend on timing.
inline EmulatedHandOptions fastHand(double hz = 300.0) {
  return {.rate = EmulationRate::kFixed, .hz = hz};
}

// Reads `count` frames; fewer when none arrives for two seconds.
inline std::vector<DecodedFrame> readFrames(LineClient& client, std::size_t count) {
  std::vector<DecodedFrame> frames;
  while (frames.size() < count) {
    const auto packet = client.packet();
    if (!packet) break;
    if (packet->id != 0) continue;
    if (auto frame = decodeFramePayload(packet->payload)) frames.push_back(std::move(*frame));
  }
  return frames;
}

// Waits until the condition holds for the hand's counters, at most five seconds.
template <typename Condition>
bool eventually(const EmulatedHand& hand, Condition&& condition) {
  return awaited([&] { return condition(hand.counts()); }, std::chrono::seconds(5));
}

}  // namespace palpate::testing
