// Playback of a recording by its time stamps: a virtual clock that runs at an adjustable speed over
// the recording's own time and gives the frame to show. It uses neither threads nor a display; the
// caller advances it (the window's refresh, a replay thread, a test).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/model/timing.h>

namespace palpate {

class Playback {
 public:
  static constexpr double kMinimumSpeed = 0.1;
  static constexpr double kMaximumSpeed = 16.0;

  // Starts at frame 0, paused, speed 1, no loop. An empty profile can't be played; its position
  // never changes.
  explicit Playback(Profile profile);
  // For callers that know the gaps already (timingOf() would read every stamp).
  Playback(Profile profile, std::span<const Gap> gaps);

  void setGaps(std::span<const Gap> gaps);

  const Profile& profile() const noexcept { return profile_; }
  bool playing() const noexcept { return playing_; }
  bool loop() const noexcept { return loop_; }
  double speed() const noexcept { return speed_; }
  // Position in the recording's time [us since 1970], between the first and the last stamp.
  std::int64_t positionUs() const noexcept { return positionUs_; }
  // The last frame at or before the position; 0 of an empty profile. It reads nothing.
  std::size_t frame() const noexcept { return frame_; }

  // Starts at the position; at the end it starts over from the beginning.
  void play();
  void pause() noexcept { playing_ = false; }
  void setLoop(bool on) noexcept { loop_ = on; }
  // Throws std::invalid_argument outside 0.1..16 or NaN.
  void setSpeed(double factor);
  // Moves to a frame (clamped) or time (clamped); playback continues from there.
  void seekFrame(std::size_t frame);
  void seekTime(std::int64_t timeUs);
  // One frame (or `frames`) forward or back, clamped at both ends; pauses.
  void step(std::ptrdiff_t frames);
  // Advances by `elapsedUs` of real time; stops at the last frame. There it pauses or, with loop
  // on, starts over at the next call, so that the last frame is shown. Gaps in the recording are
  // played in real time, too; see setSkipGaps().
  void advance(std::int64_t elapsedUs);
  // Whether gaps longer than max(1 s, 5 median intervals) are skipped; off by default.
  void setSkipGaps(bool on) noexcept { skipGaps_ = on; }
  bool skipGaps() const noexcept { return skipGaps_; }

 private:
  std::int64_t firstUs() const;
  std::int64_t lastUs() const;
  void moveTo(std::int64_t timeUs, std::size_t frame);

  Profile profile_;
  std::vector<std::pair<std::int64_t, std::int64_t>> gapsUs_;  // begin, end of each gap [us]
  bool playing_ = false;
  bool loop_ = false;
  bool skipGaps_ = false;
  double speed_ = 1.0;
  std::int64_t positionUs_ = 0;
  std::size_t frame_ = 0;     // at positionUs_
  double remainderUs_ = 0.0;  // fraction of a microsecond not yet advanced
};

}  // namespace palpate
