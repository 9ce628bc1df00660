// How the taxels of one hand answer pressure and temperature, as measured: noise at rest, gain,
// default settings of the controller.
#pragma once

#include <cstddef>
#include <vector>

namespace palpate {

// A taxel whose reading at rest and whose noise are larger than those of the other taxels of its
// matrix.
struct OffsetTaxel {
  std::size_t place = 0;   // in the matrix, row by row
  double intercept = 0.0;  // reading at rest: a line over the temperature of its motor [counts]
  double slope = 0.0;      // [counts/deg C]
  double sd = 0.0;         // from frame to frame [counts]
};

struct MatrixCharacteristics {
  // Largest count of the unloaded matrix at threshold 0: a line over the temperature of its motor.
  double noiseSlope = 0.0;      // [counts/deg C]
  double noiseIntercept = 0.0;  // [counts]
  double noiseRmse = 0.0;       // of single frames about the line [counts]
  // An ordinary taxel at rest: a line as well; and its noise from frame to frame, its own and what
  // all taxels of the matrix share.
  double restSlope = 0.0;      // [counts/deg C]
  double restIntercept = 0.0;  // [counts]
  double taxelSd = 0.0;        // [counts]
  double sharedSd = 0.0;       // [counts]
  // Edges of the proximal pads: they make the maximum.
  std::vector<OffsetTaxel> raised;

  double restCounts(double degC) const { return restIntercept + restSlope * degC; }

  // Settings at power-up.
  double sensitivity = 0.5;
  int thresholdCounts = 0;
};

// Static characteristic. The study's plane P = c0 + c1 T + c2 K + c3 K T [kPa, deg C, counts] holds
// for K = mean of the Gaussian-filtered active taxels at sensitivity 1 and threshold 100 under a
// stamp of 1.1 cm^2. It says two things about a single taxel: how many counts one more kPa makes
// (the slope, times `countsPerMean`: a taxel under the stamp reads more than that mean, which
// spreads over the edge), and below which pressure the rubber's surface hardly answers (the plane's
// pressure at K = 0, less `thresholdKpa`, what the threshold of 100 alone explains of it).
//   counts above rest = sensitivity * gain(T) * f(P),  f(P) = P - P0 (1 - e^(-P / P0)),
//   P0 = deadZoneKpa(T)
// f begins as P^2 / (2 P0) and becomes P - P0.
struct SensorCharacteristics {
  std::vector<MatrixCharacteristics> matrices;
  double pressure[4] = {};     // c0..c3
  double countsPerMean = 1.0;  // reading of a taxel under the stamp / K
  double thresholdKpa = 0.0;   // [kPa]
  // Readings bend towards it [counts]; from where on one counts as saturated: HandDescription.
  double largestCounts = 4095.0;
  // Share of its pressure that a taxel passes on to each of its four neighbours, through the
  // rubber.
  double neighbourFraction = 0.0;
  // Step response: second order lag, then creep (share of the step, time); and how fast the surface
  // lets go.
  double lag1S = 0.0, lag2S = 0.0;
  double creepFraction = 0.0, creepS = 1.0;
  double releaseS = 0.0;

  // Counts per kPa of one taxel at sensitivity 1, well above the dead zone.
  double gainCountsPerKpa(double degC) const;
  // degC: of the whole hand (mean of its sensors), as in the plane. At least 0.05 kPa.
  double deadZoneKpa(double degC) const;
  // Counts above rest of one taxel under a steady pressure [kPa], at sensitivity 1; not saturated.
  double countsAbove(double kpa, double degC) const;
};

// The SDH-2's. Sources: noise of each taxel in the 65-minute recording at threshold 0, and the
// lines of the maximum (study 3.4); the plane over 54 loading steps (3.3); countsPerMean,
// thresholdKpa, neighbourFraction: fit of the 24 shared steps (K to 28..52 counts rms by where the
// stamp stands between taxels, without bias; one taxel under it reads up to 2700 counts); lag: 63 %
// of a robot's grasp within 0.19 s; creep: median drift of the steps, 2.9 % of K per second;
// release: a pen's contact falls from 80 to 10 % in 60..90 ms; largest reading seen 3567.
const SensorCharacteristics& sdh2Sensor();

}  // namespace palpate
