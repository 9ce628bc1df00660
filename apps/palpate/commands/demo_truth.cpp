#include "commands/demo_truth.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate::commands {
namespace {

constexpr double kLeastWayTaxels = 1.0;
constexpr std::size_t kHoldingMatrices = 2;
// Largest delay between a scan and the stamp of its received frame, from transmission: two frames.
constexpr std::int64_t kLineUs = 70 * kUsPerMs;

double wayTaxels(const MatrixTruth& from, const MatrixTruth& to) {
  return std::hypot(to.slipXTaxels - from.slipXTaxels, to.slipYTaxels - from.slipYTaxels);
}

bool isBefore(const DemoTruthFrame& frame, double handS) { return frame.handS < handS; }

std::string taxelsAndMm(double taxels, double pitchMm) {
  return fixedText(taxels, 1) + " taxels (" + fixedText(taxels * pitchMm, 1) + " mm)";
}

}  // namespace

std::optional<DemoMotion> demoMotion(const std::vector<DemoTruthFrame>& truth,
                                     double fromS,
                                     double untilS) {
  const auto first = std::lower_bound(truth.begin(), truth.end(), fromS, isBefore);
  const auto end = std::lower_bound(first, truth.end(), untilS, isBefore);
  if (first == end) return std::nullopt;
  const std::vector<MatrixTruth>& held = first->matrices;
  if (static_cast<std::size_t>(std::count_if(held.begin(), held.end(), [](const MatrixTruth& m) {
        return m.contact;
      })) < kHoldingMatrices)
    return std::nullopt;
  DemoMotion motion;
  const std::vector<MatrixTruth>& last = std::prev(end)->matrices;
  for (std::size_t m = 0; m < held.size(); ++m) {
    if (!held[m].contact || !last[m].contact) continue;
    const double way = wayTaxels(held[m], last[m]);
    if (way <= motion.movedTaxels) continue;
    motion.matrix = m;
    motion.movedTaxels = way;
  }
  if (motion.movedTaxels < kLeastWayTaxels) return std::nullopt;
  const auto hasMoved = [&](double taxels) {
    return std::find_if(first, end, [&](const DemoTruthFrame& frame) {
      return wayTaxels(held[motion.matrix], frame.matrices[motion.matrix]) >= taxels;
    });
  };
  motion.beganUs = hasMoved(kDemoMovedTaxels)->hostUs;
  motion.endedUs = hasMoved(motion.movedTaxels - kDemoMovedTaxels)->hostUs;
  return motion;
}

DemoSlip demoSlip(const SlipSeries& series,
                  const std::vector<DemoTruthFrame>& truth,
                  double fromS,
                  const DemoMotion& motion) {
  DemoSlip found;
  found.motion = motion;
  const auto held = std::lower_bound(truth.begin(), truth.end(), fromS, isBefore);
  if (held == truth.end()) return found;
  for (const SlipSegment& slip : series.slips) {  // ordered by their begin
    if (slip.beginUs > motion.endedUs + kLineUs || slip.endUs < held->hostUs) continue;
    if (slip.endUs < motion.beganUs) {
      ++found.early;
      continue;
    }
    found.matrices.push_back(slip.matrix);
    if (found.alarm) continue;
    DemoAlarm& alarm = found.alarm.emplace();
    alarm.matrix = slip.matrix;
    alarm.frame = slip.begin;
    alarm.lastFrame = slip.end;
    alarm.atS = static_cast<double>(slip.beginUs - series.firstUs) / kUsPerS;
    alarm.afterS = static_cast<double>(slip.beginUs - motion.beganUs) / kUsPerS;
    const auto behind = std::find_if(held, truth.end(), [&](const DemoTruthFrame& frame) {
      return frame.hostUs > slip.beginUs;
    });
    if (behind != held)
      alarm.movedTaxels =
          wayTaxels(held->matrices[motion.matrix], std::prev(behind)->matrices[motion.matrix]);
    if (const SlipSample* raised = series.at(slip.matrix, slip.begin)) {
      alarm.indicator = raised->indicator;
      alarm.state = raised->state;
    }
    alarm.furthestFrame = slip.begin;
    for (const SlipSample& sample : series.between(slip.matrix, slip.begin, slip.end)) {
      if (!sample.refValid || sample.shiftTaxels() <= alarm.imprintTaxels) continue;
      alarm.imprintTaxels = sample.shiftTaxels();
      alarm.furthestFrame = sample.frame;
    }
  }
  std::sort(found.matrices.begin(), found.matrices.end());
  found.matrices.erase(std::unique(found.matrices.begin(), found.matrices.end()),
                       found.matrices.end());
  return found;
}

std::string demoSlipText(const DemoSlip& slip, double pitchMm) {
  const std::string moved =
      "a pen was pulled " + taxelsAndMm(slip.motion.movedTaxels, pitchMm) + " through the fingers";
  std::string text = moved + " and no alarm was raised";
  if (slip.alarm) {
    const DemoAlarm& alarm = *slip.alarm;
    text = moved + "; the alarm of matrix " + std::to_string(alarm.matrix) + " said '" +
           std::string(nameOf(alarm.indicator)) + "' in frame " + std::to_string(alarm.frame) +
           ", when it had gone " + fixedText(alarm.movedTaxels, 1) + "; by its imprint it went " +
           fixedText(alarm.imprintTaxels, 1);
  }
  if (slip.early > 0)
    text += "; " + std::to_string(slip.early) +
            (slip.early == 1 ? " false alarm" : " false alarms") + " before";
  return text;
}

Json demoSlipJson(const DemoSlip& slip, double pitchMm) {
  Json matrices = Json::array();
  for (const std::size_t matrix : slip.matrices) matrices.push(matrix);
  Json json = Json::object()
                  .set("truth",
                       Json::object()
                           .set("matrix", slip.motion.matrix)
                           .set("moved_taxels", slip.motion.movedTaxels)
                           .set("moved_mm", slip.motion.movedTaxels * pitchMm)
                           .set("began_ms", slip.motion.beganUs / kUsPerMs)
                           .set("ended_ms", slip.motion.endedUs / kUsPerMs))
                  .set("seen", slip.alarm.has_value())
                  .set("false_alarms_before", slip.early)
                  .set("matrices", std::move(matrices));
  if (!slip.alarm) return json;
  const DemoAlarm& alarm = *slip.alarm;
  return json.set("alarm",
                  Json::object()
                      .set("matrix", alarm.matrix)
                      .set("frame", alarm.frame)
                      .set("last_frame", alarm.lastFrame)
                      .set("at_s", alarm.atS)
                      .set("after_s", alarm.afterS)
                      .set("moved_taxels", alarm.movedTaxels)
                      .set("imprint_taxels", alarm.imprintTaxels)
                      .set("furthest_frame", alarm.furthestFrame)
                      .set("lamp", std::string(nameOf(alarm.indicator)))
                      .set("state", std::string(nameOf(alarm.state))));
}

}  // namespace palpate::commands
