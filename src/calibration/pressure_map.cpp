#include "palpate/calibration/pressure_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/filter/gaussian.h"
#include "palpate/signals/characteristic_signals.h"

namespace palpate {
namespace {

constexpr int kMaxMapColumns = 64;
constexpr double kNPerKpaMm2 = 1e-3;  // 1 kPa on 1 mm^2

// Returns the weight of each count in the sum of the filtered matrix; the filter is linear.
std::vector<float> filteredSumWeights(const MatrixLayout& layout) {
  std::vector<float> weights;
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      MatrixValues one = MatrixValues::Zero(layout.rows, layout.columns);
      if (layout.enabled(y, x)) one(y, x) = 1.0F;
      weights.push_back(layout.enabled(y, x) ? gaussianFiltered(one, layout).sum() : 0.0F);
    }
  return weights;
}

}  // namespace

std::optional<double> knownForceN(const PressureFrame& pressures) {
  const bool touched = std::any_of(pressures.matrices.begin(),
                                   pressures.matrices.end(),
                                   [](const MatrixPressure& each) { return each.active > 0; });
  if (touched && !(pressures.areaKnown && pressures.inRange)) return std::nullopt;
  return pressures.forceN;
}

std::optional<double> knownForceN(const MatrixPressure& matrix, bool areaKnown) {
  if (matrix.active > 0 && !(areaKnown && matrix.inRange)) return std::nullopt;
  return matrix.forceN;
}

double taxelForceN(const PressureFrame& frame,
                   const SensorLayout& layout,
                   std::size_t matrix,
                   int row,
                   int column) {
  if (matrix >= frame.matrices.size() || frame.kpa.size() != layout.numCells()) return 0.0;
  const MatrixLayout& of = layout.matrix(matrix);
  const auto first = frame.kpa.begin() + static_cast<std::ptrdiff_t>(layout.offset(matrix));
  const double whole = std::accumulate(first, first + of.rows * of.columns, 0.0);
  const auto own = static_cast<double>(*(first + row * of.columns + column));
  return whole > 0.0 ? frame.matrices[matrix].forceN * own / whole : 0.0;
}

PressureMap::PressureMap(Calibration calibration,
                         const HandDescription& hand,
                         PressureMapOptions options)
    : calibration_(std::move(calibration)),
      handName_(hand.name),
      fullScale_(static_cast<double>(hand.maximumCounts)),
      layout_(hand.layout),
      options_(std::move(options)) {
  if (!calibration_.pressure.valid())
    throw std::invalid_argument("PressureMap: the calibration has no P(K, T)");
  for (const SettingsChange& change : options_.changes) requireFitting(change.settings);
  prepare(hand);
  reset();
}

void PressureMap::requireFitting(const std::vector<SensorSettings>& settings) const {
  if (settings.size() > 1 && settings.size() != layout_->numMatrices())
    throw std::invalid_argument("PressureMap: " + std::to_string(settings.size()) +
                                " settings for " + std::to_string(layout_->numMatrices()) +
                                " matrices");
  for (const SensorSettings& used : settings)
    if (!(used.sensitivity > 0.0))
      throw std::invalid_argument("PressureMap: sensitivity must be above 0, is " +
                                  numberText(used.sensitivity));
  for (const SensorSettings& used : settings)
    if (!(used.thresholdCounts <= fullScale_))
      throw std::invalid_argument("a threshold of " + numberText(used.thresholdCounts) +
                                  " counts is above the hand's full scale, " +
                                  numberText(fullScale_));
}

void PressureMap::useSettings(const std::vector<SensorSettings>& settings) {
  requireFitting(settings);
  const SensorSettings& measured = calibration_.settings;
  for (std::size_t m = 0; m < matrices_.size(); ++m) {
    const SensorSettings& used = settings.empty()       ? measured
                                 : settings.size() == 1 ? settings[0]
                                                        : settings[m];
    matrices_[m].sensitivityRatio = measured.sensitivity / used.sensitivity;
    matrices_[m].extraSdCounts =
        std::abs(measured.thresholdCounts - used.thresholdCounts) * matrices_[m].sensitivityRatio;
  }
  for (DriftCompensation& drift : drift_) drift.reset();
}

void PressureMap::setSettings(const std::vector<SensorSettings>& settings) {
  useSettings(settings);
  options_.settings = settings;
  options_.changes.clear();
  nextChange_ = 0;
}

void PressureMap::prepare(const HandDescription& hand) {
  for (std::size_t m = 0; m < layout_->numMatrices(); ++m) {
    const MatrixLayout& layout = layout_->matrix(m);
    Prepared matrix;
    matrix.offset = layout_->offset(m);
    matrix.rows = layout.rows;
    matrix.columns = layout.columns;
    matrix.taxelAreaMm2 = layout.taxelAreaMm2();
    matrix.saturationCounts = static_cast<double>(hand.saturationOf(m));
    matrix.sensor =
        m < hand.matrices.size() ? hand.matrices[m].temperatureSensor.value_or(SIZE_MAX) : SIZE_MAX;
    if (layout.columns <= kMaxMapColumns) {
      matrix.weights = filteredSumWeights(layout);
      for (int y = 0; y < layout.rows; ++y) {
        std::uint64_t bits = 0;
        for (int x = 0; x < layout.columns; ++x)
          if (layout.enabled(y, x)) bits |= std::uint64_t{1} << x;
        matrix.enabled.push_back(bits);
      }
    }
    matrices_.push_back(std::move(matrix));
  }
}

void PressureMap::reset() {
  DriftCompensationOptions drift;
  if (calibration_.pressure.steadyS > 0.0) drift.steadyS = calibration_.pressure.steadyS;
  if (calibration_.pressure.creepMeasuredS > 0.0)
    drift.maxDurationS =
        std::min(calibration_.pressure.creepMeasuredS, DriftCompensationOptions::kLongestS);
  drift_.assign(matrices_.size(), DriftCompensation(drift));
  nextChange_ = 0;
  useSettings(options_.settings);
}

PressureMap::Contact PressureMap::contactIn(std::span<const float> values,
                                            const Prepared& matrix) const {
  Contact contact;
  if (matrix.enabled.empty()) {
    MatrixValues copy = ConstMatrixMap(values.data(), matrix.rows, matrix.columns);
    copy = copy.unaryExpr([](float v) { return std::isfinite(v) && isTouched(v) ? v : 0.0F; });
    const auto& layout = layout_->matrix(static_cast<std::size_t>(&matrix - matrices_.data()));
    const CharacteristicSignals signals = characteristicSignals(copy, layout);
    return {signals.sum,
            signals.filteredMean,
            signals.active,
            signals.maximum >= matrix.saturationCounts};
  }
  float sum = 0.0F, filtered = 0.0F, maximum = 0.0F;
  rows_.assign(static_cast<std::size_t>(matrix.rows) + 2, 0);
  std::size_t place = 0;
  for (int y = 0; y < matrix.rows; ++y) {
    std::uint64_t bits = 0;
    for (int x = 0; x < matrix.columns; ++x, ++place) {
      const float value = values[place];
      if (!isTouched(value) || !std::isfinite(value)) continue;
      bits |= std::uint64_t{1} << x;
      sum += value;
      filtered += matrix.weights[place] * value;
      maximum = std::max(maximum, value);
    }
    contact.active += std::popcount(bits);
    rows_[static_cast<std::size_t>(y) + 1] = bits | bits << 1 | bits >> 1;
  }
  if (contact.active == 0) return contact;
  // A taxel of the filtered matrix is active when the taxel or a neighbour is active.
  int filteredActive = 0;
  for (std::size_t y = 0; y < matrix.enabled.size(); ++y)
    filteredActive += std::popcount((rows_[y] | rows_[y + 1] | rows_[y + 2]) & matrix.enabled[y]);
  contact.sum = static_cast<double>(sum);
  contact.filteredMean = filteredActive > 0 ? static_cast<double>(filtered) / filteredActive : 0.0;
  contact.saturated = static_cast<double>(maximum) >= matrix.saturationCounts;
  return contact;
}

void PressureMap::apply(const TactileFrame& frame,
                        std::span<const double> degC,
                        PressureFrame& out) {
  if (frame.values.size() != layout_->numCells())
    throw std::invalid_argument("PressureMap: a frame of " + std::to_string(frame.values.size()) +
                                " values, the hand has " + std::to_string(layout_->numCells()));
  while (nextChange_ < options_.changes.size() &&
         frame.hostUs >= options_.changes[nextChange_].fromUs)
    useSettings(options_.changes[nextChange_++].settings);
  const PressureModel& model = calibration_.pressure;
  out.hostUs = frame.hostUs;
  out.kpa.assign(frame.values.size(), 0.0F);
  out.matrices.assign(matrices_.size(), {});
  out.forceN = out.sdForceN = 0.0;
  out.inRange = out.temperatureKnown = true;
  out.areaKnown = model.knowsArea();
  const double timeS = static_cast<double>(frame.hostUs) / kUsPerS;
  for (std::size_t m = 0; m < matrices_.size(); ++m) {
    const Prepared& matrix = matrices_[m];
    const auto count = static_cast<std::size_t>(matrix.rows * matrix.columns);
    const std::span<const float> values = std::span(frame.values).subspan(matrix.offset, count);
    const Contact contact = contactIn(values, matrix);
    MatrixPressure& result = out.matrices[m];
    result.active = contact.active;
    result.saturated = contact.saturated;
    if (contact.active == 0 || !(contact.filteredMean > 0.0)) {
      drift_[m].gainOf(model.driftOfGain, timeS, 0.0, 0.0);
      continue;
    }
    std::optional<double> t;
    if (matrix.sensor < degC.size() && std::isfinite(degC[matrix.sensor]) &&
        degC[matrix.sensor] != 0.0)
      t = degC[matrix.sensor];
    // K is proportional to sensitivity, except for an offset from the threshold.
    const double offset =
        matrix.sensitivityRatio == 1.0 ? 0.0 : calibration_.sensitivityOffset.value_or(0.0);
    const double reading = (contact.filteredMean - offset) * matrix.sensitivityRatio + offset;
    result.staticResponseCounts =
        options_.compensateDrift
            ? drift_[m].gainOf(
                  model.driftOfGain, timeS, reading, t.value_or(model.options.assumedDegC))
            : reading;
    result.compensated = options_.compensateDrift && drift_[m].compensating();
    result.startUnknown = options_.compensateDrift && drift_[m].startUnknown();
    const PressureEstimate estimate = model.pressureAt(result.staticResponseCounts, t);
    result.kpa = estimate.kpa;
    result.sdKpa = matrix.extraSdCounts > 0.0
                       ? std::hypot(estimate.sdKpa, matrix.extraSdCounts * estimate.kpaPerCount)
                       : estimate.sdKpa;
    result.inRange = estimate.inRange && matrix.extraSdCounts == 0.0;
    result.tooLight = estimate.tooLight && matrix.extraSdCounts == 0.0;
    result.temperatureKnown = estimate.temperatureKnown;
    const double scale = result.kpa * contact.active / contact.sum;
    for (std::size_t place = 0; place < count; ++place)
      if (isTouched(values[place]) && std::isfinite(values[place]))
        out.kpa[matrix.offset + place] =
            static_cast<float>(scale * static_cast<double>(values[place]));
    const double areaMm2 = contact.active * matrix.taxelAreaMm2 * model.areaFraction;
    result.forceN = result.kpa * areaMm2 * kNPerKpaMm2;
    result.sdForceN = std::hypot(result.sdKpa * areaMm2 * kNPerKpaMm2,
                                 result.forceN * model.areaFractionSd / model.areaFraction);
    out.forceN += result.forceN;
    out.sdForceN += result.sdForceN;
    out.inRange = out.inRange && result.inRange;
    out.temperatureKnown = out.temperatureKnown && result.temperatureKnown;
  }
}

std::vector<std::string> PressureMap::assumptions() const {
  std::vector<std::string> said;
  if (!calibration_.hand.empty() && calibration_.hand != handName_)
    said.push_back("measured on '" + shortened(calibration_.hand) + "'; this is '" +
                   shortened(handName_) + "', whose readings may stand for other pressures");
  else if (!calibration_.serial.empty() && !options_.serial.empty() &&
           calibration_.serial != options_.serial)
    said.push_back("measured on the sensor with serial number " + calibration_.serial +
                   "; this one (" + options_.serial + ") is assumed to answer alike");
  said.push_back("measured on matrix " + std::to_string(calibration_.matrix) +
                 "; the others are assumed to answer alike");
  if (!calibration_.pressure.knowsArea()) said.emplace_back(kUnknownAreaText);
  const auto settingsText = [](const SensorSettings& s) {
    return "sensitivity " + numberText(s.sensitivity) + ", threshold " +
           numberText(s.thresholdCounts);
  };
  if (options_.settings.empty())
    said.push_back("recorded with the settings of the calibration (" +
                   settingsText(calibration_.settings) + "): assumed");
  for (std::size_t i = 0; i < options_.settings.size(); ++i) {
    const SensorSettings& used = options_.settings[i];
    const std::string which =
        options_.settings.size() == 1 ? "" : "matrix " + std::to_string(i) + ": ";
    if (used.assumed) said.push_back(which + "recorded with " + settingsText(used) + ": assumed");
    if (used.sensitivity != calibration_.settings.sensitivity)
      said.push_back(which + "converted from sensitivity " + numberText(used.sensitivity) + " to " +
                     numberText(calibration_.settings.sensitivity) +
                     (calibration_.sensitivityOffset ? "" : " as if K were proportional to it"));
    if (used.thresholdCounts != calibration_.settings.thresholdCounts)
      said.push_back(which +
                     "a threshold other than the calibration's: the band is wider, everything is "
                     "treated as out of range");
  }
  if (!options_.changes.empty())
    said.push_back("settings that were changed while recording are followed: " +
                   std::to_string(options_.changes.size()) +
                   (options_.changes.size() == 1 ? " change" : " changes"));
  return said;
}

}  // namespace palpate
