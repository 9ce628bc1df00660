// The command `palpate contact PATH...` computes where a hand touches in space, frame by frame, as
// CSV.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/kinematics/contact_geometry.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/kinematics/joint_range.h"

#include "commands/calibrated_frames.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/contact_size.h"
#include "commands/export_options.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr const char* kFrameColumns =
    "frame,time_ms,active,sphere_x_mm,sphere_y_mm,sphere_z_mm,sphere_radius_mm,force_n";
constexpr const char* kFrameUnits = ",ms,taxels,mm,mm,mm,mm,N";
constexpr const char* kMatrixColumns =
    "frame,time_ms,matrix,active,sum,area_mm2,centroid_x_mm,centroid_y_mm,centroid_z_mm,nx,ny,nz,"
    "major_x,major_y,major_z,major_sd_mm,minor_x,minor_y,minor_z,minor_sd_mm,surface_x_mm,"
    "surface_y_mm";

// The units of kMatrixColumns.
std::string matrixUnits(const HandDescription& hand) {
  std::string line =
      csvLine({"", "ms", "", "taxels", hand.unit, "mm^2", "mm", "mm", "mm", "",   "",
               "", "",   "", "",       "mm",      "",     "",   "",   "mm", "mm", "mm"});
  line.pop_back();
  return line;
}

struct ContactRequest {
  std::optional<std::vector<double>> anglesDeg;  // used instead of recorded angles
  bool matrices = false;
  ContactOptions options = {};
  std::optional<std::int64_t> from = std::nullopt, to = std::nullopt;
  std::optional<CalibrationChoice> calibration = std::nullopt;
};

// Problems with the joint angles or values of a recording.
struct AngleProblems {
  std::size_t frames = 0;
  std::size_t outOfRange = 0;
  std::size_t unusable = 0;
  std::string firstOutOfRange = {}, firstUnusable = {};
  std::size_t notFinite = 0;  // frames with values that are not finite
  std::size_t noForce = 0;    // frames whose force is not known
  // Frames whose force is not known only because a contact is lighter than the calibration's.
  std::size_t tooLight = 0;
};

void appendVector(std::string& line, const Eigen::Vector3d& vector) {
  for (const double value : {vector.x(), vector.y(), vector.z()}) {
    line += ',';
    appendNumber(line, value + 0.0);  // avoids -0
  }
}

void appendStart(std::string& line, std::size_t frame, std::int64_t hostUs) {
  line.clear();
  appendNumber(line, static_cast<std::int64_t>(frame));
  line += ',';
  appendNumber(line, hostUs / kUsPerMs);
  line += ',';
}

// The force of the hand [N]; nothing where a contact is outside the measured range, or the area of
// the indenter isn't known.
std::optional<double> knownForceN(const PressureFrame& pressures) {
  const bool touched = std::any_of(pressures.matrices.begin(),
                                   pressures.matrices.end(),
                                   [](const MatrixPressure& each) { return each.active > 0; });
  if (touched && !(pressures.areaKnown && pressures.inRange)) return std::nullopt;
  return pressures.forceN;
}

// Whether that is so only because contacts are lighter than all that were measured, as they are
// where a grasp begins and ends.
bool isOnlyTooLight(const PressureFrame& pressures) {
  return pressures.areaKnown &&
         std::all_of(pressures.matrices.begin(),
                     pressures.matrices.end(),
                     [](const MatrixPressure& each) { return each.inRange || each.tooLight; });
}

// `forceN`: nothing without a calibration, and where it isn't known.
void appendFrame(std::string& line,
                 const HandContact& contact,
                 bool posed,
                 std::optional<double> forceN) {
  appendNumber(line, static_cast<std::int64_t>(contact.numActive));
  if (posed && contact.taxelSphere) {
    appendVector(line, contact.taxelSphere->centreMm);
    line += ',';
    appendNumber(line, contact.taxelSphere->radiusMm);
  } else {
    line += ",,,,";
  }
  line += ',';
  if (forceN) appendNumber(line, *forceN);
}

void appendMatrix(std::string& line, std::size_t m, const MatrixContact& contact, bool posed) {
  appendNumber(line, static_cast<std::int64_t>(m));
  line += ',';
  appendNumber(line, static_cast<std::int64_t>(contact.numActive));
  for (const double value : {contact.sum, contact.areaMm2}) {
    line += ',';
    appendNumber(line, value);
  }
  const bool touches = contact.numActive > 0;
  if (posed && touches) {
    appendVector(line, contact.centroidMm);
    appendVector(line, contact.meanNormal);
    appendVector(line, contact.majorAxis);
    line += ',';
    appendNumber(line, contact.majorSdMm);
    appendVector(line, contact.minorAxis);
    line += ',';
    appendNumber(line, contact.minorSdMm);
  } else {
    line += std::string(14, ',');
  }
  for (const double value : {contact.xMm, contact.yMm}) {
    line += ',';
    if (touches) appendNumber(line, value);
  }
}

// First and last requested frame.
std::pair<std::size_t, std::size_t> contactRangeOf(const std::filesystem::path& file,
                                                   const Profile& profile,
                                                   const ContactRequest& request) {
  const auto last = static_cast<std::int64_t>(profile.numFrames()) - 1;
  const std::int64_t from = request.from.value_or(0), to = request.to.value_or(last);
  if (last < 0 && !request.from && !request.to) return {1, 0};
  if (from > last || to > last)
    throw Error(file.string() + ": has no frame " + std::to_string(from > last ? from : to) +
                (last < 0 ? ", it is empty" : ", only 0.." + std::to_string(last)));
  return {static_cast<std::size_t>(from), static_cast<std::size_t>(to)};
}

// Computes the pose of the hand for each frame; keeps it, because joint angles change less often
// than frames.
class PoseOfFrames {
 public:
  PoseOfFrames(const Profile& profile, const HandGeometry& geometry, const ContactRequest& request)
      : profile_(profile), geometry_(geometry), request_(request) {
    if (request.anglesDeg) geometry.pose(*request.anglesDeg, pose_);
  }

  // Updates the pose; returns false when the recorded angles are not a valid pose, and pose() is
  // then that of an earlier moment, or of angles 0.
  bool posed(std::int64_t hostUs, AngleProblems& problems) {
    if (request_.anglesDeg) return true;
    const std::size_t sample = profile_.angleSampleAt(hostUs).value();
    if (sample_ != sample) {
      sample_ = sample;
      const std::vector<double> anglesDeg = profile_.angles(sample).values;
      check_ = checkAngles(anglesDeg, profile_.hand().axes);
      if (check_.state != AngleValidity::kUnusable)
        geometry_.pose(anglesDeg, pose_);
      else if (pose_.empty())
        geometry_.pose(std::vector<double>(geometry_.description().numAxes, 0.0), pose_);
    }
    if (check_.state == AngleValidity::kOutOfRange && problems.outOfRange++ == 0)
      problems.firstOutOfRange = check_.problem;
    if (check_.state == AngleValidity::kUnusable && problems.unusable++ == 0)
      problems.firstUnusable = check_.problem;
    return check_.state != AngleValidity::kUnusable;
  }
  const HandPose& pose() const { return pose_; }

 private:
  const Profile& profile_;
  const HandGeometry& geometry_;
  const ContactRequest& request_;
  HandPose pose_;
  std::optional<std::size_t> sample_;
  AnglesCheck check_;
};

AngleProblems writeContact(StandardOutput& out,
                           const std::filesystem::path& file,
                           const Recording& recording,
                           const Profile& profile,
                           const HandGeometry& geometry,
                           const ContactRequest& request,
                           const std::pair<std::size_t, std::size_t>& range,
                           const std::string& lineEnd,
                           const Progress& progress) {
  const auto [first, last] = range;
  PoseOfFrames poses(profile, geometry, request);
  std::optional<CalibratedFrames> calibrated;
  if (request.calibration) calibrated.emplace(*request.calibration, file, recording, profile);
  AngleProblems problems;
  TactileFrame frame;
  HandContact contact;
  std::string line;
  for (std::size_t i = first; i <= last && last < profile.numFrames(); ++i) {
    reportProgress(progress, i - first, last - first + 1);
    profile.readFrame(i, frame);
    const bool posed = poses.posed(frame.hostUs, problems);
    contactOf(frame, poses.pose(), request.options, contact);
    ++problems.frames;
    if (contact.numNotFinite > 0) ++problems.notFinite;
    std::optional<double> forceN;
    if (calibrated) {
      const PressureFrame& pressures = calibrated->of(frame);
      forceN = knownForceN(pressures);
      if (!forceN) ++(isOnlyTooLight(pressures) ? problems.tooLight : problems.noForce);
    }
    const std::size_t rows = request.matrices ? contact.matrices.size() : 1;
    for (std::size_t m = 0; m < rows; ++m) {
      appendStart(line, i, frame.hostUs);
      if (request.matrices)
        appendMatrix(line, m, contact.matrices[m], posed);
      else
        appendFrame(line, contact, posed, forceN);
      out.write(line += lineEnd);
    }
  }
  return problems;
}

// Prints the problems; returns false when rows lack values because of them.
bool reportProblems(const std::filesystem::path& file,
                    const AngleProblems& problems,
                    bool areaKnown,
                    bool quiet) {
  const auto say = [&](std::size_t frames, const std::string& what) {
    std::fprintf(stderr,
                 "palpate: %s: %zu of %zu frames %s\n",
                 escapedLine(file.string()).c_str(),
                 frames,
                 problems.frames,
                 what.c_str());
  };
  if (problems.outOfRange > 0 && !quiet)
    say(problems.outOfRange,
        "have joint angles that the hand can't take: " + problems.firstOutOfRange);
  if (problems.notFinite > 0)
    say(problems.notFinite, "have values that are not numbers; these were left out");
  if (problems.tooLight > 0 && !quiet)
    say(problems.tooLight,
        "have no force_n: a contact is lighter than all that the calibration measured");
  if (problems.noForce > 0)
    say(problems.noForce,
        areaKnown ? "have no force_n: a contact is outside the measured range of the calibration "
                    "(palpate calibrate apply prints it with in_range 0)"
                  : std::string("have no force_n: ") + kUnknownAreaText);
  if (problems.unusable > 0)
    say(problems.unusable,
        "have no usable joint angles, and no sphere: " + problems.firstUnusable +
            "; give some with --angles");
  return problems.unusable + problems.notFinite + problems.noForce == 0;
}

}  // namespace

int contactCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate contact PATH... [--angles A0,A1,..] [--matrices | --size]",
       .purpose = "Prints for every frame, as CSV, how many taxels are active (value > 0) and the "
                  "smallest sphere around them in the hand's base frame [mm]; the sphere is empty "
                  "where nothing touches. The column force_n [N] is filled with --calibration "
                  "only, and empty where the force isn't known: outside the measured range, or "
                  "with a calibration made without --area; `palpate calibrate apply` also prints "
                  "pressures and standard deviations. With "
                  "--matrices there is a row per matrix instead: its contact centroid, mean "
                  "normal, principal axes and the standard deviations along them. With --size "
                  "there is a row per grasp: diameter and compression of the object. PATH is a "
                  "recording, or a folder: every recording below it. With several recordings a "
                  "last column names the file. A recording without joint angles needs --angles.",
       .options = withCalibration(withFilterOptions(
           {{"angles", "A0,A1,..", "assume these joint angles [deg] for all frames"},
            {"matrices", "", "a row per matrix"},
            unitsRowOption(),
            {"size", "", "a row per grasp: diameter and compression of the object"},
            {"threshold", "N", "a taxel above N is active [counts], default 0"},
            {"fingertip",
             "study|effective",
             "radius of bent fingertips: nominal (default; SDH-2: 58 mm) or effective "
             "(default of --size; 48.4 mm)"},
            {"from", "N", "first frame, default 0"},
            {"to", "M", "last frame (inclusive), default the last one"}})),
       .example = "palpate contact foam_ball.dsa > contact.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("size")) return contactSizes(given);
  ContactRequest request{.anglesDeg = anglesOf(given)};
  request.matrices = given.has("matrices");
  request.options.threshold = given.number("threshold", 0.0, kLargestFullScale).value_or(0.0);
  request.calibration = calibrationGiven(given);
  if (request.calibration && request.matrices)
    throw UsageError(
        "--calibration fills force_n of frames; forces of matrices: palpate calibrate apply");
  request.options.spheres = !request.matrices;
  request.from = given.integer("from", 0, INT64_MAX);
  request.to = given.integer("to", 0, INT64_MAX);
  if (request.from && request.to && *request.from > *request.to)
    throw UsageError("--from is after --to");
  const Recipe recipe = recipeOf(given);
  const RecordingList recordings = recordingsIn(given.words());
  StandardOutput out;
  bool headerWritten = false, allThere = true;
  std::string units;
  const int code = forEachOpened(
      recordings,
      given.quiet(),
      [&](const std::filesystem::path& file, const Recording& recording, const Progress& progress) {
        const Profile profile = filteredBy(recipe, recording, file, progress);
        requireWithinFullScale("threshold", request.options.threshold, profile.hand());
        const HandGeometry geometry(geometryOf(given, file, profile));
        const bool isRigid = profile.hand().axes.empty();
        request.anglesDeg = isRigid ? std::vector<double>() : anglesOf(given, profile.hand());
        if (profile.numAngles() == 0 && !request.anglesDeg)
          throw Error(file.string() +
                      ": has no joint angles; assume some with --angles A0,A1,.. [deg]");
        const auto range = contactRangeOf(file, profile, request);
        if (!headerWritten)
          out.write(std::string(request.matrices ? kMatrixColumns : kFrameColumns) +
                    (recordings.several ? ",file\n" : "\n"));
        if (given.has("units-row")) {
          const std::string line =
              request.matrices ? matrixUnits(profile.hand()) : std::string(kFrameUnits);
          if (!headerWritten)
            out.write((units = line) + (recordings.several ? ",\n" : "\n"));
          else if (line != units)
            throw Error(file.string() + ": " + kOtherHead);
        }
        headerWritten = true;
        const std::string lineEnd = recordings.several ? "," + csvLine({file.string()}) : "\n";
        // When a recording fails in the middle, the rows written so far are kept, and the failure
        // is reported.
        AngleProblems problems;
        try {
          problems = writeContact(
              out, file, recording, profile, geometry, request, range, lineEnd, progress);
        } catch (const Error&) {
          out.finish();
          throw;
        }
        out.finish();
        const bool areaKnown =
            !request.calibration || request.calibration->calibration.pressure.knowsArea();
        allThere = reportProblems(file, problems, areaKnown, given.quiet()) && allThere;
      });
  return code == kDone && !allThere ? kPartlyDone : code;
}

}  // namespace palpate::commands
