#include "palpate/filter/filter_chain.h"

#include <algorithm>
#include <chrono>
#include <deque>

namespace palpate {
namespace {

using FilterChainSteadyClock = std::chrono::steady_clock;

double nsBetween(FilterChainSteadyClock::time_point from, FilterChainSteadyClock::time_point to) {
  return std::chrono::duration<double, std::nano>(to - from).count();
}

}  // namespace

// One step of the chain. A link takes frames for its filter and passes the filtered ones on to the
// next link.
class FilterChain::Link final : public FrameSink {
 public:
  Link(FilterChain& chain, std::size_t step, std::unique_ptr<FrameFilter> filter)
      : chain_(chain), step_(step), filter_(std::move(filter)) {}

  void setNext(FrameSink& next) { next_ = &next; }
  void take(TactileFrame& frame) override {
    timed([&] { filter_->push(frame, *next_); });
  }
  void finish() {
    timed([this] { filter_->finish(*next_); });
  }

 private:
  template <typename Work>
  void timed(const Work& work) {
    if (!chain_.measuring_) return work();
    // The filter calls the steps behind this one; their time is subtracted.
    const double spentBehind = behindNs();
    const auto from = FilterChainSteadyClock::now();
    work();
    chain_.spentNs_[step_] +=
        nsBetween(from, FilterChainSteadyClock::now()) - (behindNs() - spentBehind);
  }
  double behindNs() const {
    double sum = 0.0;
    for (std::size_t i = step_ + 1; i < chain_.spentNs_.size(); ++i) sum += chain_.spentNs_[i];
    return sum;
  }

  FilterChain& chain_;
  const std::size_t step_;
  const std::unique_ptr<FrameFilter> filter_;
  FrameSink* next_ = nullptr;
};

// Remembers which taxels were active in the frames that went in, and applies this to the frames
// that come out. Both have the same order, and no frame is missing.
class FilterChain::Contact final : public FrameSink {
 public:
  explicit Contact(FrameSink& out) : out_(out) {}

  void goesIn(TactileFrame& frame) {
    std::vector<bool> active = std::move(spare_);
    active.resize(frame.values.size());
    for (std::size_t i = 0; i < active.size(); ++i) active[i] = isTouched(frame.values[i]);
    active_.push_back(std::move(active));
    if (frame.filtered.empty()) return;
    frame.values.swap(frame.filtered);
    frame.filtered.clear();
  }
  void take(TactileFrame& frame) override {
    frame.setFiltered(std::move(frame.values), active_.front());
    spare_ = std::move(active_.front());
    active_.pop_front();
    out_.take(frame);
  }
  void forget() noexcept { active_.clear(); }

 private:
  FrameSink& out_;
  std::deque<std::vector<bool>> active_;  // of the frames that the filters still hold
  std::vector<bool> spare_;
};

FilterChain::FilterChain(Recipe recipe, FrameSink& out)
    : recipe_(std::move(recipe)),
      out_(std::make_unique<Contact>(out)),
      spentNs_(recipe_.steps.size(), 0.0) {
  recipe_.validate();
}

FilterChain::~FilterChain() = default;

void FilterChain::build(const std::shared_ptr<const SensorLayout>& layout) {
  std::vector<std::unique_ptr<Link>> links;
  for (std::size_t i = 0; i < recipe_.steps.size(); ++i)
    if (recipe_.steps[i].enabled)
      links.push_back(std::make_unique<Link>(*this, i, makeFrameFilter(recipe_.steps[i], layout)));
  for (std::size_t i = 0; i < links.size(); ++i)
    links[i]->setNext(i + 1 < links.size() ? static_cast<FrameSink&>(*links[i + 1]) : *out_);
  links_ = std::move(links);
  layout_ = layout;
}

// Runs `work`. When a filter throws, nobody knows which frames the filters still hold: the chain
// then drops them all, and the next frame starts with new filters.
template <typename Work>
void FilterChain::guarded(const Work& work) {
  try {
    work();
  } catch (...) {
    links_.clear();
    layout_.reset();
    gaps_.reset();
    out_->forget();
    throw;
  }
}

void FilterChain::endStretch() {
  for (const auto& link : links_) link->finish();
}

void FilterChain::push(TactileFrame& frame) {
  guarded([&] { pass(frame); });
}

void FilterChain::pass(TactileFrame& frame) {
  if (frame.layout != layout_ && (!layout_ || !(*frame.layout == *layout_))) {
    endStretch();
    build(frame.layout);
  }
  // What comes out is no reading of the sensor any more.
  frame.readings.clear();
  frame.baseline.reset();
  if (gaps_.afterGap(frame.hostUs)) endStretch();
  if (measuring_) ++frames_;
  out_->goesIn(frame);
  if (links_.empty()) {
    out_->take(frame);
  } else {
    links_.front()->take(frame);
  }
}

void FilterChain::restart() {
  guarded([this] { endStretch(); });
}

void FilterChain::finish() {
  guarded([this] { endStretch(); });
  gaps_.reset();
}

std::vector<double> FilterChain::costsUs() const {
  std::vector<double> costs(spentNs_.size(), 0.0);
  if (frames_ > 0)
    for (std::size_t i = 0; i < costs.size(); ++i)
      costs[i] = std::max(0.0, spentNs_[i]) / 1e3 / static_cast<double>(frames_);
  return costs;
}

}  // namespace palpate
