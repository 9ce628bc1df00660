// Profiles of which a part can't be read, as when a block of their file is damaged.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/model/profile.h"

namespace palpate::testing {

// Another profile without the values of its frames first..last.
class DamagedStorage final : public ProfileStorage {
 public:
  DamagedStorage(Profile source, std::size_t first, std::size_t last)
      : source_(std::move(source)), first_(first), last_(last) {}
  std::size_t numFrames() const override { return source_.numFrames(); }
  std::int64_t frameTimeUs(std::size_t i) const override { return source_.frameTimeUs(i); }
  void readFrame(std::size_t i, TactileFrame& out) const override {
    if (first_ <= i && i <= last_) throw FormatError("x.palpate", "block 7 is damaged");
    source_.readFrame(i, out);
  }
  std::size_t numSamples(std::size_t series) const override { return source_.numSamples(series); }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t i) const override {
    return source_.sampleTimeUs(series, i);
  }
  Sample sample(std::size_t series, std::size_t i) const override {
    return source_.sample(series, i);
  }

 private:
  Profile source_;
  std::size_t first_;
  std::size_t last_;
};

inline Profile withDamage(const Profile& source, std::size_t first, std::size_t last) {
  return {source.info(), source.hand(), std::make_shared<DamagedStorage>(source, first, last)};
}

}  // namespace palpate::testing
