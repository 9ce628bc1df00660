// palpate slip FILE...: how contacts move on every matrix, and whether that is slip, as CSV.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/slip/slip_segments.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr std::int64_t kUsPerMs = 1000;
constexpr const char* kColumns =
    "frame,time_ms,matrix,active,valid,dx,dy,ref_dx,ref_dy,rotation_valid,rotation_deg,"
    "ref_rotation_deg,orientation_deg,eccentricity,roundness,residual,confidence,p_moved,state,"
    "slipping";
constexpr const char* kSegmentColumns =
    "begin,end,begin_ms,end_ms,matrix,path_taxels,rotation_deg,confidence";

struct Request {
  SlipPassOptions pass;
  std::optional<std::int64_t> matrix;
};

// Empty where it isn't known.
void appendIf(std::string& line, bool known, double value) {
  line += ',';
  if (known) appendNumber(line, value + 0.0);
}

void appendVerdict(std::string& line, const SlipVerdict& verdict) {
  const SlipMotion& motion = verdict.motion;
  const SlipRotation& rotation = motion.rotation;
  appendNumber(line, static_cast<std::int64_t>(motion.active));
  line += motion.valid ? ",1" : ",0";
  appendIf(line, motion.valid, motion.dx);
  appendIf(line, motion.valid, motion.dy);
  appendIf(line, motion.valid && motion.refValid, motion.refDx);
  appendIf(line, motion.valid && motion.refValid, motion.refDy);
  line += rotation.valid ? ",1" : ",0";
  appendIf(line, rotation.valid, rotation.rotationDeg);
  appendIf(line, rotation.valid && rotation.refValid, rotation.refRotationDeg);
  appendIf(line, true, rotation.axis.orientationDeg);
  appendIf(line, true, rotation.axis.eccentricity);
  appendIf(line, true, rotation.roundness);
  appendIf(line, true, verdict.residual);
  appendIf(line, true, verdict.confidence);
  appendIf(line, verdict.pMoved.has_value(), verdict.pMoved.value_or(0.0));
  line += ',';
  line += nameOf(verdict.state);
  line += verdict.slipping ? ",1" : ",0";
}

void writeRows(StandardOutput& out,
               const Profile& profile,
               const Request& request,
               const std::string& lineEnd,
               const Progress& progress) {
  std::string line;
  passSlip(
      profile,
      request.pass,
      [&](std::size_t frame, std::int64_t timeUs, const std::vector<SlipVerdict>& verdicts) {
        for (std::size_t m = 0; m < verdicts.size(); ++m) {
          if (verdicts[m].motion.active == 0) continue;
          if (request.matrix && *request.matrix != static_cast<std::int64_t>(m)) continue;
          line.clear();
          appendNumber(line, static_cast<std::int64_t>(frame));
          line += ',';
          appendNumber(line, timeUs / kUsPerMs);
          line += ',';
          appendNumber(line, static_cast<std::int64_t>(m));
          line += ',';
          appendVerdict(line, verdicts[m]);
          out.write(line += lineEnd);
        }
      },
      progress);
}

void writeSegments(StandardOutput& out,
                   const Profile& profile,
                   const Request& request,
                   const std::string& lineEnd,
                   const Progress& progress) {
  std::string line;
  for (const SlipSegment& segment : findSlips(profile, {.pass = request.pass}, progress)) {
    if (request.matrix && *request.matrix != static_cast<std::int64_t>(segment.matrix)) continue;
    line.clear();
    for (const std::int64_t value : {static_cast<std::int64_t>(segment.begin),
                                     static_cast<std::int64_t>(segment.end),
                                     segment.beginUs / kUsPerMs,
                                     segment.endUs / kUsPerMs,
                                     static_cast<std::int64_t>(segment.matrix)}) {
      appendNumber(line, value);
      line += ',';
    }
    appendNumber(line, segment.pathTaxels);
    appendIf(line, true, segment.rotationDeg);
    appendIf(line, true, segment.confidence);
    out.write(line += lineEnd);
  }
}

void readReference(const CommandLine& given, Request& request) {
  const std::string word = given.text("reference").value_or("first");
  SlipDetectorOptions& detector = request.pass.detector;
  if (word == "first") {
    detector.reference = SlipReference::kFirst;
  } else if (word == "rest") {
    detector.reference = SlipReference::kRest;
  } else if (const auto frame = parseInteger(word); frame && *frame >= 0) {
    detector.reference = SlipReference::kGiven;
    request.pass.referenceFrame = static_cast<std::size_t>(*frame);
  } else {
    throw UsageError("--reference is '" + word + "'; it is first, rest, or the number of a frame");
  }
}

Request requestOf(const CommandLine& given) {
  Request request;
  SlipDetectorOptions& detector = request.pass.detector;
  std::vector<std::string> methods;
  for (const SlipMethod method : slipMethods()) methods.emplace_back(nameOf(method));
  if (const auto name = given.choice("method", methods)) detector.method = *slipMethodNamed(*name);
  detector.contestAlarm = detector.method == SlipMethod::kContest;
  readReference(given, request);
  request.matrix = given.integer("matrix", 0, INT32_MAX);
  SlipRuleOptions& rule = detector.rule;
  rule.stepTaxels = given.number("step", 1e-3, 100.0).value_or(rule.stepTaxels);
  rule.referenceTaxels = given.number("limit", 1e-3, 100.0).value_or(rule.referenceTaxels);
  rule.rotationDeg = given.number("rotation", 0.1, 360.0).value_or(rule.rotationDeg);
  return request;
}

void requireThere(const std::filesystem::path& file,
                  const Profile& profile,
                  const Request& request) {
  const auto matrices = static_cast<std::int64_t>(profile.layout().numMatrices());
  if (request.matrix && *request.matrix >= matrices)
    throw Error(file.string() + ": has no matrix " + std::to_string(*request.matrix) +
                ", only 0.." + std::to_string(matrices - 1));
  if (request.pass.detector.reference == SlipReference::kGiven &&
      request.pass.referenceFrame >= profile.numFrames())
    throw Error(file.string() + ": has no frame " + std::to_string(request.pass.referenceFrame) +
                " to be the reference; it has " + std::to_string(profile.numFrames()));
}

}  // namespace

int slipCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate slip PATH... [--method METHOD] [--reference first|rest|FRAME]",
       .purpose =
           "Prints, for every frame and every matrix with an active taxel, how the contact moved "
           "since the frame before\n(dx, dy) and since the reference [taxels, x right, y down], "
           "how it turned, and whether that is slip, as CSV;\ndocs/slip.md explains the columns. "
           "With --segments a row per slip instead. PATH is a recording, or a folder:\nevery "
           "recording below it. With several a last column names the file.",
       .options = {{"method",
                    "METHOD",
                    "centroid, alcazar, ncc-paraboloid, ncc-gauss3, phase, phase-normalized, "
                    "register, contest (default: weighed against a load that shifts)"},
                   {"matrix", "M", "only this one"},
                   {"reference",
                    "WHAT",
                    "first: first frame with an active taxel (default); rest: each contact when it "
                    "rests; or a frame"},
                   {"step", "T", "threshold per frame [taxels], default 0.20"},
                   {"limit", "T", "threshold since the reference [taxels], default 1.0"},
                   {"rotation", "DEG", "threshold of turning [deg], default 5"},
                   {"segments", "", "a row per slip: frames, matrix, length of the way"}},
       .example = "palpate slip bottle.dsa --reference rest > slip.csv",
       .fewestWords = 1},
      words);
  if (given.helpShown()) return kDone;
  const Request request = requestOf(given);
  const bool segments = given.has("segments");
  const RecordingList recordings = recordingsIn(given.words());
  StandardOutput out;
  bool headerWritten = false;
  return forEachProfile(
      recordings,
      given.quiet(),
      [&](const std::filesystem::path& file, const Profile& profile, const Progress& progress) {
        requireThere(file, profile, request);
        if (!headerWritten)
          out.write(std::string(segments ? kSegmentColumns : kColumns) +
                    (recordings.several ? ",file\n" : "\n"));
        headerWritten = true;
        const std::string lineEnd = recordings.several ? "," + csvLine({file.string()}) : "\n";
        (segments ? writeSegments : writeRows)(out, profile, request, lineEnd, progress);
        out.finish();
      });
}

}  // namespace palpate::commands
