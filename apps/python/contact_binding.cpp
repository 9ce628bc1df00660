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
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

constexpr double kContactUnknown = std::numeric_limits<double>::quiet_NaN();

// The columns of each frame and of each matrix in it.
struct ContactCells {
  std::vector<ColumnOf<FrameContact>> ofFrame = frameContactColumns(true);
  std::vector<ColumnOf<PlacedContact>> ofMatrix;
  ColumnCells frames{columnsOf(ofFrame)}, matrices{columnsOf(ofMatrix)};
  std::size_t numFrames = 0, numUnusable = 0;
  std::string whyUnusable = {};
};

void readContacts(const Profile& profile,
                  const GeometryDescription& geometry,
                  const ContactRowsOptions& options,
                  const Progress& progress,
                  ContactCells& cells) {
  for (ContactRun run(profile, geometry, options); run.next();) {
    reportProgress(progress, run.frame() - options.first, options.last - options.first + 1);
    ++cells.numFrames;
    if (!run.isPosed() && cells.numUnusable++ == 0) cells.whyUnusable = run.angles().problem;
    cells.frames.add(cells.ofFrame, contactOfFrame(run));
    for (const MatrixContact& matrix : run.contact().matrices)
      cells.matrices.add(cells.ofMatrix, PlacedContact{matrix, run.isPosed()});
  }
}

Table contactTableOf(const ContactCells& cells, std::size_t numMatrices) {
  TableMaker table;
  const auto axes = [](const std::string& before, const char* behind) {
    return std::vector<std::string>{
        before + "x" + behind, before + "y" + behind, before + "z" + behind};
  };
  for (const char* name : {"frame", "time_ms", "active"}) table.add(name, cells.frames, {name});
  for (const std::string name : {"sphere", "centroid_sphere"}) {
    table.add(name + "_mm", cells.frames, axes(name + "_", "_mm"));
    table.add(name + "_radius_mm", cells.frames, {name + "_radius_mm"});
  }
  const auto add = [&](const char* name, const std::vector<std::string>& of) {
    table.add(name, cells.matrices, of, numMatrices);
  };
  add("matrix_active", {"active"});
  for (const char* name : {"sum", "area_mm2", "surface_x_mm", "surface_y_mm"}) add(name, {name});
  add("centroid_mm", axes("centroid_", "_mm"));
  add("normal", axes("n", ""));
  add("major", axes("major_", ""));
  add("minor", axes("minor_", ""));
  for (const char* name : {"major_sd_mm", "minor_sd_mm"}) add(name, {name});
  if (cells.numUnusable > 0)
    table.note({std::to_string(cells.numUnusable) + " of " + std::to_string(cells.numFrames) +
                " frames have no usable joint angles, so no position in space: " +
                cells.whyUnusable + "; pass angles_deg to assume some"});
  return table.finish();
}

Table contact(const Profile& profile,
              const std::optional<Numbers>& anglesDeg,
              double threshold,
              const std::string& fingertip,
              std::int64_t start,
              std::optional<std::int64_t> stop) {
  const GeometryDescription geometry = geometryNamed(profile.hand(), fingertip);
  ContactRowsOptions options;
  if (anglesDeg) options.anglesDeg = vectorOf(*anglesDeg, "angles_deg");
  if (!options.anglesDeg && profile.numAngles() == 0)
    throw py::value_error("this recording has no joint angles: pass angles_deg to assume some");
  options.contact.threshold = threshold;
  options.contact.validate();
  const auto range = sliceOf(start, stop, profile.numFrames());
  options.first = range.first;
  ContactCells cells{.ofMatrix = matrixContactColumns(profile.hand().unit)};
  if (range.second > range.first) {
    options.last = range.second - 1;
    unlocked([&](const Progress& progress) {
      readContacts(profile, geometry, options, progress, cells);
    });
  }
  return contactTableOf(cells, profile.layout().numMatrices());
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
      "Where the hand touches, in the frames start..stop (exclusive), in its base frame [mm]: dict "
      "of columns frame, time_ms, active (T,); sphere_mm (T, 3), sphere_radius_mm (T,): the "
      "smallest sphere around all active taxels, centroid_sphere_mm, centroid_sphere_radius_mm: "
      "around the matrices' centroids; per matrix (T, M): matrix_active, sum [counts], area_mm2, "
      "surface_x_mm, surface_y_mm (centroid on the surface), major_sd_mm, minor_sd_mm; (T, M, 3): "
      "centroid_mm, normal, major, minor (unit vectors). NaN where nothing touches or the joint "
      "angles are unusable. angles_deg (axes,): assumed for all frames; threshold: taxels above it "
      "are active [counts]. ValueError without joint angles, Error for a hand without geometry.");
  module.def("object_size",
             &sizeOf,
             py::arg("profile"),
             py::arg("begin"),
             py::arg("end"),
             py::kw_only(),
             py::arg("fingertip") = "effective",
             "Size and softness of the object that is held in frames begin..end (both inclusive): "
             "dict valid, trouble (why not valid; the sizes are then NaN), pads, start_frame, "
             "plateau_frame, start_mm, plateau_mm, shrink_mm, foam_mm, compression_mm, "
             "compression_sd_mm, diameter_mm, diameter_sd_mm, sphere_mm [mm]; over time: frame, "
             "distance_mm, sphere_diameter_mm [mm], load (0..1): (n,).");
}

}  // namespace palpate::python
