// Binds palpate.kinematics(), surface_points(), preshape() and bounding_sphere().
#include <cmath>
#include <string>

#include <pybind11/stl.h>

#include "palpate/kinematics/bounding_sphere.h"
#include "palpate/kinematics/joint_range.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/geometry.h"
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;

GeometryDescription geometryNamed(const HandDescription& hand, const std::string& fingertip) {
  return describeGeometry(hand, choice<BendRadius>("fingertip", fingertip, kBendRadiusWords));
}

namespace {

// Poses from an array: shape (axes,) is one pose, (n, axes) are n poses.
struct Poses {
  bool several = false;
  std::vector<std::vector<double>> anglesDeg;
};

Poses posesOf(const Numbers& angles, const HandDescription& hand) {
  const std::size_t numAxes = hand.axes.size();
  Poses poses;
  poses.several = angles.ndim() == 2;
  const auto width = static_cast<py::ssize_t>(numAxes);
  if ((angles.ndim() != 1 && !poses.several) || angles.shape(angles.ndim() - 1) != width)
    throw py::value_error("angles_deg has shape " + shapeText(angles) + "; it takes (" +
                          std::to_string(numAxes) + ",) or (n, " + std::to_string(numAxes) + ")");
  const py::ssize_t count = poses.several ? angles.shape(0) : 1;
  for (py::ssize_t i = 0; i < count; ++i)
    poses.anglesDeg.emplace_back(angles.data() + i * width, angles.data() + (i + 1) * width);
  // Invalid angles are refused as on the command line, because the hand cannot have such a pose.
  for (std::size_t i = 0; i < poses.anglesDeg.size(); ++i) {
    const AnglesCheck check = checkAngles(poses.anglesDeg[i], hand.axes);
    if (check.state == AngleValidity::kValid) continue;
    throw py::value_error("angles_deg" + (poses.several ? "[" + std::to_string(i) + "]" : "") +
                          ": " + check.problem);
  }
  return poses;
}

// Shape (n, k, 3), or (k, 3) for a single pose.
DoubleArray vectors(const Poses& poses, std::size_t k) {
  std::vector<std::size_t> shape = {k, 3};
  if (poses.several) shape.insert(shape.begin(), poses.anglesDeg.size());
  return DoubleArray(shape);
}

double* put(double* out, const Eigen::Vector3d& vector) {
  for (const double value : {vector.x(), vector.y(), vector.z()}) *out++ = value;
  return out;
}

Table placesTable(TableMaker& table, const DoubleArray& positions, const DoubleArray& normals) {
  table.add({"position_mm", CellKind::kNumber, "mm", "in the hand's base frame"}, positions);
  table.add({"normal", CellKind::kNumber, "", "outwards, a unit vector"}, normals);
  return table.finish();
}

Table kinematics(const Numbers& anglesDeg,
                 const std::string& fingertip,
                 const py::object& handOrName) {
  const HandDescription described = handGiven(handOrName);
  const HandGeometry geometry(geometryNamed(described, fingertip));
  const GeometryDescription& hand = geometry.description();
  const Poses poses = posesOf(anglesDeg, described);
  const std::size_t places = hand.layout.numCells();
  DoubleArray positions = vectors(poses, places), normals = vectors(poses, places);
  double *position = positions.mutable_data(), *normal = normals.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    HandPose pose;
    for (const std::vector<double>& angles : poses.anglesDeg) {
      geometry.pose(angles, pose);
      for (const Eigen::Vector3d& one : pose.positionsMm()) position = put(position, one);
      for (const Eigen::Vector3d& one : pose.normals()) normal = put(normal, one);
    }
  }
  std::vector<std::int64_t> matrix, x, y;
  std::vector<std::uint8_t> exists;
  for (std::size_t m = 0; m < hand.layout.numMatrices(); ++m)
    for (int row = 0; row < hand.layout.matrix(m).rows; ++row)
      for (int column = 0; column < hand.layout.matrix(m).columns; ++column) {
        matrix.push_back(static_cast<std::int64_t>(m));
        x.push_back(column);
        y.push_back(row);
        exists.push_back(hand.layout.matrix(m).exists(row, column) ? 1 : 0);
      }
  TableMaker table;
  table.add({"matrix", CellKind::kInteger, "", "number of the matrix, from 0"}, arrayOf(matrix));
  table.add({"x", CellKind::kInteger, "taxels", "column"}, arrayOf(x));
  table.add({"y", CellKind::kInteger, "taxels", "row"}, arrayOf(y));
  table.add({"exists", CellKind::kFlag, "", "whether there is a taxel"},
            column<bool>(places, [&](std::size_t i) { return exists[i] != 0; }));
  return placesTable(table, positions, normals);
}

Table surfacePoints(const Numbers& anglesDeg,
                    const Numbers& points,
                    const std::string& fingertip,
                    const py::object& handOrName) {
  const HandDescription hand = handGiven(handOrName);
  const HandGeometry geometry(geometryNamed(hand, fingertip));
  const Poses poses = posesOf(anglesDeg, hand);
  const std::vector<Eigen::Vector3d> wanted = pointsOf(points, "points");
  std::vector<std::size_t> matrices;
  for (const Eigen::Vector3d& point : wanted) {
    if (point.x() != std::floor(point.x()) || std::abs(point.x()) > 1e6)
      throw py::value_error(
          "the first column of points is the number of a matrix: it must be whole");
    matrices.push_back(checkedIndex("matrix",
                                    static_cast<std::int64_t>(point.x()),
                                    geometry.description().layout.numMatrices()));
  }
  DoubleArray positions = vectors(poses, wanted.size()), normals = vectors(poses, wanted.size());
  double *position = positions.mutable_data(), *normal = normals.mutable_data();
  for (const std::vector<double>& angles : poses.anglesDeg) {
    const HandPose pose = geometry.pose(angles);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      position = put(position, pose.pointMm(matrices[i], wanted[i].y(), wanted[i].z()));
      normal = put(normal, pose.normalAt(matrices[i], wanted[i].y(), wanted[i].z()));
    }
  }
  TableMaker table;
  return placesTable(table, positions, normals);
}

py::object sphereAround(const Numbers& points) {
  const auto sphere = smallestEnclosingSphere(pointsOf(points, "points_mm"));
  if (!sphere) return py::none();
  return py::make_tuple(arrayOf(Eigen::VectorXd(sphere->centreMm)), sphere->radiusMm);
}

std::vector<Preshape> preshapesOf(const HandDescription& hand) {
  return hand.file ? hand.file->preshapes : std::vector<Preshape>();
}

py::dict preshapes(const py::object& hand) {
  py::dict result;
  for (const Preshape& preshape : preshapesOf(handGiven(hand)))
    result[py::str(preshape.name)] = preshape.title;
  return result;
}

}  // namespace

void bindKinematics(py::module_& module) {
  module.def("kinematics",
             &kinematics,
             py::arg("angles_deg"),
             py::kw_only(),
             py::arg("fingertip") = "study",
             py::arg("hand") = py::none(),
             "Computes where the taxels of a hand are: angles_deg (axes,) or (n, axes) [deg; mm "
             "for an axis that slides], within the range of its axes or a degree beyond, else "
             "ValueError. dict matrix, x, y, exists (places,): which taxel; position_mm (places, "
             "3) or (n, places, 3) [mm] in the hand's base frame, normal: unit vectors out of the "
             "sensor, of the same shape. fingertip: radius of bent fingertips, 'study' (nominal; "
             "SDH-2: 58 mm) or 'effective' (48.4 mm, which makes a rigid object measure the same). "
             "hand: a Hand, its name or folder; None: the SDH-2.");
  module.def("surface_points",
             &surfacePoints,
             py::arg("angles_deg"),
             py::arg("points"),
             py::kw_only(),
             py::arg("fingertip") = "study",
             py::arg("hand") = py::none(),
             "Computes points on the surfaces of the sensors, also between taxels: points (k, 3), "
             "rows of matrix, x_mm, y_mm from the centre of taxel (0, 0). dict position_mm, normal "
             "(k, 3) or (n, k, 3), as kinematics().");
  module.def(
      "bounding_sphere",
      &sphereAround,
      py::arg("points_mm"),
      "The smallest sphere around points (n, 3) [mm]: (centre (3,), radius); None without points.");
  module.def("preshapes",
             &preshapes,
             py::arg("hand") = py::none(),
             "Grasp preshapes of a hand (None: the SDH-2): dict name -> title.");
  module.def(
      "preshape",
      [](const std::string& name, double close, const py::object& hand) {
        return arrayOf(findPreshape(preshapesOf(handGiven(hand)), name).anglesDeg(close));
      },
      py::arg("name"),
      py::arg("close") = 0.0,
      py::arg("hand") = py::none(),
      "Joint values of a preshape of a hand (None: the SDH-2), close 0 (open) .. 1 (closed): "
      "(axes,) [deg; mm].");
}

}  // namespace palpate::python
