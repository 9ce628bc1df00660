// palpate kinematics: where the taxels are at a set of joint angles.
#include <optional>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

// "10,-20,.." as numbers; throws UsageError naming the option and the piece that is none.
std::vector<double> numbersOf(const std::string& text,
                              const std::string& option,
                              std::size_t count) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (true) {
    const std::size_t comma = text.find(',', at);
    const std::string piece = text.substr(at, comma == std::string::npos ? comma : comma - at);
    const auto number = parseDouble(piece);
    if (!number) throw UsageError("--" + option + ": '" + piece + "' is not a number");
    numbers.push_back(*number);
    if (comma == std::string::npos) break;
    at = comma + 1;
  }
  if (numbers.size() != count)
    throw UsageError("--" + option + " takes " + std::to_string(count) + " numbers, not " +
                     std::to_string(numbers.size()));
  return numbers;
}

void appendRow(std::string& out,
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
    appendNumber(out, value + 0.0);  // no -0
  }
  out += exists ? ",1\n" : ",0\n";
}

}  // namespace

int kinematicsCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate kinematics --angles A0,..,A6 [--matrix M | --point M,X_MM,Y_MM]",
       .purpose =
           "Positions [mm] and outward normals of the taxels in the hand's base frame, as "
           "CSV:\nmatrix,x,y,x_mm,y_mm,z_mm,nx,ny,nz,exists. With --point, of one point of a "
           "sensor surface,\nin mm from the centre of taxel (0, 0); its x and y are then "
           "fractions of taxels.",
       .options = {{"angles", "A0,..,A6", "joint angles [deg]"},
                   {"matrix", "M", "this matrix only, 0..5"},
                   {"point", "M,X_MM,Y_MM", "one point"},
                   {"fingertip",
                    "study|effective",
                    "radius of the bent fingertips: 58 mm (default) or 48.4 mm"}},
       .example = "palpate kinematics --angles 60,-20,40,-20,40,-20,40 --matrix 1",
       .mostWords = 0},
      words);
  if (given.helpShown()) return kDone;
  const auto angles = given.text("angles");
  if (!angles) throw UsageError("kinematics needs --angles A0,..,A6 [deg]");
  if (given.has("matrix") && given.has("point"))
    throw UsageError("--matrix and --point exclude each other");
  const bool effective =
      given.choice("fingertip", {"study", "effective"}).value_or("study") == "effective";
  const HandGeometry geometry(
      sdh2Geometry(effective ? kEffectiveFingertipRadiusMm : kStudyFingertipRadiusMm));
  const SensorLayout& layout = geometry.description().layout;
  const auto lastMatrix = static_cast<std::int64_t>(layout.numMatrices()) - 1;
  const std::optional<std::int64_t> only = given.integer("matrix", 0, lastMatrix);
  const HandPose pose = geometry.pose(numbersOf(*angles, "angles", geometry.description().numAxes));

  std::string out = "matrix,x,y,x_mm,y_mm,z_mm,nx,ny,nz,exists\n";
  if (const auto text = given.text("point")) {
    const std::vector<double> point = numbersOf(*text, "point", 3);
    const auto matrix = static_cast<std::size_t>(std::max(point[0], 0.0));
    if (point[0] != static_cast<double>(matrix) || matrix >= layout.numMatrices())
      throw UsageError("--point: there is no matrix " + numberText(point[0]));
    const double pitchMm = layout.matrix(matrix).pitchMm;
    const double x = point[1] / pitchMm, y = point[2] / pitchMm;
    // The taxel that the point lies in.
    const bool exists = std::abs(x) < 1e6 && std::abs(y) < 1e6 &&
                        layout.matrix(matrix).exists(static_cast<int>(std::floor(y + 0.5)),
                                                     static_cast<int>(std::floor(x + 0.5)));
    appendRow(out,
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
          appendRow(out,
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
