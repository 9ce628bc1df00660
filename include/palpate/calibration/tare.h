// Tare: finds the readings of unloaded taxels (false activations, noise above the threshold) in the
// recording itself and subtracts them. The tare is stored as an event; the recorded values are not
// changed, and removing the event restores them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// What counts as unloaded.
struct TareOptions {
  // Length of a window, which is unloaded or not as a whole [s]. Where frames are rarer than
  // three in this time, a window is as long as three usual intervals of frames.
  static constexpr OptionRange kWindowS{0.05, 3600.0, "s"};
  double windowS = 1.0;
  // A matrix whose calmest window has a larger reading [counts] is never unloaded.
  static constexpr OptionRange kMaxRestCounts{0.0, 1e9, "counts"};
  double maxRestCounts = 150;
  // Windows within this distance of the calmest one are also unloaded [counts]; >= 0.
  double sameRestCounts = 10;
  // Largest standard deviation of each taxel in an unloaded window [counts]; >= 0.
  double maxSdCounts = 6;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Frames begin..end, both inclusive, in which nothing touches a matrix.
struct UnloadedWindow {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// The tare of one matrix.
struct MatrixTare {
  bool valid = false;  // unloaded windows were found
  std::vector<UnloadedWindow> windows;
  double largestZero = 0.0;  // of the matrix's taxels [counts]
  // Number of taxels with a zero above 0.
  std::size_t raisedTaxels = 0;
  std::string note;  // what is missing
};

// The tare of a whole sensor.
struct Tare {
  // The zero of every place [counts]: median over the unloaded windows of the taxel's mean; 0 where
  // the matrix is not valid.
  std::vector<float> zero;
  std::vector<MatrixTare> matrices;
  // Returns whether a taxel has a zero above 0.
  bool any() const;
};

// Finds the tare of a recording. Throws std::invalid_argument (options), Cancelled.
Tare findTare(const Profile& profile,
              const TareOptions& options = {},
              const Progress& progress = {});

// Whether the unloaded windows of the matrix contain at least `leastShare` (0..1) of all
// `numFrames` frames, and one frame.
bool wasAtRest(const MatrixTare& matrix, std::size_t numFrames, double leastShare);

// Why the hand of this profile isn't at rest, in one line that names the matrices; empty when it
// is. `tare` is that of the profile.
std::string notAtRest(const Tare& tare, const Profile& profile, double leastShare);

// Subtracts the zero, but not below 0; a value of 0 stays 0. Throws std::invalid_argument (sizes).
void applyTare(const Tare& tare, std::span<float> values);

// JSON of the event (kind "tare"): matrices[{index,zero[..],windows[[begin,end]..],valid}], and
// back. Throws Error when it is no such JSON or has another layout.
Json jsonOf(const Tare& tare, const SensorLayout& layout);
Tare tareFrom(const Json& json, const SensorLayout& layout);

}  // namespace palpate
