// Live stage that filters frames. It comes first, so that all later stages receive filtered frames.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <palpate/filter/filter_chain.h>
#include <palpate/live/stage.h>

namespace palpate {

// Replaces LiveResults::frame by the filtered one and keeps the original as
// LiveResults::unfiltered. A recording is not affected: it always contains the unfiltered frames.
// Steps that need later frames can't run live and are skipped. setRecipe() and costsUs() may be
// called from any thread.
class FilterStage final : public Stage {
 public:
  FilterStage();
  ~FilterStage() override;

  // Takes effect with the next frame; filters over time restart. Throws std::invalid_argument.
  void setRecipe(const Recipe& recipe);
  // Mean computing time per frame of each step of the recipe [us]; 0 if the step is off or skipped,
  // or before the first frame.
  std::vector<double> costsUs() const;

  void reset() override;
  void onFrame(LiveResults& results, std::vector<Event>& out) override;
  void onEvent(const Event& event) override;

 private:
  class Collector;

  const std::unique_ptr<Collector> collector_;
  std::unique_ptr<FilterChain> chain_;  // null when no filter is on
  mutable std::mutex mutex_;            // protects the following members
  Recipe wanted_;
  bool changed_ = false;
  std::vector<double> costsUs_;
};

// Returns the recipe for live use: steps that need later frames, or a matrix that the layout
// doesn't have, are switched off.
Recipe livePart(const Recipe& recipe, const SensorLayout& layout);

}  // namespace palpate
