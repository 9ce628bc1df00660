#include "palpate/batch/derived_series.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "palpate/signals/signal_rows.h"
#include "palpate/slip/slip_rows.h"

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

// "m3/dx", "whole/mean": a column of a matrix, or of all of them.
Column groupColumn(std::size_t matrix, std::size_t numMatrices, const ResultColumn& column) {
  const std::string group = matrix < numMatrices ? "m" + std::to_string(matrix) : "whole";
  return {group + "/" + column.name, column.unit};
}

class SignalsSeries final : public FrameSeries {
 public:
  explicit SignalsSeries(const Profile& profile) : FrameSeries(profile, "signals") {
    const std::vector<ColumnOf<SignalValues>> ofMatrix = signalColumns(profile.hand().unit, true);
    const std::size_t numMatrices = profile.layout().numMatrices();
    for (std::size_t m = 0; m <= numMatrices; ++m)
      for (const SignalKind kind : kindsOf(m))
        columns_.push_back(groupColumn(m, numMatrices, columnNamed(ofMatrix, signalName(kind)).column));
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
    const std::vector<ColumnOf<SlipDetection>> all = slipColumns();
    for (const char* name : {"active",
                             "dx",
                             "dy",
                             "ref_dx",
                             "ref_dy",
                             "rotation_deg",
                             "ref_rotation_deg",
                             "confidence",
                             "p_moved",
                             "state",
                             "slipping"})
      ofMatrix_.push_back(columnNamed(all, name));
    const std::size_t numMatrices = profile.layout().numMatrices();
    for (std::size_t m = 0; m < numMatrices; ++m)
      for (const ColumnOf<SlipDetection>& each : ofMatrix_)
        columns_.push_back(groupColumn(m, numMatrices, each.column));
  }

 private:
  void fill(const TactileFrame& frame, std::span<double> values) override {
    if (const auto sample = profile_.angleSampleAt(frame.hostUs); sample != sample_) {
      sample_ = sample;
      jointsDeg_ = sample ? profile_.angles(*sample).values : std::vector<double>{};
    }
    std::size_t at = 0;
    for (const SlipDetection& detection : detector_.update(frame, jointsDeg_))
      for (const ColumnOf<SlipDetection>& each : ofMatrix_)
        values[at++] = valueOfColumn(each, detection);
  }

  // Of a matrix that is not touched only `active` and `slipping` are known.
  static double valueOfColumn(const ColumnOf<SlipDetection>& each, const SlipDetection& detection) {
    const std::string& name = each.column.name;
    if (detection.motion.active == 0 && name != "active" && name != "slipping") return kNotKnown;
    // A text has no number.
    if (name == "state") return static_cast<double>(detection.state);
    return numberOf(each.cell(detection));
  }

  SensorSlipDetector detector_;
  std::vector<ColumnOf<SlipDetection>> ofMatrix_;
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
