#include "palpate/slip/slip_rows.h"

#include <stdexcept>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
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

void setSlipMethod(SlipRowsOptions& table, std::string_view name) {
  const auto method = slipMethodNamed(name);
  if (!method) throw std::invalid_argument("there is no method '" + shortened(name) + "' of slip");
  table.pass.detector.method = *method;
  table.pass.detector.hypothesisAlarm = *method == SlipMethod::kContest;
}

void setSlipReference(SlipRowsOptions& table, const std::string& word) {
  SlipDetectorOptions& detector = table.pass.detector;
  if (word == "first") {
    detector.reference = SlipReference::kFirst;
  } else if (word == "rest") {
    detector.reference = SlipReference::kWhenAtRest;
  } else if (const auto frame = parseInteger(word); frame && *frame >= 0) {
    detector.reference = SlipReference::kGiven;
    table.pass.referenceFrame = static_cast<std::size_t>(*frame);
  } else {
    throw std::invalid_argument("'" + shortened(word) +
                                "'; it is first, rest, or the number of a frame");
  }
}

void requireThere(const std::filesystem::path& file,
                  const Profile& profile,
                  const SlipRowsOptions& table) {
  requireMatrix(file, profile.layout(), table.matrix);
  if (table.pass.detector.reference == SlipReference::kGiven &&
      table.pass.referenceFrame >= profile.numFrames())
    throw Error(file.string() + ": has no frame " + std::to_string(table.pass.referenceFrame) +
                " to be the reference; it has " + std::to_string(profile.numFrames()));
}

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
