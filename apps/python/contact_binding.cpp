// Binds palpate.contact() and object_size().
#include <limits>
#include <string>

#include <pybind11/stl.h>

#include "palpate/core/progress.h"
#include "palpate/kinematics/contact_rows.h"
#include "palpate/kinematics/object_size.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/geometry.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

const Eigen::Vector3d kNowhere =
    Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
constexpr double kContactUnknown = std::numeric_limits<double>::quiet_NaN();

struct ContactRow {
  HandContact contact;
  bool posed = false;  // the joint angles are usable
};

std::vector<ContactRow> contactRowsOf(const Profile& profile,
                                      const GeometryDescription& geometry,
                                      const ContactRowsOptions& options,
                                      const Progress& progress) {
  std::vector<ContactRow> rows;
  for (ContactRun run(profile, geometry, options); run.next();) {
    reportProgress(progress, run.frame() - options.first, options.last - options.first + 1);
    rows.push_back({run.contact(), run.isPosed()});
    rows.back().contact.activeMm = {};  // large, and not part of the result
  }
  return rows;
}

// Shape (T, 3).
template <typename Of>
DoubleArray places(const std::vector<ContactRow>& rows, const Of& of) {
  return grid<double>(rows.size(), 3, [&](std::size_t i, std::size_t axis) {
    const std::optional<Eigen::Vector3d> place = of(rows[i].contact);
    return (rows[i].posed && place ? *place : kNowhere)[static_cast<Eigen::Index>(axis)];
  });
}

template <typename Of>
DoubleArray radii(const std::vector<ContactRow>& rows, const Of& of) {
  return column<double>(rows.size(), [&](std::size_t i) {
    const std::optional<Sphere>& sphere = of(rows[i].contact);
    return rows[i].posed && sphere ? sphere->radiusMm : kContactUnknown;
  });
}

// Shape (T, matrices): of(matrix), or NaN for an untouched matrix and, when a pose is needed, for
// frames without one.
template <typename Of>
DoubleArray perMatrix(const std::vector<ContactRow>& rows,
                      std::size_t numMatrices,
                      bool needsPose,
                      const Of& of) {
  return grid<double>(rows.size(), numMatrices, [&](std::size_t i, std::size_t m) {
    const MatrixContact& matrix = rows[i].contact.matrices[m];
    const bool known = matrix.numActive > 0 && (rows[i].posed || !needsPose);
    return known ? of(matrix) : kContactUnknown;
  });
}

// Shape (T, matrices, 3).
template <typename Of>
DoubleArray vectorsPerMatrix(const std::vector<ContactRow>& rows,
                             std::size_t numMatrices,
                             const Of& of) {
  DoubleArray array({rows.size(), numMatrices, std::size_t{3}});
  double* out = array.mutable_data();
  for (const ContactRow& row : rows)
    for (const MatrixContact& matrix : row.contact.matrices) {
      const Eigen::Vector3d vector = row.posed && matrix.numActive > 0 ? of(matrix) : kNowhere;
      for (const double value : {vector.x(), vector.y(), vector.z()}) *out++ = value;
    }
  return array;
}

void addMatrices(const std::vector<ContactRow>& rows, std::size_t count, py::dict& table) {
  using Matrix = const MatrixContact&;
  table["matrix_active"] =
      grid<std::int64_t>(rows.size(), count, [&](std::size_t i, std::size_t m) {
        return rows[i].contact.matrices[m].numActive;
      });
  table["sum"] = grid<double>(rows.size(), count, [&](std::size_t i, std::size_t m) {
    return rows[i].contact.matrices[m].sum;
  });
  table["area_mm2"] = grid<double>(rows.size(), count, [&](std::size_t i, std::size_t m) {
    return rows[i].contact.matrices[m].areaMm2;
  });
  table["surface_x_mm"] = perMatrix(rows, count, false, [](Matrix m) { return m.xMm; });
  table["surface_y_mm"] = perMatrix(rows, count, false, [](Matrix m) { return m.yMm; });
  table["centroid_mm"] = vectorsPerMatrix(rows, count, [](Matrix m) { return m.centroidMm; });
  table["normal"] = vectorsPerMatrix(rows, count, [](Matrix m) { return m.meanNormal; });
  table["major"] = vectorsPerMatrix(rows, count, [](Matrix m) { return m.majorAxis; });
  table["minor"] = vectorsPerMatrix(rows, count, [](Matrix m) { return m.minorAxis; });
  table["major_sd_mm"] = perMatrix(rows, count, true, [](Matrix m) { return m.majorSdMm; });
  table["minor_sd_mm"] = perMatrix(rows, count, true, [](Matrix m) { return m.minorSdMm; });
}

py::dict contact(const Profile& profile,
                 const std::optional<Numbers>& anglesDeg,
                 double threshold,
                 const std::string& fingertip,
                 std::int64_t start,
                 std::optional<std::int64_t> stop) {
  const GeometryDescription geometry = geometryNamed(profile.hand(), fingertip);
  ContactRowsOptions options;
  if (anglesDeg) options.anglesDeg = vectorOf(*anglesDeg, "angles_deg");
  if (!options.anglesDeg && profile.numAngles() == 0)
    throw py::value_error("this recording has no joint angles: assume some with angles_deg");
  options.contact.threshold = threshold;
  options.contact.validate();
  const auto range = sliceOf(start, stop, profile.numFrames());
  options.first = range.first;
  std::vector<ContactRow> rows;
  if (range.second > range.first) {
    options.last = range.second - 1;
    rows = unlocked([&](const Progress& progress) {
      return contactRowsOf(profile, geometry, options, progress);
    });
  }
  py::dict table;
  table["frame"] =
      column<std::int64_t>(rows.size(), [&](std::size_t i) { return range.first + i; });
  table["time_ms"] = column<std::int64_t>(
      rows.size(), [&](std::size_t i) { return profile.frameTimeUs(range.first + i) / kUsPerMs; });
  table["active"] =
      column<std::int64_t>(rows.size(), [&](std::size_t i) { return rows[i].contact.numActive; });
  const auto centre = [](const std::optional<Sphere>& sphere) {
    return sphere ? std::optional(sphere->centreMm) : std::nullopt;
  };
  using Contact = const HandContact&;
  table["sphere_mm"] = places(rows, [&](Contact c) { return centre(c.taxelSphere); });
  table["sphere_radius_mm"] =
      radii(rows, [](Contact c) -> const std::optional<Sphere>& { return c.taxelSphere; });
  table["centroid_sphere_mm"] = places(rows, [&](Contact c) { return centre(c.centroidSphere); });
  table["centroid_sphere_radius_mm"] =
      radii(rows, [](Contact c) -> const std::optional<Sphere>& { return c.centroidSphere; });
  addMatrices(rows, profile.layout().numMatrices(), table);
  return table;
}

py::dict sizeOf(const Profile& profile,
                std::int64_t begin,
                std::int64_t end,
                const std::string& fingertip) {
  const HandGeometry geometry(geometryNamed(profile.hand(), fingertip));
  const std::size_t first = checkedIndex("frame", begin, profile.numFrames()),
                    last = checkedIndex("frame", end, profile.numFrames());
  if (first > last) throw py::value_error("begin is after end");
  const ObjectSizeReport report = unlocked([&](const Progress& progress) {
    return objectSize(profile, geometry, first, last, {}, progress);
  });
  py::dict result;
  result["valid"] = report.valid;
  result["trouble"] = report.problem;
  result["pads"] = py::make_tuple(report.pads.first, report.pads.second);
  result["start_frame"] = report.startFrame;
  result["plateau_frame"] = report.plateauFrame;
  const auto known = [&](double mm) { return report.valid ? mm : kContactUnknown; };
  result["start_mm"] = known(report.startMm);
  result["plateau_mm"] = known(report.plateauMm);
  result["shrink_mm"] = known(report.shrinkMm);
  result["foam_mm"] = known(report.foamMm);
  result["compression_mm"] = known(report.compressionMm);
  result["compression_sd_mm"] = known(report.compressionSdMm);
  result["diameter_mm"] = known(report.diameterMm);
  result["diameter_sd_mm"] = known(report.diameterSdMm);
  result["sphere_mm"] = known(report.spherePlateauMm);
  const std::vector<SizeSample>& all = report.samples;
  result["frame"] = column<std::int64_t>(all.size(), [&](std::size_t i) { return all[i].frame; });
  result["distance_mm"] =
      column<double>(all.size(), [&](std::size_t i) { return all[i].distanceMm; });
  result["sphere_diameter_mm"] =
      column<double>(all.size(), [&](std::size_t i) { return all[i].sphereMm; });
  result["load"] = column<double>(all.size(), [&](std::size_t i) { return all[i].load; });
  return result;
}

}  // namespace

void bindContact(py::module_& module) {
  module.def(
      "contact",
      &contact,
      py::arg("profile"),
      py::kw_only(),
      py::arg("angles_deg") = py::none(),
      py::arg("threshold") = ContactOptions{}.threshold,
      py::arg("fingertip") = "study",
      py::arg("start") = 0,
      py::arg("stop") = py::none(),
      "Where a hand touches, for the frames start..stop (exclusive), in its base frame [mm]: "
      "dict of columns frame, time_ms, active (T,); sphere_mm (T, 3), sphere_radius_mm (T,): the "
      "smallest sphere around all active taxels, centroid_sphere_mm, centroid_sphere_radius_mm: "
      "around the matrices' centroids; per matrix (T, M): matrix_active, sum [counts], area_mm2, "
      "surface_x_mm, surface_y_mm (centroid on the surface), major_sd_mm, minor_sd_mm; (T, M, 3): "
      "centroid_mm, normal, major, minor (unit vectors). NaN where nothing touches or the joint "
      "angles are unusable. angles_deg (axes,): assumed for all frames; threshold: active is above "
      "it [counts]. ValueError without joint angles, Error for a hand without geometry.");
  module.def("object_size",
             &sizeOf,
             py::arg("profile"),
             py::arg("begin"),
             py::arg("end"),
             py::kw_only(),
             py::arg("fingertip") = "effective",
             "How large what is held in frames begin..end (both inclusive) is, and how much it "
             "gives way: dict valid, trouble (why not; the sizes are NaN then), pads, start_frame, "
             "plateau_frame, "
             "start_mm, plateau_mm, shrink_mm, foam_mm, compression_mm, compression_sd_mm, "
             "diameter_mm, diameter_sd_mm, sphere_mm [mm]; its course: frame, distance_mm, "
             "sphere_diameter_mm [mm], load (0..1): (n,).");
}

}  // namespace palpate::python
