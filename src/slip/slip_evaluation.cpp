#include "palpate/slip/slip_evaluation.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
constexpr double kFoldFound = 0.92;
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
  return window.hypotheses.computed
             ? std::hypot(window.hypotheses.motion.dx, window.hypotheses.motion.dy)
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
  std::vector<SlipWindows> windows;
  std::vector<Series> series(matrices);
  for (std::size_t m = 0; m < matrices; ++m) {
    windows.emplace_back(profile.layout().matrix(m), options_);
    series[m].slip = slip;
    series[m].fold = static_cast<int>(holds_ % 2);
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
      jointsDeg = profile.angles(*sample).deg;
    for (std::size_t m = 0; m < matrices; ++m) {
      const SlipEvidence& evidence =
          windows[m].add(std::as_const(frame).matrix(m), frame.hostUs, jointsDeg);
      if (!evidence.computable) continue;
      for (std::size_t w = 0; w < kSlipWindows; ++w)
        if (evidence.windows[w].filled && slipEvaluationShift(evidence.windows[w]) > kGates[w])
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

template <typename Alarm>
SlipScore SlipEvaluation::scoreOf(const Alarm& begin, int fold) const {
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
      if (fold >= 0 && series.labelFolds[k] != fold) continue;
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

SlipScore SlipEvaluation::score(const SlipRuleOptions& options, bool joints, int fold) const {
  SlipRuleOptions used = options;
  if (!joints) used.allowancePerJointDeg = 0.0;
  return scoreOf(
      [&] {
        return [rule = SlipRule(used)](const SlipEvidence& evidence) mutable {
          if (evidence.contactAge == 1) rule.reset();
          return rule.decide(evidence).alarm;
        };
      },
      fold);
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
  report.alarms.push_back({"centroid-step", scoreOf(step, -1)});
  report.alarms.push_back({"centroid-windows", scoreOf(twice(&slipEvaluationShift), -1)});
  report.alarms.push_back({"register-windows", scoreOf(twice(&registered), -1)});
  report.alarms.push_back({"contest", score({}, false)});
  report.alarms.push_back({"contest-joints", score({}, true)});
  SlipScore heldOut;
  for (int fold = 0; fold < 2; ++fold) {
    double least = 0.0;
    bool any = false;
    for (const SlipRuleOptions& options : slipGrid()) {
      const SlipScore own = score(options, false, fold);
      const double missed = std::max(0.0, kFoldFound - own.detectionRate());
      const double cost = static_cast<double>(own.falseAlarms[kSettledContact]) +
                          static_cast<double>(own.falseAlarms[kAllContact]) / 7.0 + 1000.0 * missed;
      if (any && cost >= least) continue;
      any = true;
      least = cost;
      report.chosen[static_cast<std::size_t>(fold)] = options;
    }
    heldOut.add(score(report.chosen[static_cast<std::size_t>(fold)], false, 1 - fold));
  }
  report.alarms.push_back({"contest-held-out", heldOut});
  return report;
}

std::vector<SlipRuleOptions> slipGrid() {
  std::vector<SlipRuleOptions> grid;
  for (const double shortSteps : {1.5, 1.75, 2.0})
    for (const double middleSteps : {2.5, 3.0, 3.5})
      for (const double rise : {1.0, 1.5, 2.5, 3.5})
        for (const double accumulated : {1.0, 1.4})
          grid.push_back({.shortSteps = shortSteps,
                          .middleSteps = middleSteps,
                          .accumulatedThreshold = accumulated,
                          .allowancePerLogRise = {rise, rise, rise}});
  return grid;
}

}  // namespace palpate
