#include "commands/contact_size.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/kinematics/object_size.h"
#include "palpate/recognition/grasp_segments.h"
#include "palpate/recognition/size_rows.h"

#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
int contactSizes(const CommandLine& given) {
  for (const char* option : {"angles", "matrices", "threshold", "from", "to"})
    if (given.has(option)) throw UsageError(std::string("--size can't be used with --") + option);
  const Recipe recipe = recipeOf(given);
  return runTableCommand(
      given,
      {.options = "sizes" + choicesText(given),
       .of = [&](const std::filesystem::path& file,
                 const Recording& whole,
                 const Progress& progress) -> std::unique_ptr<ResultTable> {
         const Profile profile = filteredBy(recipe, whole, file, partOf(progress, 0.0, 0.3));
         const HandGeometry geometry(geometryOf(given, file, profile, "effective"));
         if (profile.numAngles() == 0)
           throw Error(file.string() +
                       ": has no joint angles; a size can't be measured with one assumed pose");
         if (profile.hand().axes.size() != geometry.description().numAxes)
           throw Error(file.string() + ": its joint angles are those of another hand");
         std::vector<GraspSize> rows;
         for (const GraspSegment& grasp : findGrasps(profile, {}, progress))
           rows.push_back(
               {grasp, objectSize(profile, geometry, grasp.begin, grasp.end, {}, progress)});
         return sizeTable(std::move(rows));
       },
       .rowNoun = "grasp"});
}

}  // namespace palpate::commands
