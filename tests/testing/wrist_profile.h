// Recordings with a further series: a force sensor at the wrist.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "palpate/model/profile_builder.h"

namespace palpate::testing {

inline SeriesDescription wristSeries() {
  return {.name = "wrist",
          .role = {},
          .columns = {{"fx", "N"}, {"fz", "N"}, {"Torque Z", "N m"}},
          .source = "tcp:localhost:9871"};
}

// Another profile with "wrist" beside its own series: sample i, of `count`, 50 ms after the one
// before, the first 30 ms after the first frame; it has i + 0.5, -2 i (not known where i ends in
// 3), and 0.
inline Profile withWrist(const Profile& source, int count = 40) {
  ProfileBuilder builder(source.hand());
  const std::size_t wrist = builder.addSeries(wristSeries());
  for (std::size_t i = 0; i < source.numFrames(); ++i) builder.addFrame(source.frame(i));
  for (std::size_t s = 0; s < kHandSeries; ++s)
    for (std::size_t i = 0; i < source.numSamples(s); ++i)
      builder.addSample(s, source.sampleTimeUs(s, i), source.sample(s, i).values);
  const std::int64_t beginUs = source.frameTimeUs(0) + 30'000;
  for (int i = 0; i < count; ++i)
    builder.addSample(
        wrist,
        beginUs + i * 50'000,
        std::vector<double>{
            i + 0.5, i % 10 == 3 ? std::numeric_limits<double>::quiet_NaN() : 2.0 * -i, 0.0});
  return builder.finish(source.info());
}

}  // namespace palpate::testing
