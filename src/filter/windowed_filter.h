// Common part of the filters over a window of frames: the last frames (causal), or the frames
// around the filtered one (centred).
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "palpate/filter/frame_filter.h"

namespace palpate::detail {

class WindowedFilter : public FrameFilter {
 public:
  // At the ends of a stretch, the window of kShrink has fewer frames; that of kShift (centred) has
  // as many frames, but is not centred on the filtered frame.
  enum class Edge { kShrink, kShift };

  void push(TactileFrame& frame, FrameSink& out) final;
  void finish(FrameSink& out) final;

 protected:
  WindowedFilter(int window, bool centred, Edge edge);
  // Computes one filtered frame. `window` has the values of the frames, oldest first; `current` is
  // the index of the frame to filter. `values` holds the values of that frame and receives the
  // filtered ones.
  virtual void compute(std::span<const float* const> window,
                       std::size_t current,
                       float* values) = 0;
  virtual void forget() {}  // called when a new stretch begins

 private:
  void filter(std::size_t from, std::size_t to, std::size_t current, TactileFrame& frame);
  void emitNext(std::size_t from, std::size_t to, FrameSink& out);

  const std::size_t window_;
  const bool centred_;
  const Edge edge_;
  std::deque<TactileFrame> frames_;  // the last frames, unfiltered
  std::size_t first_ = 0;            // index of the first of them in the stretch
  std::size_t next_ = 0;             // index of the frame that is passed on next
  std::vector<const float*> pointers_;
  TactileFrame out_;
};

}  // namespace palpate::detail
