#include "commands/contact_size.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/result_table.h"
#include "palpate/kinematics/object_size.h"
#include "palpate/recognition/grasp_segments.h"

#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

struct GraspSize {
  GraspSegment grasp;
  ObjectSizeReport size;
};

std::vector<ColumnOf<GraspSize>> sizeColumns() {
  using Row = GraspSize;
  const auto frame = [](const char* name, const char* meaning, auto of) {
    return columnOf<Row>(name, "", meaning, [of](const Row& row) {
      return row.size.valid ? std::optional(of(row.size)) : std::nullopt;
    });
  };
  const auto length = [](const char* name, const char* meaning, double ObjectSizeReport::*of) {
    return columnOf<Row>(name, "mm", meaning, [of](const Row& row) {
      return row.size.valid ? std::optional(row.size.*of) : std::nullopt;
    });
  };
  using Size = const ObjectSizeReport&;
  return {
      columnOf<Row>("begin", "", "first frame", [](const Row& row) { return row.grasp.begin; }),
      columnOf<Row>("end", "", "last frame", [](const Row& row) { return row.grasp.end; }),
      frame("matrix_a", "one pad", [](Size size) { return size.pads.first; }),
      frame("matrix_b", "the other pad", [](Size size) { return size.pads.second; }),
      frame("start_frame", "first contact of both", [](Size size) { return size.startFrame; }),
      frame("plateau_frame", "start of the plateau", [](Size size) { return size.plateauFrame; }),
      length("start_mm", "distance at first contact", &ObjectSizeReport::startMm),
      length("plateau_mm", "distance on the plateau", &ObjectSizeReport::plateauMm),
      length("shrink_mm", "difference of both", &ObjectSizeReport::shrinkMm),
      length("foam_mm", "part of the foam in it", &ObjectSizeReport::foamMm),
      length("compression_mm", "part of the object", &ObjectSizeReport::compressionMm),
      length("compression_sd_mm", "its standard deviation", &ObjectSizeReport::compressionSdMm),
      length("diameter_mm", "diameter of the object", &ObjectSizeReport::diameterMm),
      length("diameter_sd_mm", "its standard deviation", &ObjectSizeReport::diameterSdMm),
      length("sphere_mm",
             "diameter of the sphere around the touched taxels, on the plateau",
             &ObjectSizeReport::spherePlateauMm)};
}

class SizeTable final : public RowTable<GraspSize> {
 public:
  explicit SizeTable(std::vector<GraspSize> rows)
      : RowTable("sizes", sizeColumns(), rows), rows_(std::move(rows)) {}
  std::vector<std::string> problems() const override {
    std::vector<std::string> lines;
    for (const auto& [grasp, size] : rows_) {
      const std::string which =
          "grasp " + std::to_string(grasp.begin) + ".." + std::to_string(grasp.end) + ": ";
      if (size.unusableFrames > 0)
        lines.push_back(which + counted(size.unusableFrames, "frame") +
                        " without usable joint angles left out");
      if (!size.valid) lines.push_back(which + "no size: " + size.problem);
    }
    return lines;
  }

 private:
  std::vector<GraspSize> rows_;
};

}  // namespace

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
         return std::make_unique<SizeTable>(std::move(rows));
       },
       .rowNoun = "grasp"});
}

}  // namespace palpate::commands
