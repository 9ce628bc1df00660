// Interface of one step of live processing, which handles the frames and other items in order of
// time.
#pragma once

#include <vector>

#include <palpate/live/live_results.h>
#include <palpate/model/event.h>
#include <palpate/model/series.h>

namespace palpate {

// Called from one thread, in order of time; at equal times events come first, then temperatures,
// angles and the frame. A stage may have state, but uses no clock except the stamps, so that a
// replay gives the same results. An exception ends the processing (ProcessingChain::failure()).
class Stage {
 public:
  virtual ~Stage() = default;
  // Forgets all earlier items, because a new source begins.
  virtual void reset() {}
  // `results` contains the frame and the results of earlier stages; events found by this stage (a
  // slip, a grasp) are appended to `out`.
  virtual void onFrame(LiveResults& results, std::vector<Event>& out) = 0;
  virtual void onSample(const Sample&) {}
  // An event of the source, such as "gap" (frames are missing) or "settings" (the meaning of the
  // counts has changed).
  virtual void onEvent(const Event&) {}
};

}  // namespace palpate
