#include "palpate/signals/spectrogram.h"

#include <stdexcept>

#include "palpate/core/error.h"

#include "filter/spectra_of.h"
#include "testing/testing.h"

namespace palpate::spectrogram_test {
namespace {

using testing::evenTimes;
using testing::noise;
using testing::spectraOf;
using testing::tone;

TEST(Spectrogram, KeepsWhatIsVisited) {
  auto timeS = evenTimes(100, 20.0);
  const auto later = evenTimes(60, 40.0, 30.0);
  timeS.insert(timeS.end(), later.begin(), later.end());
  const auto values = noise(160, 10.0);
  const auto spectrogram = spectrogramOf(timeS, values);
  const auto visited = spectraOf(timeS, values);
  ASSERT_EQ(spectrogram.parts.size(), 2u);
  EXPECT_EQ(spectrogram.numBins, 17u);
  EXPECT_EQ(spectrogram.report.segments, visited.segments.size());
  std::size_t segment = 0;
  double psd = 0.0, magnitude = 0.0;
  for (const SpectrogramPart& part : spectrogram.parts) {
    ASSERT_EQ(part.psd.size(), part.segments * 17);
    for (std::size_t i = 0; i < part.segments; ++i, ++segment) {
      const auto& expected = visited.segments.at(segment);
      EXPECT_NEAR(part.firstS + static_cast<double>(i) * part.stepS, expected.timeS, 1e-9);
      EXPECT_EQ(part.binHz, expected.binHz);
      for (std::size_t k = 0; k < 17; ++k) {
        EXPECT_FLOAT_EQ(part.psd[i * 17 + k], static_cast<float>(expected.psd[k]));
        EXPECT_FLOAT_EQ(part.magnitude[i * 17 + k], static_cast<float>(expected.magnitude[k]));
        psd = std::max(psd, expected.psd[k]);
        magnitude = std::max(magnitude, expected.magnitude[k]);
      }
    }
  }
  EXPECT_EQ(segment, visited.segments.size());
  EXPECT_EQ(spectrogram.largestPsd, psd);
  EXPECT_EQ(spectrogram.largestMagnitude, magnitude);
}

TEST(Spectrogram, OfALongSeriesTakesFewerSegments) {
  const auto timeS = evenTimes(30'000, 100.0);
  const auto values = tone(timeS, 12.5, 7.0);
  const auto all = spectrogramOf(timeS, values);
  EXPECT_EQ(all.report.hop, 2u);
  EXPECT_LE(all.report.segments, 20'000u);
  EXPECT_NEAR(all.parts.at(0).stepS, 0.02, 1e-12);
  EXPECT_NEAR(all.mean.strongestHz(), 12.5, 1e-9);
  // 513 bins: 4000 cells hold 7 segments.
  const auto few = spectrogramOf(
      timeS, values, {.spectrum = {.window = 1024, .overlap = 1023}, .maxCells = 4000});
  EXPECT_LE(few.report.segments, 7u);
  EXPECT_GE(few.report.segments, 6u);
  // One segment that is larger than that.
  EXPECT_EQ(
      spectrogramOf(timeS, values, {.spectrum = {.window = 16'384, .overlap = 0}, .maxCells = 10})
          .report.segments,
      1u);
  EXPECT_EQ(spectrogramOf(timeS, values, {.spectrum = {.maxSegments = 30}}).report.segments, 30u);
}

TEST(Spectrogram, OfTooLittleHasNoPart) {
  const auto timeS = evenTimes(20, 100.0);
  const auto none = spectrogramOf(timeS, noise(20, 1.0));
  EXPECT_TRUE(none.parts.empty());
  EXPECT_NEAR(none.report.rateHz, 100.0, 1e-9) << "what there is is said all the same";
}

TEST(Spectrogram, RefusesAndCanBeCancelled) {
  const auto timeS = evenTimes(200, 100.0);
  EXPECT_THROW(spectrogramOf(timeS, timeS, {.spectrum = {.window = 1}}), std::invalid_argument);
  EXPECT_THROW(spectrogramOf(timeS, timeS, {.spectrum = {}, .maxSegments = 0}),
               std::invalid_argument);
  EXPECT_THROW(spectrogramOf(timeS, timeS, {.spectrum = {}, .maxCells = 0}), std::invalid_argument);
  EXPECT_THROW(spectrogramOf(timeS, timeS, {}, [](double) { return false; }), Cancelled);
}

TEST(Spectrogram, DecibelsEndAtTheFloor) {
  EXPECT_DOUBLE_EQ(decibels(100.0, -30.0), 20.0);
  EXPECT_DOUBLE_EQ(decibels(0.1, -30.0), -10.0);
  EXPECT_DOUBLE_EQ(decibels(1e-9, -30.0), -30.0);
  EXPECT_DOUBLE_EQ(decibels(0.0, -30.0), -30.0);
}

}  // namespace
}  // namespace palpate::spectrogram_test
