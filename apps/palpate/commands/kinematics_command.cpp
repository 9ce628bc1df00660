// The command `palpate kinematics` prints where the taxels are in space for given joint angles.
#include <cmath>
#include <optional>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/kinematics/taxel_rows.h"
#include "palpate/model/hand_file.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

constexpr double kFarthestMm = 1000.0;

// The place that --point names.
PlacedTaxel placeOf(const std::string& text, const HandPose& pose, const SensorLayout& layout) {
  const std::vector<double> point = numbersOf(text, "point", 3);
  if (!(point[0] >= 0.0 && point[0] == std::floor(point[0])))
    throw UsageError("--point: there is no matrix " + numberText(point[0]));
  if (!(std::abs(point[1]) <= kFarthestMm && std::abs(point[2]) <= kFarthestMm))
    throw UsageError("--point takes mm on the sensor surface, at most " + numberText(kFarthestMm) +
                     " from its first taxel");
  if (point[0] >= static_cast<double>(layout.numMatrices()))
    throw Error("--point: the hand has no matrix " + numberText(point[0]) + ", only 0.." +
                std::to_string(layout.numMatrices() - 1));
  const auto matrix = static_cast<std::size_t>(point[0]);
  const TaxelPitch& pitchMm = layout.matrix(matrix).pitchMm;
  const double x = point[1] / pitchMm.x, y = point[2] / pitchMm.y;
  return {matrix,
          x,
          y,
          pose.pointMm(matrix, point[1], point[2]),
          pose.normalAt(matrix, point[1], point[2]),
          layout.matrix(matrix).exists(static_cast<int>(std::floor(y + 0.5)),
                                       static_cast<int>(std::floor(x + 0.5)))};
}

}  // namespace

int kinematicsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate kinematics --angles A0,A1,.. [--hand NAME|FOLDER] [--matrix M | --point "
           "M,X_MM,Y_MM]",
       .purpose = "Prints positions [mm] and outward normals of the taxels in the hand's base "
                  "frame, as CSV: matrix,x,y,x_mm,y_mm,z_mm,nx,ny,nz,exists. With --point it "
                  "prints those of one point of a sensor surface, given in mm from the centre of "
                  "taxel (0, 0); x and y are then fractions of taxels.",
       .options =
           withOneTableOptions({anglesOption(),
                                handOption(),
                                rangedWhole("matrix", "M", "only this matrix", kMatrixOption),
                                {"point", "M,X_MM,Y_MM", "one point"},
                                fingertipOption()}),
       .example = "palpate kinematics --angles 60,-20,40,-20,40,-20,40 --matrix 1",
       .maxArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  const HandDescription hand = handOf(given).value_or(defaultHand());
  auto angles = anglesOf(given, hand);
  if (!angles && hand.axes.empty()) angles.emplace();
  if (!angles) throw UsageError("kinematics needs --angles A0,A1,.. [deg]");
  if (given.has("matrix") && given.has("point"))
    throw UsageError("--matrix and --point can't be used together");
  const HandGeometry geometry(geometryOf(given, hand));
  const SensorLayout& layout = geometry.description().layout;
  const auto only = given.integer("matrix", kMatrixOption);
  if (only && *only >= static_cast<std::int64_t>(layout.numMatrices()))
    throw Error("the hand has no matrix " + std::to_string(*only) + ", only 0.." +
                std::to_string(layout.numMatrices() - 1));
  const HandPose pose = geometry.pose(*angles);
  std::vector<PlacedTaxel> places;
  if (const auto text = given.text("point"))
    places = {placeOf(*text, pose, layout)};
  else
    places = taxelPlaces(
        pose, layout, only ? std::optional(static_cast<std::size_t>(*only)) : std::nullopt);
  return writeTable(given, *taxelTable(std::move(places)));
}

}  // namespace palpate::commands
