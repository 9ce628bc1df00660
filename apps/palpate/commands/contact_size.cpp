#include "commands/contact_size.h"

#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/kinematics/object_size.h"
#include "palpate/recognition/grasp_segments.h"

#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

std::vector<std::string> header() {
  return {"begin",
          "end",
          "matrix_a",
          "matrix_b",
          "start_frame",
          "plateau_frame",
          "start_mm",
          "plateau_mm",
          "shrink_mm",
          "foam_mm",
          "compression_mm",
          "compression_sd_mm",
          "diameter_mm",
          "diameter_sd_mm",
          "sphere_mm"};
}

std::vector<std::string> contactSizeCellsOf(const GraspSegment& grasp,
                                            const ObjectSizeReport& report) {
  std::vector<std::string> cells = {std::to_string(grasp.begin), std::to_string(grasp.end)};
  if (!report.valid) {
    cells.resize(header().size());
    return cells;
  }
  for (const std::size_t number :
       {report.pads.first, report.pads.second, report.startFrame, report.plateauFrame})
    cells.push_back(std::to_string(number));
  for (const double value : {report.startMm,
                             report.plateauMm,
                             report.shrinkMm,
                             report.foamMm,
                             report.compressionMm,
                             report.compressionSdMm,
                             report.diameterMm,
                             report.diameterSdMm,
                             report.spherePlateauMm})
    cells.push_back(numberText(value));
  return cells;
}

void sayContactSize(const std::filesystem::path& file,
                    const GraspSegment& grasp,
                    const std::string& what) {
  std::fprintf(stderr,
               "palpate: %s: grasp %zu..%zu: %s\n",
               escapedLine(file.string()).c_str(),
               grasp.begin,
               grasp.end,
               what.c_str());
}

}  // namespace

int contactSizes(const CommandLine& given) {
  for (const char* option : {"angles", "matrices", "threshold", "from", "to"})
    if (given.has(option)) throw UsageError(std::string("--size can't be used with --") + option);
  const Recipe recipe = recipeOf(given);
  const RecordingList recordings = recordingsIn(given.words());
  StandardOutput out;
  bool headerWritten = false, allThere = true;
  const int code = forEachOpened(
      recordings,
      given.quiet(),
      [&](const std::filesystem::path& file, const Recording& whole, const Progress& progress) {
        const Profile profile = filteredBy(recipe, whole, file, progress);
        const HandGeometry geometry(geometryOf(given, file, profile, "effective"));
        if (profile.numAngles() == 0)
          throw Error(file.string() +
                      ": has no joint angles; a size can't be measured with one assumed pose");
        if (profile.hand().axes.size() != geometry.description().numAxes)
          throw Error(file.string() + ": its joint angles are those of another hand");
        const std::vector<GraspSegment> grasps = findGrasps(profile, {}, progress);
        std::vector<std::string> names = header();
        if (recordings.several) names.emplace_back("file");
        if (!headerWritten) out.write(csvLine(names));
        if (!headerWritten && given.has("units-row")) {
          std::vector<std::string> units(6);
          units.resize(header().size(), "mm");
          units.resize(names.size());
          out.write(csvLine(units));
        }
        headerWritten = true;
        for (const GraspSegment& grasp : grasps) {
          const ObjectSizeReport report =
              objectSize(profile, geometry, grasp.begin, grasp.end, {}, progress);
          std::vector<std::string> cells = contactSizeCellsOf(grasp, report);
          if (recordings.several) cells.push_back(file.string());
          out.write(csvLine(cells));
          if (report.unusableFrames > 0)
            sayContactSize(
                file,
                grasp,
                counted(report.unusableFrames, "frame") + " without usable joint angles left out");
          if (!report.valid) sayContactSize(file, grasp, "no size: " + report.problem);
          allThere = allThere && report.valid && report.unusableFrames == 0;
        }
        // Writes the rows of each recording at once.
        out.finish();
      });
  return code == kDone && !allThere ? kPartlyDone : code;
}

}  // namespace palpate::commands
