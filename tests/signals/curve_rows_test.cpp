// Tables of curves, spectra and centres of force.
#include "palpate/signals/curve_rows.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/signals/centre_rows.h"
#include "palpate/signals/frame_difference.h"
#include "palpate/signals/spectrum_rows.h"

#include "testing/testing.h"

namespace palpate::curve_rows_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string textOf(std::unique_ptr<ResultTable> table, bool unitsRow = false) {
  std::string text;
  writeTableText(*table, {.unitsRow = unitsRow}, [&](const std::string& lines) { text += lines; });
  return text;
}

// Two frames 0.5 s apart; in the second one matrix 1 reads 10 at (2, 7) and 30 at (3, 9).
Profile touched() {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  builder.addFrame(1'000'000, frame.values);
  frame.matrix(1)(7, 2) = 10.0F;
  frame.matrix(1)(9, 3) = 30.0F;
  builder.addFrame(1'500'000, frame.values);
  return builder.finish({});
}

TEST(CurveRows, AreThoseOfTheFrames) {
  EXPECT_EQ(textOf(curveTable({{"a", {{0.0, 0.5, 1.0}, {1.0, kNan, 3.0}}},
                               {"b,c", {{0.0, 0.5, 1.0}, {4.0, 5.0, 6.0}}}},
                              1,
                              2)),
            "frame,time_s,a,\"b,c\"\n1,0.5,,5\n2,1,3,6\n");
}

TEST(CurveRows, OfAnAverageNameTheBand) {
  const AverageCurve average{.stepS = 0.1,
                             .timeS = {0.0, 0.1},
                             .middle = {2.0, kNan},
                             .low = {1.0, kNan},
                             .high = {3.0, kNan},
                             .count = {2, 1}};
  EXPECT_EQ(textOf(averageTable(average, {}, {}, {})),
            "time_s,curves,mean,low,high\n0.000000,2,2,1,3\n0.100000,1,,,\n");
  EXPECT_TRUE(textOf(averageTable(average, {.band = AverageBand::kPercentiles}, {}, {}))
                  .starts_with("time_s,curves,median,p10,p90\n"));
}

TEST(CurveRows, CompareFrameByFrame) {
  const TimedProfile a = timedProfile(touched());
  // B is the same: A - B is 0. Means are over the touched taxels: (10 + 30) / 2.
  const std::string text = textOf(comparisonTable(a, a, 0.0));
  EXPECT_TRUE(text.starts_with(
      "time_s,frame_a,frame_b,matrix,mean_a,mean_b,difference_mean,difference_rms\n"
      "0.000000,0,0,0,0,0,0,0\n"))
      << text;
  EXPECT_NE(text.find("\n0.500000,1,1,1,20,20,0,0\n"), std::string::npos) << text;
  FramePairs pairs(a, a, 0.0);
  ASSERT_TRUE(pairs.next());
  ASSERT_TRUE(pairs.next());
  EXPECT_EQ(pairs.pair().frameB, 1u);
  EXPECT_EQ(pairs.inA().matrix(1)(9, 3), 30.0F);
  EXPECT_EQ(pairs.inB().matrix(1)(9, 3), 30.0F);
  EXPECT_FALSE(pairs.next());
  const auto apart = comparisonTable(a, a, 100.0);
  std::vector<Cell> cells;
  EXPECT_FALSE(apart->next(cells));
  ASSERT_EQ(apart->notes().size(), 1u);
}

TEST(CentreRows, WeighThePlacesByTheValues) {
  // (10 * 2 + 30 * 3) / 40 = 2.75 and (10 * 7 + 30 * 9) / 40 = 8.5 taxels, 3.4 mm apart.
  const auto centre = forceCentre(touched().frame(1), 1);
  ASSERT_TRUE(centre);
  EXPECT_DOUBLE_EQ(centre->x, 2.75);
  EXPECT_DOUBLE_EQ(centre->y, 8.5);
  EXPECT_NEAR(centre->xMm, 2.75 * 3.4, 1e-9);
  EXPECT_FALSE(forceCentre(touched().frame(1), 0));
  const std::string text = textOf(centreTable(touched()), true);
  EXPECT_TRUE(
      text.starts_with("frame,time_ms,matrix,sum,x,y,x_mm,y_mm\n"
                       ",ms,,counts,taxels,taxels,mm,mm\n1,1500,1,40,2.75,8.5,"))
      << text;
  EXPECT_EQ(textOf(centreTable(touched(), 0)), "frame,time_ms,matrix,sum,x,y,x_mm,y_mm\n");
}

TEST(SpectrumRows, AreOneForEachFrequency) {
  MeanSpectrum mean;
  mean.binHz = 0.5;
  mean.psd = {1.0, 2.0};
  mean.magnitude = {3.0, 4.0};
  EXPECT_EQ(textOf(meanSpectrumTable(mean, "counts"), true),
            "frequency_hz,psd,magnitude\nHz,counts^2/Hz,counts\n0,1,3\n0.5,2,4\n");
  EXPECT_EQ(textOf(peakTable({{1, 0.5, 2.0, 4.0, 0.7, 3.0}})),
            "frequency_hz,psd,amplitude,width_hz,prominence_db\n0.5,2,4,0.7,3\n");
  Coherence found;
  found.binHz = 0.5;
  found.coherence = {kNan, 1.0};
  found.phaseDeg = {kNan, -90.0};
  found.psdA = {0.0, 2.0};
  found.psdB = {0.0, 3.0};
  EXPECT_EQ(textOf(coherenceTable(found)),
            "frequency_hz,coherence,phase_deg,psd_a,psd_b\n0,,,0,0\n0.5,1,-90,2,3\n");
}

TEST(SpectrumRows, AreThoseThatVisitSpectraPasses) {
  std::vector<double> timeS, values;
  for (int i = 0; i < 20; ++i) {
    timeS.push_back(0.1 * i);
    values.push_back(i % 4);
  }
  const SpectrumOptions options{.window = 8, .overlap = 4};
  std::string expected = "segment,time_s,frequency_hz,psd,magnitude\n";
  std::size_t segments = 0;
  visitSpectra(timeS, values, options, [&](const SpectrumSegment&) { ++segments; });
  const std::string text =
      textOf(spectraTable(std::make_unique<SpectrumRun>(timeS, values, options)));
  EXPECT_TRUE(text.starts_with(expected));
  // Frequencies 0..4 of each.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
            static_cast<std::ptrdiff_t>(1 + 5 * segments));
}

}  // namespace
}  // namespace palpate::curve_rows_test
