// A filter that runs over frames: they go in one after the other and come out filtered, in the same
// order, every one of them. A causal filter gives each frame at once; one that needs later frames
// holds some back.
#pragma once

#include <memory>

#include <palpate/filter/filter_step.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // May move the values out of the frame.
  virtual void take(TactileFrame& frame) = 0;
};

class FrameFilter {
 public:
  virtual ~FrameFilter() = default;
  // The next frame; changes it. All frames between two finish() are one stretch: they have the
  // layout the filter was made for and no gap among them.
  virtual void push(TactileFrame& frame, FrameSink& out) = 0;
  // The stretch has ended: gives what was held back and forgets what came before.
  virtual void finish(FrameSink& out) = 0;
};

// Throws std::invalid_argument as FilterStep::validate(), and for a matrix that the layout hasn't.
std::unique_ptr<FrameFilter> makeFrameFilter(const FilterStep& step,
                                             std::shared_ptr<const SensorLayout> layout);

}  // namespace palpate
