// The per-second summary of a recording: what overview charts are drawn from, so that they need not
// read the frames of a long recording.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// One matrix in one second.
struct SecondSummary {
  std::int64_t tS = 0;  // [s since 1970], the second the frames' host time falls into
  int matrix = 0;
  std::int64_t frames = 0;
  double minimum = 0.0;  // smallest value of an active taxel; 0 where none was active
  double maximum = 0.0;  // largest value
  double sum = 0.0;      // of all positive values of all frames
  int activeMax = 0;     // most taxels active (value > 0) at once
  bool operator==(const SecondSummary&) const = default;
};

// Adds frames up and hands over the rows of a second, one per matrix, when a frame of another
// second comes.
class SecondSummarizer {
 public:
  using Sink = std::function<void(const SecondSummary&)>;
  explicit SecondSummarizer(Sink sink) : sink_(std::move(sink)) {}
  void add(const TactileFrame& frame);
  // Hands over the second that has begun.
  void flush();

 private:
  Sink sink_;
  std::vector<SecondSummary> rows_;
};

// The summary of a profile, every frame of it read, in the order of readSeconds(): for whoever has
// a .dsa open already. Throws Cancelled, and what reading a frame throws.
std::vector<SecondSummary> secondsOf(const Profile& profile, const Progress& progress = {});

// The summary of a recording, ordered by time, then matrix; seconds without a frame are not there.
// A native recording holds it: its frames are not read, of an unfinished one the last second is
// missing, and rows with a wrong checksum are left out. A .dsa is read for it. Throws FileError,
// FormatError.
std::vector<SecondSummary> readSeconds(const std::filesystem::path& path);

}  // namespace palpate
