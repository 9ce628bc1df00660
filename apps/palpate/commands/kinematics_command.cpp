// The command `palpate kinematics` prints where the taxels are in space for given joint angles.
#include <cmath>
#include <optional>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"

namespace palpate::commands {
namespace {

constexpr double kFarthestMm = 1000.0;

void kinematicsAppendRow(std::string& out,
                         std::size_t matrix,
                         double x,
                         double y,
                         const Eigen::Vector3d& positionMm,
                         const Eigen::Vector3d& normal,
                         bool exists) {
  appendNumber(out, static_cast<std::int64_t>(matrix));
  for (const double value :
       {x, y, positionMm.x(), positionMm.y(), positionMm.z(), normal.x(), normal.y(), normal.z()}) {
    out += ',';
    appendNumber(out, value + 0.0);  // avoids -0
  }
  out += exists ? ",1\n" : ",0\n";
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
       .options = {anglesOption(),
                   handOption(),
                   rangedWhole("matrix", "M", "this matrix only", kMatrixOption),
                   {"point", "M,X_MM,Y_MM", "one point"},
                   fingertipOption()},
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
  const auto lastMatrix = static_cast<std::int64_t>(layout.numMatrices()) - 1;
  const std::optional<std::int64_t> only = given.integer("matrix", 0, lastMatrix);
  const HandPose pose = geometry.pose(*angles);

  std::string out = "matrix,x,y,x_mm,y_mm,z_mm,nx,ny,nz,exists\n";
  if (const auto text = given.text("point")) {
    const std::vector<double> point = numbersOf(*text, "point", 3);
    if (!(point[0] >= 0.0 && point[0] <= static_cast<double>(lastMatrix) &&
          point[0] == std::floor(point[0])))
      throw UsageError("--point: there is no matrix " + numberText(point[0]));
    if (!(std::abs(point[1]) <= kFarthestMm && std::abs(point[2]) <= kFarthestMm))
      throw UsageError("--point takes mm on the sensor surface, at most " +
                       numberText(kFarthestMm) + " from its first taxel");
    const auto matrix = static_cast<std::size_t>(point[0]);
    const TaxelPitch& pitchMm = layout.matrix(matrix).pitchMm;
    const double x = point[1] / pitchMm.x, y = point[2] / pitchMm.y;
    // Whether the taxel at that point exists.
    const bool exists = layout.matrix(matrix).exists(static_cast<int>(std::floor(y + 0.5)),
                                                     static_cast<int>(std::floor(x + 0.5)));
    kinematicsAppendRow(out,
                        matrix,
                        x,
                        y,
                        pose.pointMm(matrix, point[1], point[2]),
                        pose.normalAt(matrix, point[1], point[2]),
                        exists);
  } else {
    for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
      if (only && static_cast<std::size_t>(*only) != m) continue;
      for (int y = 0; y < layout.matrix(m).rows; ++y)
        for (int x = 0; x < layout.matrix(m).columns; ++x)
          kinematicsAppendRow(out,
                              m,
                              x,
                              y,
                              pose.positionMm(m, y, x),
                              pose.normal(m, y, x),
                              layout.matrix(m).exists(y, x));
    }
  }
  StandardOutput output;
  output.write(out);
  output.finish();
  return kDone;
}

}  // namespace palpate::commands
