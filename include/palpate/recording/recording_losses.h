// What a recording lacks according to its events of kind "gap": frames, joint angles, temperatures
// or events that were lost, each with its number and time. The gaps of TimingReport come from the
// time stamps of the frames alone, so that they tell nothing of lost angles, nor of few lost
// frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <palpate/model/event.h>

namespace palpate {

// What was lost of one stream.
struct RecordingLoss {
  std::string stream;      // "tactile", "angles", "temperatures", "events", or another series
  std::size_t spans = 0;   // events that tell of a loss
  std::uint64_t lost = 0;  // items, as far as the events tell their number
  bool counted = true;     // every event tells the number
  double seconds = 0.0;    // sum of the lengths of the spans [s]

  // "12 angle samples in 2 spans, 0.35 s".
  std::string text() const;
};

// One item for each stream that lost something, in the order above, other series as they come. An
// event that names no stream is about the frames. An event that tells of no lost item is a silence
// and no loss.
std::vector<RecordingLoss> lossesOf(std::span<const Event> events);

}  // namespace palpate
