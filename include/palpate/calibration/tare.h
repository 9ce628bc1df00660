// Tare: the readings of unloaded taxels (false activations, noise above the threshold), found in
// the recording itself and subtracted. It is stored as an event; the recorded values are not
// changed, and removing the event restores them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

struct TareOptions {
  double windowS = 1.0;        // a window is judged as a whole [s]; > 0
  double maxRestCounts = 150;  // a matrix whose calmest window reads more is never unloaded; >= 0
  // windows within so much of the calmest one are unloaded as well; >= 0
  double sameRestCounts = 10;
  double maxSdCounts = 6;  // of each taxel within a window; more: something moves; >= 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Frames begin..end, both inclusive, in which nothing touches a matrix.
struct UnloadedWindow {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct MatrixTare {
  bool valid = false;  // unloaded windows were found
  std::vector<UnloadedWindow> windows;
  double largestZero = 0.0;      // of its taxels [counts]
  std::size_t raisedTaxels = 0;  // with a zero above 0
  std::string note;              // what is missing
};

struct Tare {
  // per place [counts]: median over the unloaded windows of the taxel's mean; 0 where not valid
  std::vector<float> zero;
  std::vector<MatrixTare> matrices;
  bool any() const;  // a taxel has a zero above 0
};

// Throws std::invalid_argument (options), Cancelled.
Tare findTare(const Profile& profile,
              const TareOptions& options = {},
              const Progress& progress = {});

// values - zero, not below 0; a value of 0 stays. Throws std::invalid_argument (sizes).
void applyTare(const Tare& tare, std::span<float> values);

// The event's JSON (kind "tare"): matrices[{index,zero[..],windows[[begin,end]..],valid}], and
// back. Throws Error: not such JSON, or of another layout.
Json jsonOf(const Tare& tare, const SensorLayout& layout);
Tare tareFrom(const Json& json, const SensorLayout& layout);

}  // namespace palpate
