#include "filter/windowed_filter.h"

#include <algorithm>

namespace palpate::detail {

WindowedFilter::WindowedFilter(int window, bool centred, Edge edge)
    : window_(static_cast<std::size_t>(window)), centred_(centred), edge_(edge) {}

// Filters one frame. `from`..`to` and `current` are indices in the stretch, both ends inclusive.
void WindowedFilter::filter(std::size_t from,
                            std::size_t to,
                            std::size_t current,
                            TactileFrame& frame) {
  pointers_.clear();
  for (std::size_t i = from; i <= to; ++i) pointers_.push_back(frames_[i - first_].values.data());
  compute(pointers_, current - from, frame.values.data());
}

void WindowedFilter::emitNext(std::size_t from, std::size_t to, FrameSink& out) {
  out_ = frames_[next_ - first_];
  filter(from, to, next_, out_);
  ++next_;
  out.take(out_);
}

void WindowedFilter::push(TactileFrame& frame, FrameSink& out) {
  // Reuse the memory of the frame that leaves the window for the new one.
  const std::size_t keep = centred_ && edge_ == Edge::kShift ? 2 * window_ : window_;
  TactileFrame stored;
  if (frames_.size() >= keep) {
    stored = std::move(frames_.front());
    frames_.pop_front();
    ++first_;
  }
  stored = frame;
  frames_.push_back(std::move(stored));
  const std::size_t last = first_ + frames_.size() - 1;
  if (!centred_) {
    filter(last + 1 > window_ ? last + 1 - window_ : 0, last, last, frame);
    out.take(frame);
    return;
  }
  const std::size_t radius = window_ / 2;
  const std::size_t needed = edge_ == Edge::kShift ? window_ - 1 : 0;
  while (next_ + radius <= last && last >= needed)
    emitNext(next_ > radius ? next_ - radius : 0,
             edge_ == Edge::kShift ? std::max(next_ + radius, window_ - 1) : next_ + radius,
             out);
}

void WindowedFilter::finish(FrameSink& out) {
  if (centred_ && !frames_.empty()) {
    const std::size_t radius = window_ / 2;
    const std::size_t last = first_ + frames_.size() - 1;
    while (next_ <= last) {
      std::size_t from = next_ > radius ? next_ - radius : 0;
      if (edge_ == Edge::kShift) from = std::min(from, last + 1 > window_ ? last + 1 - window_ : 0);
      const std::size_t to = edge_ == Edge::kShift ? std::min(last, from + window_ - 1)
                                                   : std::min(last, next_ + radius);
      emitNext(from, to, out);
    }
  }
  frames_.clear();
  first_ = 0;
  next_ = 0;
  forget();
}

}  // namespace palpate::detail
