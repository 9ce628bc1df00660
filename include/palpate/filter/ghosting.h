// False activations ("ghosts"; study, chapter 2.4): with low thresholds the sensor's noise makes
// taxels active that nothing touches. Counts these taxels in a profile, how many of them a recipe
// removes, and how much of the true contacts it removes or delays.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/cell_truth.h>
#include <palpate/model/profile.h>

namespace palpate {

struct GhostingOptions {
  // A contact begins when so many touched taxels of a matrix are active in one frame. > 0
  int minTaxels = 1;
  // A value above it is active [counts]; what is filtered without mask keeps small remainders for
  // long. >= 0
  double activeAboveCounts = 0.0;
  // Fraction of a matrix' taxels, 0..1, above which false activations are counted separately: the
  // whole matrix is then above its threshold, and no spatial filter can separate them from a
  // contact.
  double wholeMatrixFraction = 0.25;
  // Moments at which counts begin to mean something else [us since 1970], ascending: filters over
  // time restart.
  std::vector<std::int64_t> restartsUs = {};
};

// The frames as they came, and filtered.
struct BeforeAfter {
  std::uint64_t before = 0;
  std::uint64_t after = 0;
  // Of those before, 0..1 (below 0: the recipe made more); NaN where there were none.
  double fractionRemoved() const noexcept;
};

struct MatrixGhosting {
  BeforeAfter falseTaxels;  // summed over the frames
  // of them, those in frames in which the matrix as it came was not lifted as a whole
  BeforeAfter scattered;
  BeforeAfter framesWithFalse;  // at least one false taxel
  BeforeAfter framesWhole;      // more than wholeMatrixFraction of the taxels are false
};

// One contact with one matrix: consecutive frames with touched taxels, of which at least one shows
// `minTaxels`.
struct ContactGhosting {
  std::size_t matrix = 0;
  std::size_t begin = 0, end = 0;  // first frame with a touched taxel, and the one behind the last
  std::size_t firstBefore = 0;     // first frame in which it is seen, as it came
  std::optional<std::size_t> firstAfter;  // and filtered; nothing: the recipe hides it altogether
  BeforeAfter taxels;  // touched ones that are active; after: of those active before
  double sumBefore = 0.0, sumAfter = 0.0;  // of the touched taxels over all frames [counts]
  std::optional<std::int64_t> delayFrames() const;
};

struct GhostingReport {
  std::uint64_t frames = 0;
  BeforeAfter framesWithFalse;  // in any matrix
  std::vector<MatrixGhosting> matrices;
  std::vector<ContactGhosting> contacts;  // by begin, then matrix
  BeforeAfter touched;            // touched taxels that are active; after: of those active before
  double touchedSumBefore = 0.0;  // of all touched taxels over all frames [counts]
  double touchedSumAfter = 0.0;
  std::optional<int> latencyFrames;  // of the recipe: filter_chain.h
  double costUs = 0.0;  // mean time that the chain took for a frame, on this machine [us]

  MatrixGhosting total() const;    // sums over the matrices
  std::uint64_t hidden() const;    // contacts that the recipe hides
  double meanDelayFrames() const;  // of the others; NaN where there are none
  double largestDelayFrames() const;
};

// truth: one mask per frame, or none at all: then nothing touches anything. Throws
// std::invalid_argument (recipe, options, truth of another size than the profile), Cancelled, Error
// (a frame that can't be read).
GhostingReport measureGhosting(const Profile& profile,
                               const Recipe& recipe,
                               std::span<const CellTruthMask> truth = {},
                               const GhostingOptions& options = {},
                               const Progress& progress = {});

}  // namespace palpate
