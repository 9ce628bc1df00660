// Interface of a filter over frames. FilterChain pushes frames one after the other, and the filter
// passes every frame on in the same order. A causal filter passes each frame on at once; a filter
// that needs later frames holds some back.
#pragma once

#include <memory>

#include <palpate/filter/filter_step.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Receives filtered frames.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // Takes one filtered frame; may move its values away.
  virtual void take(TactileFrame& frame) = 0;
};

// Filters frames one after the other.
class FrameFilter {
 public:
  virtual ~FrameFilter() = default;
  // Filters the next frame in place. All frames between two calls of finish() are one stretch: they
  // have the layout that the filter was made for and no gap between them.
  virtual void push(TactileFrame& frame, FrameSink& out) = 0;
  // Ends the stretch: passes on the frames that were held back and resets the state.
  virtual void finish(FrameSink& out) = 0;
};

// Makes the filter of a step. Throws std::invalid_argument as FilterStep::validate(), and for a
// matrix that the layout does not have.
std::unique_ptr<FrameFilter> makeFrameFilter(const FilterStep& step,
                                             std::shared_ptr<const SensorLayout> layout);

}  // namespace palpate
