#include "palpate/live/filter_stage.h"

#include <algorithm>

namespace palpate {

// Receives the filtered frame: a causal chain returns one frame for each input frame.
class FilterStage::Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override {
    frame_ = std::make_shared<const TactileFrame>(std::move(frame));
  }
  SharedFrame frame() { return std::exchange(frame_, nullptr); }

 private:
  SharedFrame frame_;
};

FilterStage::FilterStage() : collector_(std::make_unique<Collector>()) {}
FilterStage::~FilterStage() = default;

void FilterStage::setRecipe(const Recipe& recipe) {
  recipe.validate();
  const std::lock_guard lock(mutex_);
  wanted_ = recipe;
  changed_ = true;
}

std::vector<double> FilterStage::costsUs() const {
  const std::lock_guard lock(mutex_);
  return costsUs_;
}

void FilterStage::reset() {
  if (chain_) chain_->finish();
}

void FilterStage::onEvent(const Event& event) {
  if (event.kind == "settings" && chain_) chain_->restart();
}

void FilterStage::onFrame(LiveResults& results, std::vector<Event>&) {
  {
    const std::lock_guard lock(mutex_);
    if (changed_) {
      const Recipe live = livePart(wanted_, *results.frame->layout);
      chain_ = live.empty() ? nullptr : std::make_unique<FilterChain>(live, *collector_);
      if (chain_) chain_->measureCosts(true);
      costsUs_.assign(live.steps.size(), 0.0);
      changed_ = false;
    }
  }
  if (!chain_) return;
  TactileFrame frame = *results.frame;
  chain_->push(frame);
  const SharedFrame filtered = collector_->frame();
  if (!filtered) return;
  results.unfiltered = results.frame;
  results.frame = filtered;
  std::vector<double> costsUs = chain_->costsUs();
  const std::lock_guard lock(mutex_);
  if (!changed_) costsUs_ = std::move(costsUs);
}

Recipe livePart(const Recipe& recipe, const SensorLayout& layout) {
  Recipe live = recipe;
  for (FilterStep& step : live.steps) {
    const bool there = std::all_of(step.matrices.begin(), step.matrices.end(), [&](std::size_t m) {
      return m < layout.numMatrices();
    });
    const bool ofThisHand = !step.rest || step.rest->rest.size() == layout.numCells();
    step.enabled = step.enabled && step.causal() && there && ofThisHand;
  }
  return live;
}

}  // namespace palpate
