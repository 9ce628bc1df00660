#include "palpate/laboratory/slip_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Dense>

#include "palpate/core/progress.h"
#include "palpate/core/statistics.h"

namespace palpate {
namespace {

constexpr double kUsPerHour = 3.6e9;
constexpr std::size_t kLabelFrames = 10;
constexpr double kLabelTaxels = 1.0;
constexpr double kOnsetTaxels = 0.2;
constexpr std::size_t kBridged = 5;
constexpr std::size_t kSettledFrames = 15;
constexpr double kQuietLog = 0.05;
constexpr std::size_t kOneAlarm = 10;  // [frames]
// Of the fit of the sequential test.
constexpr double kRidge = 100.0;
constexpr int kNewtonSteps = 15;
constexpr double kSlipPart = 0.2;
constexpr std::size_t kFittedFrames = 12;
constexpr double kBiasRaise = 1.0;
constexpr double kThresholdMargin = 1.05;
constexpr double kMaxThreshold = 80.0;
constexpr int kBisections = 22;
// Shifts of the centroid [taxels] below which no rule raises an alarm, so that the hypotheses are
// not compared.
constexpr std::array<double, kSlipWindows> kGates = {0.2, 0.3, 0.7};

struct Place {
  bool contact = false;
  std::size_t age = 0;
  double x = 0.0, y = 0.0;
};

double away(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::vector<SlipLabel> labelsOf(std::size_t matrix, const std::vector<Place>& places) {
  std::vector<SlipLabel> labels;
  for (std::size_t i = kLabelFrames; i < places.size(); ++i) {
    const Place& before = places[i - kLabelFrames];
    if (places[i].age <= kLabelFrames || away(places[i], before) <= kLabelTaxels) continue;
    if (!labels.empty() && i - labels.back().end <= kBridged + 1) {
      labels.back().end = i;
      continue;
    }
    labels.push_back({.matrix = matrix, .onset = i - kLabelFrames, .end = i});
  }
  for (SlipLabel& label : labels) {
    const Place from = places[label.onset];
    while (label.onset < label.end && away(places[label.onset], from) <= kOnsetTaxels)
      ++label.onset;
  }
  return labels;
}

double slipEvaluationShift(const WindowEvidence& window) {
  return std::hypot(window.centroidX, window.centroidY);
}

double registered(const WindowEvidence& window) {
  const bool compared =
      window.hypotheses.computed && slipEvaluationShift(window) > kGates[kShortWindow];
  return compared ? std::hypot(window.hypotheses.motion.dx, window.hypotheses.motion.dy)
                  : slipEvaluationShift(window);
}

double medianIntervalUs(const Profile& profile) {
  std::vector<std::int64_t> intervals;
  for (std::size_t i = 1; i < profile.numFrames(); ++i)
    intervals.push_back(profile.frameTimeUs(i) - profile.frameTimeUs(i - 1));
  return intervals.empty() ? 0.0 : static_cast<double>(upperMedian(std::move(intervals)));
}

// Rule without hypotheses: raises an alarm when a value is above its threshold in two frames in a
// row.
class TwiceAbove {
 public:
  bool operator()(const SlipEvidence& evidence, bool above) {
    const bool alarm = above && before_ && evidence.contactAge == age_ + 1;
    before_ = above;
    age_ = evidence.contactAge;
    return alarm;
  }

 private:
  bool before_ = false;
  std::size_t age_ = 0;
};

}  // namespace

std::vector<SlipLabel> labelSlips(const Profile& profile) {
  const SlipWindowsOptions options;
  std::vector<SlipLabel> labels;
  std::vector<std::vector<Place>> places(profile.layout().numMatrices());
  GapDetector gaps;
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const bool gap = gaps.afterGap(frame.hostUs);
    for (std::size_t m = 0; m < places.size(); ++m) {
      const ContactMoments moments = contactMoments(std::as_const(frame).matrix(m));
      Place place{.x = moments.x, .y = moments.y};
      place.contact = moments.active >= options.minActiveTaxels && moments.sum > options.minCounts;
      const std::size_t before = places[m].empty() || gap ? 0 : places[m].back().age;
      place.age = place.contact ? before + 1 : 0;
      places[m].push_back(place);
    }
  }
  for (std::size_t m = 0; m < places.size(); ++m)
    for (const SlipLabel& label : labelsOf(m, places[m])) labels.push_back(label);
  return labels;
}

double SlipScore::perHour(std::size_t kind) const {
  return matrixHours.at(kind) > 0.0 ? static_cast<double>(falseAlarms.at(kind)) / matrixHours[kind]
                                    : 0.0;
}

double SlipScore::detectionRate() const {
  return slips > 0 ? static_cast<double>(found) / static_cast<double>(slips) : 0.0;
}

void SlipScore::add(const SlipScore& other) {
  for (std::size_t kind = 0; kind < matrixHours.size(); ++kind) {
    matrixHours[kind] += other.matrixHours[kind];
    falseAlarms[kind] += other.falseAlarms[kind];
  }
  slips += other.slips;
  found += other.found;
  delaysFrames.insert(delaysFrames.end(), other.delaysFrames.begin(), other.delaysFrames.end());
  std::sort(delaysFrames.begin(), delaysFrames.end());
}

void SlipEvaluation::addNoSlipRecording(const Profile& profile, const Progress& progress) {
  add(profile, false, progress);
  ++holds_;
}

void SlipEvaluation::addSlipRecording(const Profile& profile, const Progress& progress) {
  add(profile, true, progress);
  ++slips_;
}

void SlipEvaluation::add(const Profile& profile, bool slip, const Progress& progress) {
  const std::size_t matrices = profile.layout().numMatrices();
  const std::vector<SlipLabel> labels = slip ? labelSlips(profile) : std::vector<SlipLabel>();
  std::vector<std::size_t> onsets;
  for (const SlipLabel& label : labels) onsets.push_back(label.onset);
  std::sort(onsets.begin(), onsets.end());
  SlipWindowsOptions options = options_;
  std::vector<SlipWindows> windows;
  std::vector<Series> series(matrices);
  for (std::size_t m = 0; m < matrices; ++m) {
    options.hypotheses.registration.saturationCounts =
        static_cast<double>(profile.hand().saturationOf(m));
    windows.emplace_back(profile.layout().matrix(m), options);
    series[m].slip = slip;
    series[m].fold = static_cast<int>(holds_ % 2);
    series[m].recordingFold = static_cast<int>((slip ? slips_ : holds_) % 2);
    series[m].hoursPerFrame = medianIntervalUs(profile) / kUsPerHour;
    for (const SlipLabel& label : labels)
      if (label.matrix == m) {
        series[m].labels.push_back(label);
        series[m].labelFolds.push_back(label.onset >= onsets[onsets.size() / 2] ? 1 : 0);
      }
  }
  TactileFrame frame;
  std::vector<double> jointsDeg;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames());
    profile.readFrame(i, frame);
    if (const auto sample = profile.angleSampleAt(frame.hostUs))
      jointsDeg = profile.angles(*sample).values;
    for (std::size_t m = 0; m < matrices; ++m) {
      const SlipEvidence& evidence =
          windows[m].add(std::as_const(frame).matrix(m), frame.hostUs, jointsDeg);
      if (!evidence.computable) continue;
      if (slipEvaluationShift(evidence.recent) > kMinComparedShift) windows[m].evaluateRecent();
      for (std::size_t w = 0; w < kSlipWindows; ++w)
        if (evidence.windows[w].filled && !evidence.windows[w].hypotheses.computed &&
            slipEvaluationShift(evidence.windows[w]) > kGates[w])
          windows[m].evaluateHypotheses(static_cast<SlipWindow>(w));
      const WindowEvidence& middle = evidence.windows[kMiddleWindow];
      series[m].seen.push_back({.frame = i,
                                .age = evidence.contactAge,
                                .quiet = middle.filled && std::abs(middle.logLoadRatio) < kQuietLog,
                                .evidence = evidence});
    }
  }
  for (Series& one : series)
    if (!one.seen.empty() || !one.labels.empty()) series_.push_back(std::move(one));
}

int SlipEvaluation::foldOf(const Series& series, std::size_t label, SlipFolds folds) {
  return folds == SlipFolds::kRecordings ? series.recordingFold : series.labelFolds[label];
}

template <typename Alarm>
SlipScore SlipEvaluation::scoreOf(const Alarm& begin, int fold, SlipFolds folds) const {
  SlipScore score;
  for (const Series& series : series_) {
    if (!series.slip && fold >= 0 && series.fold != fold) continue;
    auto alarm = begin();
    std::array<std::size_t, 3> last{};
    std::array<bool, 3> any{};
    std::vector<std::size_t> alarms;
    for (const FrameEvidence& seen : series.seen) {
      const bool raised = alarm(seen.evidence);
      if (series.slip) {
        if (raised) alarms.push_back(seen.frame);
        continue;
      }
      const bool settled = seen.age >= kSettledFrames;
      const std::array<bool, 3> counts = {true, settled, settled && seen.quiet};
      for (std::size_t kind = 0; kind < counts.size(); ++kind) {
        if (!counts[kind]) continue;
        score.matrixHours[kind] += series.hoursPerFrame;
        if (!raised) continue;
        if (!any[kind] || seen.frame - last[kind] >= kOneAlarm) ++score.falseAlarms[kind];
        any[kind] = true;
        last[kind] = seen.frame;
      }
    }
    for (std::size_t k = 0; k < series.labels.size(); ++k) {
      if (fold >= 0 && foldOf(series, k, folds) != fold) continue;
      const SlipLabel& label = series.labels[k];
      ++score.slips;
      const auto first = std::lower_bound(alarms.begin(), alarms.end(), label.onset);
      if (first == alarms.end() || *first > label.end) continue;
      ++score.found;
      score.delaysFrames.push_back(static_cast<int>(*first - label.onset));
    }
  }
  std::sort(score.delaysFrames.begin(), score.delaysFrames.end());
  return score;
}

SlipScore SlipEvaluation::score(const SlipRuleOptions& options,
                                bool joints,
                                int fold,
                                SlipFolds folds) const {
  SlipRuleOptions used = options;
  if (!joints) used.allowancePerJointDeg = 0.0;
  return scoreOf(
      [&] {
        return [rule = SlipRule(used)](const SlipEvidence& evidence) mutable {
          if (evidence.contactAge == 1) rule.reset();
          return rule.decide(evidence).alarm;
        };
      },
      fold,
      folds);
}

SlipRuleOptions SlipEvaluation::fitSlipSequence(int fold, SlipFolds folds) const {
  using Row = Eigen::Matrix<double, kSlipFeatures + 1, 1>;
  SlipRuleOptions rule;
  std::vector<Row> rows;
  std::vector<double> slips;
  const auto addRow = [&](const FrameEvidence& seen, double slip) {
    const SlipFeatures features = slipFeatures(seen.evidence, 1.0, 0.0);
    Row row;
    row(0) = 1.0;
    for (std::size_t i = 0; i < kSlipFeatures; ++i)
      row(static_cast<Eigen::Index>(i) + 1) = features[i];
    rows.push_back(row);
    slips.push_back(slip);
  };
  double slipFrames = 0.0;
  for (const Series& series : series_) {
    if (!series.slip && (fold < 0 || series.fold == fold))
      for (const FrameEvidence& seen : series.seen) addRow(seen, 0.0);
    for (std::size_t k = 0; k < series.labels.size(); ++k) {
      if (fold >= 0 && foldOf(series, k, folds) != fold) continue;
      const SlipLabel& label = series.labels[k];
      for (const FrameEvidence& seen : series.seen) {
        if (seen.frame <= label.onset ||
            seen.frame > std::min(label.end, label.onset + kFittedFrames))
          continue;
        addRow(seen, 1.0);
        slipFrames += 1.0;
      }
    }
  }
  const auto numRows = static_cast<double>(rows.size());
  if (slipFrames == 0.0 || slipFrames == numRows) return rule;
  Row mean = Row::Zero();
  Row square = Row::Zero();
  for (const Row& row : rows) {
    mean += row / numRows;
    square += row.cwiseAbs2() / numRows;
  }
  mean(0) = 0.0;
  Row sd = (square - mean.cwiseAbs2()).cwiseMax(1e-9).cwiseSqrt();
  sd(0) = 1.0;
  for (Row& row : rows) row = (row - mean).cwiseQuotient(sd);
  const double weightOfSlip = std::max(1.0, kSlipPart * (numRows - slipFrames) / slipFrames);
  Row weights = Row::Zero();
  for (int step = 0; step < kNewtonSteps; ++step) {
    Eigen::Matrix<double, kSlipFeatures + 1, kSlipFeatures + 1> hessian;
    hessian.setIdentity();
    hessian *= kRidge;
    hessian(0, 0) = 1e-6;
    Row gradient = kRidge * weights;
    gradient(0) = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double p = 1.0 / (1.0 + std::exp(-weights.dot(rows[i])));
      const double weight = slips[i] > 0.0 ? weightOfSlip : 1.0;
      gradient += weight * (p - slips[i]) * rows[i];
      hessian.noalias() += weight * p * (1.0 - p) * rows[i] * rows[i].transpose();
    }
    weights -= hessian.ldlt().solve(gradient);
  }
  const Row raw = weights.cwiseQuotient(sd);
  rule.sequence.bias = raw(0) - raw.dot(mean) + kBiasRaise;
  for (std::size_t i = 0; i < kSlipFeatures; ++i)
    rule.sequence.weights[i] = raw(static_cast<Eigen::Index>(i) + 1);
  // The windows have false alarms that no threshold of the test removes.
  rule.sequence.threshold = std::numeric_limits<double>::max();
  const std::size_t most = score(rule, false, fold, folds).falseAlarms[kAllContact];
  double low = 0.0;
  double high = kMaxThreshold;
  for (int i = 0; i < kBisections; ++i) {
    rule.sequence.threshold = 0.5 * (low + high);
    const bool quiet = score(rule, false, fold, folds).falseAlarms[kAllContact] <= most;
    (quiet ? high : low) = rule.sequence.threshold;
  }
  rule.sequence.threshold = kThresholdMargin * high;
  return rule;
}

SlipEvaluationReport SlipEvaluation::report() const {
  SlipEvaluationReport report;
  report.noSlipRecordings = holds_;
  report.slipRecordings = slips_;
  const auto step = [] {
    return [](const SlipEvidence& evidence) {
      const WindowEvidence& window = evidence.windows[kShortWindow];
      return window.filled &&
             slipEvaluationShift(window) > 0.2 * static_cast<double>(kWindowFrames[kShortWindow]);
    };
  };
  const auto twice = [](auto measure) {
    return [measure] {
      return [measure, above = TwiceAbove()](const SlipEvidence& evidence) mutable {
        const WindowEvidence& near = evidence.windows[kShortWindow];
        const WindowEvidence& far = evidence.windows[kMiddleWindow];
        return above(evidence,
                     (near.filled && measure(near) > 0.3) || (far.filled && measure(far) > 0.5));
      };
    };
  };
  report.alarms.push_back({"centroid-step", scoreOf(step, -1, SlipFolds::kSlipHalves)});
  report.alarms.push_back(
      {"centroid-windows", scoreOf(twice(&slipEvaluationShift), -1, SlipFolds::kSlipHalves)});
  report.alarms.push_back(
      {"register-windows", scoreOf(twice(&registered), -1, SlipFolds::kSlipHalves)});
  report.alarms.push_back({"contest", score({}, false)});
  report.alarms.push_back({"contest-joints", score({}, true)});
  for (const SlipFolds folds : {SlipFolds::kSlipHalves, SlipFolds::kRecordings}) {
    SlipScore heldOut;
    for (int fold = 0; fold < 2; ++fold) {
      SlipRuleOptions& chosen = report.chosen[static_cast<std::size_t>(fold)];
      chosen = fitSlipSequence(fold, folds);
      heldOut.add(score(chosen, false, 1 - fold, folds));
    }
    report.alarms.push_back(
        {folds == SlipFolds::kSlipHalves ? "contest-held-out" : "contest-held-out-recordings",
         heldOut});
  }
  return report;
}

}  // namespace palpate
