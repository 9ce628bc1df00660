// Counts false activations ("ghosts"; study, chapter 2.4): with low thresholds the sensor's noise
// makes taxels active that nothing touches. measureGhosting() counts these taxels in a profile, how
// many of them a recipe removes, and how much of the true contacts the recipe removes or delays.
// The command `ghosts` uses it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// What counts as a ghost and as a contact.
struct GhostingOptions {
  // A contact begins when at least this many touched taxels of a matrix are active in one frame;
  // at least 1.
  int minTaxels = 1;
  // A taxel is active when its value is above this limit [counts]. Filters without mask leave
  // small values behind for a long time.
  static constexpr OptionRange kActiveAboveCounts{0.0, 1e9, "counts"};
  double activeAboveCounts = 0.0;
  // Fraction of a matrix' taxels, 0..1, above which false activations are counted separately: the
  // whole matrix is then above its threshold, and no spatial filter can separate them from a
  // contact.
  double wholeMatrixFraction = 0.25;
  // Times at which the meaning of counts changes [us since 1970], ascending; filters over time
  // restart there.
  std::vector<std::int64_t> restartsUs = {};
};

// A count in the frames before and after filtering.
struct BeforeAfter {
  std::uint64_t before = 0;
  std::uint64_t after = 0;
  // Share of the count before that the recipe removed, 0..1; below 0 when the recipe made more; NaN
  // when `before` is 0.
  double fractionRemoved() const noexcept;
};

// The ghosts of one matrix.
struct MatrixGhosting {
  BeforeAfter falseTaxels;  // summed over the frames
  // The false taxels in frames in which the unfiltered matrix was not above its threshold as a
  // whole (see wholeMatrixFraction).
  BeforeAfter scattered;
  // Frames with at least one false taxel.
  BeforeAfter framesWithFalse;
  // Frames in which more than wholeMatrixFraction of the taxels are false.
  BeforeAfter framesWhole;
};

// One contact with one matrix: consecutive frames with touched taxels, at least one of which has
// `minTaxels` active ones.
struct ContactGhosting {
  std::size_t matrix = 0;
  // First frame with a touched taxel, and the frame after the last.
  std::size_t begin = 0, end = 0;
  // First frame in which the contact is visible without the recipe.
  std::size_t firstBefore = 0;
  // First frame in which it is visible with the recipe; empty when the recipe hides the contact.
  std::optional<std::size_t> firstAfter;
  // Touched taxels that are active; `after` counts only those that were also active before.
  BeforeAfter taxels;
  // Sum of the touched taxels over all frames [counts].
  double sumBefore = 0.0, sumAfter = 0.0;
  std::optional<std::int64_t> delayFrames() const;
};

// The ghosts and contacts of a profile, with and without the recipe.
struct GhostingReport {
  std::uint64_t frames = 0;
  // Frames with a false taxel in any matrix.
  BeforeAfter framesWithFalse;
  std::vector<MatrixGhosting> matrices;
  std::vector<ContactGhosting> contacts;  // sorted by begin, then matrix
  // Touched taxels that are active; `after` counts only those that were also active before.
  BeforeAfter touched;
  // Sum of all touched taxels over all frames [counts].
  double touchedSumBefore = 0.0;
  double touchedSumAfter = 0.0;
  std::optional<int> latencyFrames;  // delay of the recipe (filter_chain.h)
  // Mean time that the chain took per frame on this machine [us].
  double costUs = 0.0;

  MatrixGhosting total() const;  // sums over the matrices
  // Number of contacts that the recipe hides.
  std::uint64_t hidden() const;
  // Delay of the contacts that the recipe does not hide [frames]; NaN when there are none.
  double meanDelayFrames() const;
  double largestDelayFrames() const;
};

// Measures the ghosts of a profile. `truth` has one mask per frame; empty means that nothing
// touches the sensor. Throws std::invalid_argument (recipe, options, or truth of another size than
// the profile), Cancelled, and Error (a frame that cannot be read).
GhostingReport measureGhosting(const Profile& profile,
                               const Recipe& recipe,
                               std::span<const CellTruthMask> truth = {},
                               const GhostingOptions& options = {},
                               const Progress& progress = {});

}  // namespace palpate
