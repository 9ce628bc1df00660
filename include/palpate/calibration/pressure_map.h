// Applies a calibration to frames, live and offline: kilopascals per taxel, newtons per matrix and
// of the whole hand, each with its uncertainty. What touches one matrix is one contact: P(K, T) of
// its filtered mean, spread over its taxels in proportion to counts, 0 where the count is 0. Force
// = sum over taxels of pressure times taxel area, times the share of the active area that a load
// covers where the calibration knows it. About a microsecond per frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/calibration/calibration.h>
#include <palpate/calibration/drift_compensation.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct MatrixPressure {
  int active = 0;  // taxels above 0
  // K that was used: the filtered mean, at the settings of the calibration, creep taken out
  double staticResponseCounts = 0.0;
  double kpa = 0.0;    // of the contact; 0 without one
  double sdKpa = 0.0;  // of one estimate
  double forceN = 0.0;
  double sdForceN = 0.0;
  bool inRange = true;  // within what was measured; without a contact true
  bool temperatureKnown = true;
  bool saturated = false;    // a taxel is at the sensor's limit: the pressure is higher
  bool compensated = false;  // creep was taken out
};

struct PressureFrame {
  std::int64_t hostUs = 0;
  std::vector<float> kpa;  // as TactileFrame::values [kPa]
  std::vector<MatrixPressure> matrices;
  double forceN = 0.0;    // sum over the matrices
  double sdForceN = 0.0;  // one calibration: their errors go together, so they add up
  bool inRange = true;    // every contact
  bool temperatureKnown = true;
};

// Settings that hold for frames from a moment on.
struct SettingsChange {
  std::int64_t fromUs = 0;               // [us since 1970]
  std::vector<SensorSettings> settings;  // one per matrix, or one for all
};

// Force on one taxel [N]: its share of the matrix's force. 0 where nothing is told.
double taxelForceN(const PressureFrame& frame,
                   const SensorLayout& layout,
                   std::size_t matrix,
                   int row,
                   int column);

struct PressureMapOptions {
  // What the frames were recorded with; nothing: as the calibration. One per matrix, or one for
  // all.
  std::vector<SensorSettings> settings = {};
  std::vector<SettingsChange> changes = {};  // after these, ascending
  bool compensateDrift = true;
};

// Keeps the state of the contacts (for the creep): give it frames in order; reset() in front of
// another recording. Not thread-safe.
class PressureMap {
 public:
  // Throws std::invalid_argument: a calibration without P(K, T), settings of another number.
  PressureMap(Calibration calibration,
              const HandDescription& hand,
              PressureMapOptions options = {});

  // degC: one per temperature sensor of the hand; empty: not known. The frame must be of the hand's
  // layout (throws std::invalid_argument). Values that are no numbers count as 0.
  void apply(const TactileFrame& frame, std::span<const double> degC, PressureFrame& out);
  void reset();
  // Others than before from the next frame on: contacts begin anew. Throws std::invalid_argument.
  void setSettings(const std::vector<SensorSettings>& settings);

  // Assumptions that a reader must know of, a sentence each: what was measured on another matrix,
  // settings nobody recorded, sensitivity converted.
  std::vector<std::string> assumptions() const;
  const Calibration& calibration() const noexcept { return calibration_; }

 private:
  // Of one matrix: what makes its filtered mean fast.
  struct Prepared {
    std::size_t offset = 0;
    int rows = 0, columns = 0;
    std::vector<float> weights;          // what a count adds to the sum of the filtered matrix
    std::vector<std::uint64_t> enabled;  // bits per row; empty: more than 64 columns
    double taxelAreaMm2 = 0.0;
    double sensitivityRatio = 1.0;  // of the calibration to the frames
    double extraSdCounts = 0.0;     // thresholds that differ
    std::size_t sensor = SIZE_MAX;
  };
  struct Contact {
    double sum = 0.0, filteredMean = 0.0;
    int active = 0;
    bool saturated = false;
  };
  Contact contactIn(std::span<const float> values, const Prepared& matrix) const;
  void prepare(const HandDescription& hand);
  void requireFitting(const std::vector<SensorSettings>& settings) const;
  void useSettings(const std::vector<SensorSettings>& settings);

  Calibration calibration_;
  std::shared_ptr<const SensorLayout> layout_;
  PressureMapOptions options_;
  std::vector<Prepared> matrices_;
  std::vector<DriftCompensation> drift_;
  double saturationCounts_ = 0.0;
  std::size_t nextChange_ = 0;  // of options_.changes
  mutable std::vector<std::uint64_t> rows_;
};

}  // namespace palpate
