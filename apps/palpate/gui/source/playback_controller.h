// Advances a Playback by real time and tells the views which frame to show. The clock is a
// parameter, so that tests play without waiting.
#pragma once

#include <QObject>
#include <QTimer>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <palpate/core/time.h>
#include <palpate/playback/playback.h>

namespace palpate::gui {

class PlaybackController : public QObject {
  Q_OBJECT
 public:
  // The speeds that the window offers, ascending.
  static constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};

  explicit PlaybackController(const Clock& clock = systemClock(), QObject* parent = nullptr);

  // Takes another recording (or none) and goes to its first frame. Speed, loop and skipping of gaps
  // don't change.
  void setProfile(const std::optional<Profile>& profile);
  void setProfile(const Profile& profile, std::span<const Gap> gaps);
  // Replaces the gaps, once a long recording has been read completely.
  void setGaps(std::span<const Gap> gaps);
  bool hasFrames() const;
  std::size_t numFrames() const;
  std::size_t frame() const;
  // Position of the cursor from the first frame [s]: at or after the stamp of frame().
  double positionS() const;
  // Stamp of frame() from the first frame [s]; 0 without frames.
  double frameTimeS() const;
  double durationS() const;
  bool playing() const { return playback_ && playback_->playing(); }
  double speed() const noexcept { return speed_; }
  bool loop() const noexcept { return loop_; }
  bool skipGaps() const noexcept { return skipGaps_; }

  void play();
  void pause();
  void togglePlay();
  // Moves by so many frames and pauses.
  void step(std::ptrdiff_t frames);
  void seekFrame(std::size_t frame);
  void seekSeconds(double seconds);
  // Throws std::invalid_argument outside 0.1..16.
  void setSpeed(double factor);
  void faster();
  void slower();
  void setLoop(bool on);
  void setSkipGaps(bool on);

  // Advances by the time since the last call. While playing, the timer calls it at the refresh rate
  // of the screen.
  void tick();

 signals:
  void frameChanged(std::size_t frame);
  void positionChanged(double seconds);
  // Playing, speed, loop or skipping changed, or another recording came.
  void stateChanged();

 private:
  void take(std::optional<Playback> playback);
  void startClock();
  void moved();

  const Clock& clock_;
  QTimer timer_;
  std::optional<Playback> playback_;
  std::int64_t lastTickUs_ = 0;
  std::optional<std::size_t> shownFrame_;
  double speed_ = 1.0;
  bool loop_ = false;
  bool skipGaps_ = false;
};

}  // namespace palpate::gui
