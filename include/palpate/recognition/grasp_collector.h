// Detects grasps in the frames of a running hand and returns each one, with some frames before and
// after it, as a separate profile, as if that grasp alone had been recorded. The recognition of the
// window uses it for a connected hand.
//
// A contact is a span of frames in which at least `minFingers` different fingers have an active
// taxel (value > 0); up to `bridgedFrames` frames without are bridged, as in the rule `general` of
// grasp_segments.h. A gap in the stream ends a contact. Time is taken from the time stamps only; no
// clock is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/model/gap_detector.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>
#include <palpate/model/series.h>
#include <palpate/recognition/grasp_features.h>

namespace palpate {

struct GraspCollectorOptions {
  std::size_t minFingers = 2;  // 1..8
  // A contact is a grasp if it lasts more frames than this.
  std::size_t moreThanFrames = 20;
  std::size_t bridgedFrames = 3;
  // Number of frames kept before the contact,
  std::size_t framesBefore = 16;
  // and after it, >= bridgedFrames.
  std::size_t framesAfter = 10;
  // Largest number of frames kept of one contact; later frames are dropped.
  std::size_t maxFrames = 18000;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

class GraspCollector {
 public:
  // Throws std::invalid_argument: options.
  explicit GraspCollector(HandDescription hand, GraspCollectorOptions options = {});

  // Adds a frame or joint angles, in order of time. A frame that is not later than the last one is
  // ignored, and so is one of another size; the same holds for angles.
  void addFrame(std::shared_ptr<const TactileFrame> frame);
  void addAngles(Sample angles);
  // Forgets the present contact: earlier frames are not combined with later ones.
  void reset();

  // Whether a contact is present, and how long it has lasted [s]; 0 without contact.
  bool touched() const noexcept { return contactFrames_ > 0; }
  double touchedS() const noexcept;
  // Returns the present grasp so far as a profile; empty if there is no contact or it is still too
  // short to be a grasp.
  std::optional<Profile> now() const;
  // Returns the grasps that ended since the last call.
  std::vector<Profile> takeEnded();
  // Number of frames and angle samples kept; bounded however long a contact lasts.
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
  // From before the contact on.
  std::deque<std::shared_ptr<const TactileFrame>> frames_;
  std::deque<Sample> angles_;
  // Number of frames since the contact began, bridged ones included; 0: no contact.
  std::size_t contactFrames_ = 0;
  // Number of frames without contact since the last one with contact.
  std::size_t without_ = 0;
  // Time stamps of the begin of the contact and of its last frame with contact [us].
  std::int64_t contactUs_ = 0;
  std::int64_t lastTouchUs_ = 0;
  std::vector<Profile> ended_;
};

// The longest grasp of a clip or of a part of a recording.
struct ChosenGrasp {
  // If there are none, `problem` gives the reason.
  GraspFeatures features;
  // Host time of its begin [us since 1970].
  std::int64_t timeUs = 0;
  // GraspSegment::quality.
  double quality = 0.0;
};

// Returns the longest grasp (findPinches()) within frames first..last of a profile (both
// inclusive). A grasp that reaches beyond these frames is cut to them. Throws std::out_of_range
// (frames), Cancelled.
ChosenGrasp graspWithin(const Profile& profile,
                        std::size_t first,
                        std::size_t last,
                        FeatureSet set,
                        const Progress& progress = {});
// The same for a whole profile; `problem` is set for a profile without frames.
ChosenGrasp graspOf(const Profile& profile, FeatureSet set, const Progress& progress = {});

}  // namespace palpate
