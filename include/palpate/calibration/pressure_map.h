// Applies a calibration to frames, live and offline: kilopascals per taxel, newtons per matrix and
// for the whole hand, each with its uncertainty. All active taxels of a matrix are treated as one
// contact: its pressure is P(K, T) of the filtered mean, distributed over its taxels in proportion
// to their counts, 0 where the count is 0. Force = sum over taxels of pressure times taxel area,
// times the share of the active area that a load covers if the calibration knows it. About a
// microsecond per frame.
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

// Pressure and force of one matrix in one frame.
struct MatrixPressure {
  int active = 0;  // taxels above 0
  // K that was used [counts]: the filtered mean, converted to the settings of the calibration,
  // without creep.
  double staticResponseCounts = 0.0;
  double kpa = 0.0;    // of the contact; 0 without contact
  double sdKpa = 0.0;  // of a single estimate
  double forceN = 0.0;
  double sdForceN = 0.0;
  // Whether the pressure is within the measured range; true without contact.
  bool inRange = true;
  bool tooLight = false;  // out of range only because it is lighter than all that was measured
  bool temperatureKnown = true;
  bool saturated = false;    // a taxel is saturated, so the true pressure is higher
  bool compensated = false;  // creep was removed
  // The load was there in the first frame: creep counts from that frame, because it is not known
  // how long the load had lasted. False without a removal of creep.
  bool startUnknown = false;
};

// Pressures and forces of all matrices in one frame.
struct PressureFrame {
  std::int64_t hostUs = 0;
  std::vector<float> kpa;  // as TactileFrame::values [kPa]
  std::vector<MatrixPressure> matrices;
  double forceN = 0.0;  // sum over the matrices
  // Sum of the standard deviations: the errors of all matrices come from one calibration.
  double sdForceN = 0.0;
  bool inRange = true;  // for every contact
  bool temperatureKnown = true;
  // Whether the calibration knows the area of its indenter (PressureModel::knowsArea()). If not,
  // all forces are upper limits.
  bool areaKnown = true;
};

// Force of the hand, and of one matrix [N]; nothing where a contact is outside the measured range,
// or the area of the indenter isn't known.
std::optional<double> knownForceN(const PressureFrame& pressures);
std::optional<double> knownForceN(const MatrixPressure& matrix, bool areaKnown);

// What tables say where the area of the indenter is not known.
inline constexpr const char* kUnknownAreaText =
    "the area of the indenter is not known (calibrate pressure --area MM2): forces are upper "
    "limits, 2.3 times the true ones with the study's indenter; tables leave them empty";

// Settings that hold for frames from a certain time on.
struct SettingsChange {
  std::int64_t fromUs = 0;  // [us since 1970]
  // Settings, one per matrix or one for all.
  std::vector<SensorSettings> settings;
};

// Force on one taxel [N]: its share of the force of the matrix; 0 where there is no force.
double taxelForceN(const PressureFrame& frame,
                   const SensorLayout& layout,
                   std::size_t matrix,
                   int row,
                   int column);

struct PressureMapOptions {
  // Settings that the frames were recorded with, one per matrix, or one for all; empty: those of
  // the calibration.
  std::vector<SensorSettings> settings = {};
  std::vector<SettingsChange> changes = {};  // later changes of the settings, ascending
  bool compensateDrift = true;
  // ProfileInfo::serial of the sensor that the frames are of; empty: not known.
  std::string serial = {};
};

// Converts frames and keeps the state of the contacts for the removal of creep: pass frames in
// order, and call reset() before another recording. Not thread-safe.
class PressureMap {
 public:
  // Throws std::invalid_argument for a calibration without P(K, T), and for a wrong number of
  // settings.
  PressureMap(Calibration calibration,
              const HandDescription& hand,
              PressureMapOptions options = {});

  // `degC` has one value per temperature sensor of the hand; empty: not known. Throws
  // std::invalid_argument unless the frame has the hand's layout. Values that are not finite count
  // as 0.
  void apply(const TactileFrame& frame, std::span<const double> degC, PressureFrame& out);
  void reset();
  // Sets the settings from the next frame on; contacts begin anew. Throws std::invalid_argument.
  void setSettings(const std::vector<SensorSettings>& settings);

  // The assumptions of the result that a reader must know, one sentence each: a calibration that
  // was measured on another hand, sensor or matrix, with an indenter of unknown area; settings that
  // are not recorded, a converted sensitivity.
  std::vector<std::string> assumptions() const;
  const Calibration& calibration() const noexcept { return calibration_; }

 private:
  // Data of one matrix, prepared for a fast filtered mean.
  struct Prepared {
    std::size_t offset = 0;
    int rows = 0, columns = 0;
    // Contribution of a count to the sum of the filtered matrix.
    std::vector<float> weights;
    // Rows as bits, 1 for each enabled taxel; empty with more than 64 columns.
    std::vector<std::uint64_t> enabled;
    double taxelAreaMm2 = 0.0;
    double saturationCounts = 0.0;
    // Sensitivity of the calibration / that of the frames.
    double sensitivityRatio = 1.0;
    double extraSdCounts = 0.0;  // from thresholds that differ
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
  std::string handName_;
  double fullScale_ = 0.0;  // [counts]
  std::shared_ptr<const SensorLayout> layout_;
  PressureMapOptions options_;
  std::vector<Prepared> matrices_;
  std::vector<DriftCompensation> drift_;
  std::size_t nextChange_ = 0;  // index into options_.changes
  mutable std::vector<std::uint64_t> rows_;
};

}  // namespace palpate
