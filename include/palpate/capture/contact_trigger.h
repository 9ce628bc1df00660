// Tells from the frames of a running hand when something is touched and when it is released, so
// that a recording begins and ends by itself. One active taxel in one frame may be noise; several
// of them in several consecutive frames are a contact.
#pragma once

#include <cstdint>
#include <optional>

#include <palpate/core/option_check.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct ContactTriggerOptions {
  // A taxel touches when its value is above this, in the unit of the hand (an SDH-2's: counts).
  // With 0 every active taxel touches.
  static constexpr OptionRange kThreshold{0.0, 1e9};
  double threshold = 0.0;
  // Taxels that touch in each of the frames, over all matrices, 1..1,000,000.
  int taxels = 3;
  int frames = 3;  // consecutive frames, 1..1,000,000

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

class ContactTrigger {
 public:
  // Throws std::invalid_argument (options).
  explicit ContactTrigger(const ContactTriggerOptions& options = {});

  // Adds a frame, in order of time.
  void add(const TactileFrame& frame);
  // Stamp of the first frame of the first contact [us since 1970]; empty: there was none yet.
  std::optional<std::int64_t> firstContactUs() const noexcept { return firstContactUs_; }
  // Stamp of the first frame since which there has been no contact; empty while there is one, and
  // before the first one. Frames that are missing are no release: what happened then isn't known.
  std::optional<std::int64_t> releasedUs() const noexcept { return releasedUs_; }
  // Stamp of the first frame of the frames in a row that touch, up to now, be they enough for a
  // contact or not yet; empty: the newest frame doesn't touch.
  std::optional<std::int64_t> touchingSinceUs() const noexcept { return touchingSinceUs_; }

 private:
  bool touches(const TactileFrame& frame) const noexcept;

  const ContactTriggerOptions options_;
  int inRow_ = 0;  // newest consecutive frames that touch, at most options_.frames
  std::optional<std::int64_t> touchingSinceUs_;
  std::optional<std::int64_t> firstContactUs_;
  std::optional<std::int64_t> releasedUs_;
};

}  // namespace palpate
