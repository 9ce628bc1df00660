// The numbers that a sender gives its frames: how many frames are missing before each.
//
// A step of the numbers counts as loss only if the sender could have sent that many frames in the
// time: at the rate of its numbers, with twice the time that no number accounts for yet, and a few
// frames more. Any other step is another numbering: the sender was restarted, or a second one
// sends. A number that was missing and comes after all is that of a frame that was overtaken.
#pragma once

#include <cstdint>
#include <optional>

namespace palpate {

class FrameNumbers {
 public:
  struct Step {
    std::optional<std::uint64_t> missing = {};  // empty: not known
    bool late = false;                          // the frame was overtaken by later ones
    bool repeated = false;                      // the frame has the number of the one before it
    bool renumbered = false;                    // the numbers do not continue those before
  };
  // `timeUs`: when the frame arrived or was sent [us], on one clock that doesn't go back; empty:
  // not known, then up to 1000 frames may be missing. mayBeLate: frames may overtake each other,
  // also before the first one.
  Step next(std::uint32_t number, std::optional<std::int64_t> timeUs, bool mayBeLate);

 private:
  bool isMissing(std::int32_t step) const;
  void noteStep(std::int32_t step);
  bool couldBeMissing(std::int32_t missing, std::optional<double> passedUs);

  std::optional<std::uint32_t> last_;
  std::optional<std::uint32_t> late_;
  // Bit k: number last_ - k came; of the last numKnown_ numbers.
  std::uint64_t came_ = 1;
  std::int32_t numKnown_ = 1;
  bool counts_ = false;                 // the numbers grow
  int numRepeated_ = 0;                 // frames with the last number that were left out
  std::optional<std::int64_t> timeUs_;  // of the last frame
  // Numbers and time of the last seconds; older ones weigh less.
  double recentNumbers_ = 0.0;
  double recentUs_ = 0.0;
  // The longest interval of the first frames, until the rate beside it is known: it may be a pause,
  // behind which frames waited in a buffer.
  int numFirst_ = 0;
  double pauseUs_ = 0.0;
  // Numbers that the time could have held and that did not come yet; negative: too many came.
  double outstanding_ = 0.0;
};

}  // namespace palpate
