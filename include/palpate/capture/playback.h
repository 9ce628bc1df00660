// Playback of a recording by its real time stamps: which frame belongs to "now". A virtual clock
// that runs at a speed over the recording's own time; it knows nothing of threads and screens, and
// is moved by whoever pulls (a window's refresh, a replay thread, a test).
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

  // Stands at frame 0, paused, speed 1, no loop. An empty profile can't be played; it stands still.
  explicit Playback(Profile profile);
  // Its gaps are known already (timingOf() reads every stamp).
  Playback(Profile profile, std::span<const Gap> gaps);

  void setGaps(std::span<const Gap> gaps);

  const Profile& profile() const noexcept { return profile_; }
  bool playing() const noexcept { return playing_; }
  bool loop() const noexcept { return loop_; }
  double speed() const noexcept { return speed_; }
  // Position in the recording's time [us since 1970], between the first and the last stamp.
  std::int64_t positionUs() const noexcept { return positionUs_; }
  // The last frame at or before the position.
  std::size_t frame() const;

  // Starts at the position; at the end it starts over from the beginning.
  void play();
  void pause() noexcept { playing_ = false; }
  void setLoop(bool on) noexcept { loop_ = on; }
  // Throws std::invalid_argument outside 0.1..16 or NaN.
  void setSpeed(double factor);
  // Moves to a frame (clamped) or time (clamped); playing goes on from there.
  void seekFrame(std::size_t frame);
  void seekTime(std::int64_t timeUs);
  // One frame (or `frames`) forward or back, clamped at both ends; pauses.
  void step(std::ptrdiff_t frames);
  // Lets `elapsedUs` of real time pass; stops at the last frame. There it pauses, or (loop) starts
  // over at the next call, so that the last frame is seen.
  // Gaps in the recording are played through in real time, too; see skipGaps.
  void advance(std::int64_t elapsedUs);
  // Whether gaps longer than max(1 s, 5 median intervals) are jumped over; off by default.
  void setSkipGaps(bool on) noexcept { skipGaps_ = on; }
  bool skipGaps() const noexcept { return skipGaps_; }

 private:
  std::int64_t firstUs() const;
  std::int64_t lastUs() const;

  Profile profile_;
  std::vector<std::pair<std::int64_t, std::int64_t>> gapsUs_;  // begin, end of each gap [us]
  bool playing_ = false;
  bool loop_ = false;
  bool skipGaps_ = false;
  double speed_ = 1.0;
  std::int64_t positionUs_ = 0;
  double remainderUs_ = 0.0;  // fraction of a microsecond not yet advanced
};

}  // namespace palpate
