// How the taxels of one hand respond to pressure and temperature, from measurements: noise at rest,
// gain, and the default settings of the controller. The emulated sensor and the threshold
// calculation use it.
#pragma once

#include <cstddef>
#include <vector>

namespace palpate {

// A taxel whose reading at rest and whose noise are larger than those of the other taxels of its
// matrix.
struct OffsetTaxel {
  std::size_t place = 0;  // in the matrix, row by row
  // Reading at rest [counts], as a line over the temperature [deg C] of the nearest motor:
  // intercept + slope * temperature.
  double intercept = 0.0;
  double slope = 0.0;  // [counts/deg C]
  double sd = 0.0;     // noise from frame to frame [counts]
};

// Readings of one unloaded matrix, and its default settings.
struct MatrixCharacteristics {
  // The largest count of the unloaded matrix at threshold 0, as a line over the temperature of the
  // nearest motor.
  double noiseSlope = 0.0;      // [counts/deg C]
  double noiseIntercept = 0.0;  // [counts]
  double noiseRmse = 0.0;       // scatter of single frames about the line [counts]
  // The reading of an ordinary taxel at rest, also as a line; and its noise from frame to frame:
  // the part of the taxel alone, and the part that all taxels of the matrix share.
  double restSlope = 0.0;      // [counts/deg C]
  double restIntercept = 0.0;  // [counts]
  double taxelSd = 0.0;        // [counts]
  double sharedSd = 0.0;       // [counts]
  // Taxels at the edges of the proximal pads with a larger reading at rest: they determine the
  // maximum of the matrix.
  std::vector<OffsetTaxel> raised;

  double restCounts(double degC) const { return restIntercept + restSlope * degC; }

  // Settings of the controller at power-up.
  double sensitivity = 0.5;
  int thresholdCounts = 0;
};

// Static and dynamic characteristic of the sensor. The static part comes from the study's plane
//
// P = c0 + c1 T + c2 K + c3 K T [kPa, deg C, counts]
//
// It holds for K = mean of the Gaussian-filtered active taxels at sensitivity 1 and threshold 100
// under a stamp of 1.1 cm^2. It gives two properties of a single taxel. The first is how many
// counts one more kPa adds: the inverse slope times `countsPerMean`, since a taxel under the stamp
// reads more than the mean K, which includes the edge. The second is the pressure below which the
// rubber's surface hardly responds: the plane's pressure at K = 0, minus `thresholdKpa`, the part
// that the threshold of 100 alone explains.
//   counts above rest = sensitivity * gain(T) * f(P),  f(P) = P - P0 (1 - e^(-P / P0)),
//   P0 = deadZoneKpa(T)
// f is close to P^2 / (2 P0) for small P and to P - P0 for large P.
struct SensorCharacteristics {
  std::vector<MatrixCharacteristics> matrices;
  double pressure[4] = {};  // c0..c3 of the plane
  // Reading of a taxel under the stamp / K.
  double countsPerMean = 1.0;
  double thresholdKpa = 0.0;  // [kPa]
  // Upper limit that readings approach [counts]. HandDescription says from which value on a taxel
  // counts as saturated.
  double largestCounts = 4095.0;
  // Share of its pressure that a taxel passes on to each of its four neighbours through the rubber.
  double neighbourFraction = 0.0;
  // Step response: a second-order lag (two time constants [s]), then creep (share of the step, and
  // its time constant [s]). releaseS is the time constant of the reading after the load is removed
  // [s].
  double lag1S = 0.0, lag2S = 0.0;
  double creepFraction = 0.0, creepS = 1.0;
  double releaseS = 0.0;

  // Counts per kPa of one taxel at sensitivity 1, well above the dead zone. Here and below `degC`
  // is the temperature of the whole hand (mean of its sensors), as in the plane.
  double gainCountsPerKpa(double degC) const;
  // Pressure below which the surface hardly responds [kPa]; at least 0.05 kPa.
  double deadZoneKpa(double degC) const;
  // Counts above rest of one taxel under a steady pressure [kPa] at sensitivity 1, without
  // saturation.
  double countsAbove(double kpa, double degC) const;
};

}  // namespace palpate
