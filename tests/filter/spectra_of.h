// Signals with known content and their spectra, for the tests of filters and of signals/spectrum.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/signals/spectrum.h"

namespace palpate::testing {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Kept {
  std::size_t stretch = 0;
  double timeS = 0.0, binHz = 0.0;
  std::vector<double> psd, magnitude;
};

struct Spectra {
  SpectrumReport report;
  std::vector<Kept> segments;
};

inline Spectra spectraOf(const std::vector<double>& timeS,
                         const std::vector<double>& values,
                         const SpectrumOptions& options = {}) {
  Spectra all;
  all.report = visitSpectra(timeS, values, options, [&](const SpectrumSegment& segment) {
    EXPECT_EQ(segment.segment, all.segments.size());
    EXPECT_EQ(segment.psd.size(), options.numBins());
    EXPECT_EQ(segment.magnitude.size(), options.numBins());
    all.segments.push_back({segment.stretch,
                            segment.timeS,
                            segment.binHz,
                            {segment.psd.begin(), segment.psd.end()},
                            {segment.magnitude.begin(), segment.magnitude.end()}});
  });
  EXPECT_EQ(all.report.segments, all.segments.size());
  return all;
}

inline std::vector<double> evenTimes(std::size_t n, double rateHz, double beginS = 0.0) {
  std::vector<double> timeS(n);
  for (std::size_t i = 0; i < n; ++i) timeS[i] = beginS + static_cast<double>(i) / rateHz;
  return timeS;
}

// Times whose intervals vary by a quarter, as in the real recordings.
inline std::vector<double> jitteredTimes(std::size_t n, double rateHz) {
  std::mt19937 random(7);
  std::normal_distribution<double> interval(1.0, 0.25);
  std::vector<double> timeS(n);
  for (std::size_t i = 1; i < n; ++i)
    timeS[i] = timeS[i - 1] + std::clamp(interval(random), 0.1, 1.9) / rateHz;
  return timeS;
}

inline std::vector<double> tone(const std::vector<double>& timeS, double hz, double amplitude) {
  std::vector<double> values;
  for (const double t : timeS) values.push_back(amplitude * std::sin(2.0 * kPi * hz * t + 0.4));
  return values;
}

inline std::vector<double> noise(std::size_t n, double sd) {
  std::mt19937 random(3);
  std::normal_distribution<double> value(0.0, sd);
  std::vector<double> values(n);
  for (double& v : values) v = value(random);
  return values;
}

}  // namespace palpate::testing
