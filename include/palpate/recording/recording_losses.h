// What a recording lacks according to its events of kind "gap": frames, joint angles, temperatures
// or events that were lost, each with its number and time. The gaps of TimingReport come from the
// time stamps of the frames alone, so that they tell nothing of lost angles, nor of few lost
// frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/model/event.h>
#include <palpate/model/profile.h>

namespace palpate {

// What was lost of one stream.
struct RecordingLoss {
  std::string stream;      // "tactile", "angles", "temperatures", "events", or name of a series
  std::size_t spans = 0;   // events that tell of a loss
  std::uint64_t lost = 0;  // items, as far as the events tell their number
  bool counted = true;     // every event tells the number
  double seconds = 0.0;    // sum of the lengths of the spans [s]

  // "12 angle samples in 2 spans, 0.35 s".
  std::string text() const;
};

// What an item of such a stream is called: "frame", "wrist sample".
std::string itemOf(std::string_view stream);

// One item for each stream that lost something, in the order above; series as they come. An event
// that names no stream is about the frames. An event that tells of no lost item is a silence and no
// loss.
std::vector<RecordingLoss> lossesOf(std::span<const Event> events);

// A series for people: "1200 samples, 100.0 Hz (mean); fx [N], fy [N]; from tcp:localhost:9871".
std::string seriesText(const Profile& profile, std::size_t series);

// What a profile saved as PATH will lack: "a .dsa has no place for the series wrist, imu: they are
// left out"; empty: nothing. Throws FileError as formatOf().
std::string leftOutText(const Profile& profile, const std::filesystem::path& path);

}  // namespace palpate
