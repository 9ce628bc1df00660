// A profile storage that passes on everything but the values of frames from another profile. Views
// of a profile (filtered, with computed series) derive from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <palpate/model/profile.h>

namespace palpate {

class ProfileOver : public ProfileStorage {
 public:
  explicit ProfileOver(Profile source) : source_(std::move(source)) {}
  std::size_t numFrames() const override { return source_.numFrames(); }
  std::int64_t frameTimeUs(std::size_t frame) const override { return source_.frameTimeUs(frame); }
  std::size_t numSamples(std::size_t series) const override { return source_.numSamples(series); }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const override {
    return source_.sampleTimeUs(series, sample);
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    return source_.sample(series, sample);
  }
  bool isReady(std::size_t series) const override { return source_.isReady(series); }
  void prepare(std::size_t series, const Progress& progress) const override {
    source_.prepare(series, progress);
  }
  std::optional<std::size_t> frameAt(std::int64_t timeUs) const override {
    return source_.frameAt(timeUs);
  }
  std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const override {
    return source_.sampleAt(series, timeUs);
  }

 protected:
  const Profile source_;
};

}  // namespace palpate
