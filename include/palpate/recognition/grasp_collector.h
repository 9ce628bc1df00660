// Detects grasps in the frames of a running hand and returns each one, with some frames before and
// after it, as a separate profile, as if that grasp alone had been recorded.
//
// A contact: at least `minFingers` different fingers with an active taxel (value > 0), up to
// `bridgedFrames` frames without bridged, as the rule `general` of grasp_segments.h has it; a gap
// of the stream ends it. Only what came counts, no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/model/gap_detector.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/hand_state.h>
#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_features.h>

namespace palpate {

struct GraspCollectorOptions {
  std::size_t minFingers = 2;       // 1..8
  std::size_t moreThanFrames = 20;  // a contact that is shorter is no grasp
  std::size_t bridgedFrames = 3;
  std::size_t framesBefore = 16;  // kept of what was before the contact
  std::size_t framesAfter = 10;   // and after it, >= bridgedFrames
  std::size_t maxFrames = 18000;  // of one contact; what comes later is not kept

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

class GraspCollector {
 public:
  // Throws std::invalid_argument: options.
  explicit GraspCollector(HandDescription hand, GraspCollectorOptions options = {});

  // In order of time; what isn't later than the last one, or of another size, is left out.
  void addFrame(std::shared_ptr<const TactileFrame> frame);
  void addAngles(JointAngles angles);
  // Nothing of what came before belongs to what comes.
  void reset();

  // Something is touched now, since so long [s]; 0: nothing is.
  bool touched() const noexcept { return contactFrames_ > 0; }
  double touchedS() const noexcept;
  // What came of the grasp that goes on, long enough to be one; nothing: there is none.
  std::optional<Profile> now() const;
  // Grasps that ended since the last call.
  std::vector<Profile> takeEnded();
  // Samples kept now: bounded however long a contact lasts.
  std::size_t keptFrames() const noexcept { return frames_.size(); }
  std::size_t keptAngles() const noexcept { return angles_.size(); }

 private:
  bool contactIn(const TactileFrame& frame) const;
  void finish();
  Profile clip() const;
  void trimAngles();

  const HandDescription hand_;
  const GraspCollectorOptions options_;
  GapDetector gaps_;
  std::deque<std::shared_ptr<const TactileFrame>> frames_;  // from before the contact on
  std::deque<JointAngles> angles_;
  std::size_t contactFrames_ = 0;  // from its begin, bridged ones too; 0: no contact
  std::size_t without_ = 0;        // frames without contact since the last one with
  std::int64_t contactUs_ = 0;     // its begin, and its last frame
  std::int64_t lastTouchUs_ = 0;
  std::vector<Profile> ended_;
};

// The one grasp that a clip, or a part of a recording, is about.
struct ChosenGrasp {
  GraspFeatures features;   // with trouble: why there are none
  std::int64_t timeUs = 0;  // host time of its begin
  double quality = 0.0;     // GraspSegment::quality
};

// Of frames first..last (both inclusive) of a profile the grasp (findPinches()) that lies in them
// longest, cut to them where they begin later or end earlier. Throws std::out_of_range (frames),
// Cancelled.
ChosenGrasp graspWithin(const Profile& profile,
                        std::size_t first,
                        std::size_t last,
                        FeatureSet set,
                        const PinchHand& hand = sdh2PinchHand(),
                        const Progress& progress = {});
// Of all of it; a profile without frames has trouble.
ChosenGrasp graspOf(const Profile& profile,
                    FeatureSet set,
                    const PinchHand& hand = sdh2PinchHand(),
                    const Progress& progress = {});

}  // namespace palpate
