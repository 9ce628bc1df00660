// One step of live processing: what comes in order of time goes through it, frame by frame.
#pragma once

#include <vector>

#include <palpate/live/live_results.h>
#include <palpate/model/hand_state.h>
#include <palpate/recording/recording_event.h>

namespace palpate {

// Called from one thread, in order of time; at one instant events come first, then temperatures,
// angles and the frame. A stage has state of its own, and no clock but the stamps: that is what
// makes a replay give the same results. What it throws ends the processing
// (ProcessingChain::failure()).
class Stage {
 public:
  virtual ~Stage() = default;
  // A new source: forgets what came before.
  virtual void reset() {}
  // `results` holds the frame and what earlier stages found; `out` takes what happened (a slip, a
  // grasp).
  virtual void onFrame(LiveResults& results, std::vector<RecordingEvent>& out) = 0;
  virtual void onAngles(const JointAngles&) {}
  virtual void onTemperatures(const Temperatures&) {}
  // Of the source: among them "gap" (frames are missing) and "settings" (counts mean something else
  // now).
  virtual void onEvent(const RecordingEvent&) {}
};

}  // namespace palpate
