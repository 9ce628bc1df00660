#include "palpate/slip/slip_rows.h"

#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

void appendDetection(std::string& row, const SlipDetection& detection) {
  const SlipMotion& motion = detection.motion;
  const SlipRotation& rotation = motion.rotation;
  appendNumber(row, static_cast<std::int64_t>(motion.active));
  row += motion.valid ? ",1" : ",0";
  appendSlipCell(row, motion.valid, motion.dx);
  appendSlipCell(row, motion.valid, motion.dy);
  appendSlipCell(row, motion.valid && motion.refValid, motion.refDx);
  appendSlipCell(row, motion.valid && motion.refValid, motion.refDy);
  row += rotation.valid ? ",1" : ",0";
  appendSlipCell(row, rotation.valid, rotation.rotationDeg);
  appendSlipCell(row, rotation.valid && rotation.refValid, rotation.refRotationDeg);
  appendSlipCell(row, true, rotation.axis.orientationDeg);
  appendSlipCell(row, true, rotation.axis.eccentricity);
  appendSlipCell(row, true, rotation.roundness);
  appendSlipCell(row, true, detection.residual);
  appendSlipCell(row, true, detection.confidence);
  appendSlipCell(row, detection.pMoved.has_value(), detection.pMoved.value_or(0.0));
  row += ',';
  row += nameOf(detection.state);
  row += detection.slipping ? ",1" : ",0";
}

}  // namespace

const char* const kSlipColumns =
    "frame,time_ms,matrix,active,valid,dx,dy,ref_dx,ref_dy,rotation_valid,rotation_deg,"
    "ref_rotation_deg,orientation_deg,eccentricity,roundness,residual,confidence,p_moved,state,"
    "slipping";

const char* const kSlipUnits = ",ms,,taxels,,taxels,taxels,taxels,taxels,,deg,deg,deg,,,,,,,";

const char* const kSlipSegmentColumns =
    "begin,end,begin_ms,end_ms,matrix,path_taxels,rotation_deg,confidence";

const char* const kSlipSegmentUnits = ",,ms,ms,,taxels,deg,";

void appendSlipCell(std::string& row, bool known, double value) {
  row += ',';
  if (known) appendNumber(row, value + 0.0);
}

void forEachSlipRow(const Profile& profile,
                    const SlipRunOptions& pass,
                    std::optional<std::int64_t> matrix,
                    const std::function<void(const std::string& row)>& sink,
                    const Progress& progress) {
  std::string row;
  runSlipDetector(
      profile,
      pass,
      [&](std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections) {
        for (std::size_t m = 0; m < detections.size(); ++m) {
          if (detections[m].motion.active == 0) continue;
          if (matrix && *matrix != static_cast<std::int64_t>(m)) continue;
          row.clear();
          appendNumber(row, static_cast<std::int64_t>(frame));
          row += ',';
          appendNumber(row, timeUs / kUsPerMs);
          row += ',';
          appendNumber(row, static_cast<std::int64_t>(m));
          row += ',';
          appendDetection(row, detections[m]);
          sink(row);
        }
      },
      progress);
}

void forEachSlipSegmentRow(const Profile& profile,
                           const SlipRunOptions& pass,
                           std::optional<std::int64_t> matrix,
                           const std::function<void(const std::string& row)>& sink,
                           const Progress& progress) {
  std::string row;
  for (const SlipSegment& segment : findSlips(profile, {.pass = pass}, progress)) {
    if (matrix && *matrix != static_cast<std::int64_t>(segment.matrix)) continue;
    row.clear();
    for (const std::int64_t value : {static_cast<std::int64_t>(segment.begin),
                                     static_cast<std::int64_t>(segment.end),
                                     segment.beginUs / kUsPerMs,
                                     segment.endUs / kUsPerMs,
                                     static_cast<std::int64_t>(segment.matrix)}) {
      appendNumber(row, value);
      row += ',';
    }
    appendNumber(row, segment.pathTaxels);
    appendSlipCell(row, true, segment.rotationDeg);
    appendSlipCell(row, true, segment.confidence);
    sink(row);
  }
}

}  // namespace palpate
