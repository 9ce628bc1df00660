#include "palpate/batch/derived_series.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/slip/sensor_slip_detector.h"

namespace palpate {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// Reads the frames of a profile one after the other.
class FrameSeries : public ExportedSeries {
 public:
  FrameSeries(const Profile& profile, std::string name)
      : profile_(profile), name_(std::move(name)) {}

  const std::string& name() const override { return name_; }
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t numRows() const override { return profile_.numFrames(); }
  bool next(std::int64_t& timeUs, std::span<double> values) override {
    if (index_ >= profile_.numFrames()) return false;
    profile_.readFrame(index_++, frame_);
    timeUs = frame_.hostUs;
    fill(frame_, values);
    return true;
  }

 protected:
  virtual void fill(const TactileFrame& frame, std::span<double> values) = 0;

  const Profile profile_;
  std::vector<Column> columns_;

 private:
  const std::string name_;
  TactileFrame frame_;
  std::size_t index_ = 0;
};

class SignalsSeries final : public FrameSeries {
 public:
  explicit SignalsSeries(const Profile& profile) : FrameSeries(profile, "signals") {
    const std::size_t numMatrices = profile.layout().numMatrices();
    for (std::size_t m = 0; m <= numMatrices; ++m) {
      const std::string group = m < numMatrices ? "m" + std::to_string(m) : "whole";
      for (const SignalKind kind : kindsOf(m))
        columns_.push_back(
            {group + "/" + std::string(signalName(kind)), unitOf(kind, profile.hand())});
    }
  }

 private:
  void fill(const TactileFrame& frame, std::span<double> values) override {
    allSignals(frame, rows_);
    std::size_t at = 0;
    for (std::size_t m = 0; m < rows_.size(); ++m)
      for (const SignalKind kind : kindsOf(m)) values[at++] = valueOf(rows_[m], kind);
  }
  // The whole hand has no components.
  std::span<const SignalKind> kindsOf(std::size_t m) const {
    return signalKinds(profile_.givesReadings() && m < profile_.layout().numMatrices());
  }

  std::vector<CharacteristicSignals> rows_;
};

class SlipRowSeries final : public FrameSeries {
 public:
  SlipRowSeries(const Profile& profile, const SlipDetectorOptions& options)
      : FrameSeries(profile, "slip"), detector_(profile.hand(), options) {
    static const std::vector<Column> ofMatrix = {{"active", "taxels"},
                                                 {"dx", "taxels"},
                                                 {"dy", "taxels"},
                                                 {"ref_dx", "taxels"},
                                                 {"ref_dy", "taxels"},
                                                 {"rotation_deg", "deg"},
                                                 {"ref_rotation_deg", "deg"},
                                                 {"confidence", ""},
                                                 {"p_moved", ""},
                                                 {"state", ""},
                                                 {"slipping", ""}};
    for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m)
      for (const Column& column : ofMatrix)
        columns_.push_back({"m" + std::to_string(m) + "/" + column.name, column.unit});
  }

 private:
  void fill(const TactileFrame& frame, std::span<double> values) override {
    if (const auto sample = profile_.angleSampleAt(frame.hostUs); sample != sample_) {
      sample_ = sample;
      jointsDeg_ = sample ? profile_.angles(*sample).values : std::vector<double>{};
    }
    std::size_t at = 0;
    const auto put = [&](bool known, double value) { values[at++] = known ? value : kNotKnown; };
    for (const SlipDetection& detection : detector_.update(frame, jointsDeg_)) {
      const SlipMotion& motion = detection.motion;
      const SlipRotation& rotation = motion.rotation;
      const bool touched = motion.active > 0;
      const bool moved = touched && motion.valid;
      const bool turned = touched && rotation.valid;
      put(true, static_cast<double>(motion.active));
      put(moved, motion.dx);
      put(moved, motion.dy);
      put(moved && motion.refValid, motion.refDx);
      put(moved && motion.refValid, motion.refDy);
      put(turned, rotation.rotationDeg);
      put(turned && rotation.refValid, rotation.refRotationDeg);
      put(touched, detection.confidence);
      put(touched && detection.pMoved, detection.pMoved.value_or(0.0));
      put(touched, static_cast<double>(detection.state));
      put(true, detection.slipping ? 1.0 : 0.0);
    }
  }

  SensorSlipDetector detector_;
  std::optional<std::size_t> sample_;
  std::vector<double> jointsDeg_;
};

}  // namespace

std::vector<std::unique_ptr<ExportedSeries>> derivedSeries(const Profile& profile,
                                                           const DerivedSeriesOptions& options) {
  std::vector<std::unique_ptr<ExportedSeries>> series;
  if (options.withSignals) series.push_back(std::make_unique<SignalsSeries>(profile));
  if (options.withSlip)
    series.push_back(std::make_unique<SlipRowSeries>(profile, options.detector));
  return series;
}

}  // namespace palpate
