// How the taxels of one hand answer pressure and temperature, as measured: noise at rest, gain, default
// settings of the controller.
#pragma once

#include <cstddef>
#include <vector>

namespace palpate {

struct MatrixCharacteristics {
  // Largest count of the unloaded matrix at threshold 0: a line over the temperature of its motor.
  double noiseSlope = 0.0;      // [counts/deg C]
  double noiseIntercept = 0.0;  // [counts]
  double noiseRmse = 0.0;       // of single frames about the line [counts]
  // The mean taxel: a line as well; and the noise of one taxel from frame to frame.
  double meanSlope = 0.0;      // [counts/deg C]
  double meanIntercept = 0.0;  // [counts]
  double taxelSd = 0.0;        // [counts]
  // Places that rest higher than the others (edges of the proximal pads): they make the maximum.
  std::vector<std::size_t> warmPlaces;

  double meanAtRest(double degC) const { return meanIntercept + meanSlope * degC; }
  // How much a warm place rests above the mean [counts].
  double warmAtRest(double degC) const;

  // Settings at power-up.
  double sensitivity = 0.5;
  int thresholdCounts = 0;
};

struct SensorCharacteristics {
  std::vector<MatrixCharacteristics> matrices;
  // Static characteristic at sensitivity 1: P = c0 + c1 T + c2 K + c3 K T [kPa, deg C, counts].
  double pressure[4] = {};
  double saturationCounts = 4095.0;  // readings bend towards it
  // Step response: second order lag, then creep (share of the step, time).
  double lag1S = 0.0, lag2S = 0.0;
  double creepShare = 0.0, creepS = 1.0;

  // Counts per kPa at sensitivity 1: the slope of the characteristic.
  double gainCountsPerKpa(double degC) const;
};

// The SDH-2's. Sources: noise floor of the 65-minute recording at threshold 0 (study 3.4), pressure plane
// over 54 loading steps (3.3), step responses (3.1), largest reading seen 3567.
const SensorCharacteristics& sdh2Sensor();

}  // namespace palpate
