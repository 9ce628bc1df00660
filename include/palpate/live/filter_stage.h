// The stage that stands first where filters are on: what comes behind it sees filtered frames.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <palpate/filter/filter_chain.h>
#include <palpate/live/stage.h>

namespace palpate {

// Replaces LiveResults::frame by the filtered one and keeps the other as LiveResults::unfiltered.
// The recording isn't touched: it always holds what came. Steps that need later frames are left
// out: they can't run live. setRecipe() and costsUs() may be called from any thread.
class FilterStage final : public Stage {
 public:
  FilterStage();
  ~FilterStage() override;

  // From the next frame on; filters over time begin anew. Throws std::invalid_argument.
  void setRecipe(const Recipe& recipe);
  // Time that each step of the recipe takes for a frame, on average [us]; 0: off, left out, or no
  // frame yet.
  std::vector<double> costsUs() const;

  void reset() override;
  void onFrame(LiveResults& results, std::vector<RecordingEvent>& out) override;
  void onEvent(const RecordingEvent& event) override;

 private:
  class Collector;

  const std::unique_ptr<Collector> collector_;
  std::unique_ptr<FilterChain> chain_;  // null: nothing to do
  mutable std::mutex mutex_;            // of what follows
  Recipe wanted_;
  bool changed_ = false;
  std::vector<double> costsUs_;
};

// The steps that run live: those that need later frames, or a matrix that the layout hasn't, are
// switched off.
Recipe livePart(const Recipe& recipe, const SensorLayout& layout);

}  // namespace palpate
