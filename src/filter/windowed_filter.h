// What filters share that look at several frames: the last ones (causal), or those around a frame
// (centred).
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "palpate/filter/frame_filter.h"

namespace palpate::detail {

class WindowedFilter : public FrameFilter {
 public:
  // At the ends of a stretch the window holds fewer frames, or (centred) as many, but not around
  // the frame.
  enum class Edge { kShrink, kShift };

  void push(TactileFrame& frame, FrameSink& out) final;
  void finish(FrameSink& out) final;

 protected:
  WindowedFilter(int window, bool centred, Edge edge);
  // `window`: the values of the frames, oldest first; `current`: which of them is filtered.
  // `values` has that frame's own and takes the filtered ones.
  virtual void compute(std::span<const float* const> window,
                       std::size_t current,
                       float* values) = 0;
  virtual void forget() {}  // a new stretch begins

 private:
  void filter(std::size_t from, std::size_t to, std::size_t current, TactileFrame& frame);
  void emitNext(std::size_t from, std::size_t to, FrameSink& out);

  const std::size_t window_;
  const bool centred_;
  const Edge edge_;
  std::deque<TactileFrame> frames_;  // the last ones, as they came
  std::size_t first_ = 0;            // index in the stretch of the first of them
  std::size_t next_ = 0;             // index of the frame that comes out next
  std::vector<const float*> pointers_;
  TactileFrame out_;
};

}  // namespace palpate::detail
