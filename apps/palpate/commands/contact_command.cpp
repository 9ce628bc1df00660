// The command `palpate contact PATH...` computes where a hand touches in space, frame by frame, as
// CSV.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/kinematics/contact_rows.h"

#include "commands/calibrated_frames.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/contact_size.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

// Whether the force isn't known only because contacts are lighter than all that were measured, as
// they are where a grasp begins and ends.
bool isOnlyTooLight(const PressureFrame& pressures) {
  return pressures.areaKnown &&
         std::all_of(pressures.matrices.begin(),
                     pressures.matrices.end(),
                     [](const MatrixPressure& each) { return each.inRange || each.tooLight; });
}

struct ContactRequest {
  ContactRowsOptions rows = {};
  Recipe filters = {};
  FrameChoice frames = {};
  std::optional<CalibrationChoice> calibration = {};
};

// What an unknown force means.
constexpr const char* kOutsideText =
    "a contact is outside the measured range of the calibration (palpate calibrate apply prints it "
    "with in_range 0)";

std::unique_ptr<ResultTable> contactOfRecording(const CommandLine& given,
                                                const ContactRequest& request,
                                                const std::filesystem::path& file,
                                                const Recording& recording,
                                                const Progress& progress) {
  const Profile profile = filteredBy(request.filters, recording, file, partOf(progress, 0.0, 0.3));
  requireWithinFullScale("threshold", request.rows.contact.threshold, profile.hand());
  ContactRowsOptions rows = request.rows;
  const bool isRigid = profile.hand().axes.empty();
  rows.anglesDeg = isRigid ? std::vector<double>() : anglesOf(given, profile.hand());
  if (profile.numAngles() == 0 && !rows.anglesDeg)
    throw Error(file.string() + ": has no joint angles; assume some with --angles A0,A1,.. [deg]");
  std::tie(rows.first, rows.last) = framesOf(request.frames, file, profile);
  if (request.calibration) {
    const auto calibrated =
        std::make_shared<CalibratedFrames>(*request.calibration, file, recording, profile);
    rows.noForceText = calibrated->areaKnown() ? kOutsideText : kUnknownAreaText;
    rows.forceOf = [calibrated, profile](const TactileFrame& frame) {
      const PressureFrame& pressures = calibrated->of(frame);
      return ForceReading{knownForceN(pressures), isOnlyTooLight(pressures)};
    };
  }
  return contactTable(profile, geometryOf(given, file, profile), rows, partOf(progress, 0.3, 1.0));
}

}  // namespace

int contactCommand(const Arguments& words) {
  ContactRequest request;
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
       .options = withTableOptions(withCalibration(withFilterOptions(withFrameOptions(
           {{"angles", "A0,A1,..", "assume these joint angles [deg] for all frames"},
            bound("matrices", "print a row per matrix", request.rows.matrices),
            {"size", "", "print a row per grasp: diameter and compression of the object"},
            bound("threshold",
                  "N",
                  "count taxels above N as active",
                  request.rows.contact.threshold,
                  ContactOptions::kThreshold),
            fingertipOption("study, of --size effective"),
            timeColumnOption()})))),
       .example = "palpate contact foam_ball.dsa > contact.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("size")) return contactSizes(given);
  anglesOf(given);
  request.filters = recipeOf(given);
  request.frames = frameChoiceOf(given);
  request.calibration = calibrationGiven(given);
  request.rows.contact.spheres = !request.rows.matrices;
  if (request.calibration && request.rows.matrices)
    throw UsageError(
        "--calibration fills force_n of frames; forces of matrices: palpate calibrate apply");
  return runTableCommand(given,
                         {.options = "contact" + choicesText(given),
                          .of = [&](const std::filesystem::path& file,
                                    const Recording& recording,
                                    const Progress& progress) {
                            return contactOfRecording(given, request, file, recording, progress);
                          }});
}

}  // namespace palpate::commands
