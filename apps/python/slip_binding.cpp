// Binds palpate.slip(), slip_segments(), slip_benchmark(), contact_moments() and
// synthetic_contact().
#include <algorithm>
#include <cmath>
#include <string>

#include <pybind11/stl.h>

#include "palpate/laboratory/slip_accuracy.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/slip/contact_moments.h"
#include "palpate/slip/contact_outline.h"
#include "palpate/slip/slip_rows.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruption.h"
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

void setReference(const Profile& profile, const py::object& reference, SlipRunOptions& pass) {
  if (py::isinstance<py::str>(reference)) {
    pass.detector.reference = choice<SlipReference>(
        "reference",
        reference.cast<std::string>(),
        {{"first", SlipReference::kFirst}, {"rest", SlipReference::kWhenAtRest}});
    return;
  }
  pass.detector.reference = SlipReference::kGiven;
  pass.referenceFrame = checkedIndex("frame", reference.cast<std::int64_t>(), profile.numFrames());
}

SlipRowsOptions slipOptionsOf(const Profile& profile,
                              std::optional<std::int64_t> matrix,
                              const std::string& method,
                              const py::object& reference,
                              double step,
                              double limit,
                              double rotation) {
  SlipRowsOptions options{.withCentroid = true};
  if (matrix)
    options.matrix =
        static_cast<std::int64_t>(checkedIndex("matrix", *matrix, profile.layout().numMatrices()));
  named("method", method, slipMethods(), [](SlipMethod each) { return nameOf(each); });
  setSlipMethod(options, method);
  SlipDetectorOptions& detector = options.pass.detector;
  detector.rule.stepTaxels = step;
  detector.rule.referenceTaxels = limit;
  detector.rule.rotationDeg = rotation;
  setReference(profile, reference, options.pass);
  detector.validate();
  return options;
}

// The function slip() or slip_segments().
template <bool segments>
Table slipRows(const Profile& profile,
               std::optional<std::int64_t> matrix,
               const std::string& method,
               const py::object& reference,
               double step,
               double limit,
               double rotation) {
  SlipRowsOptions options =
      slipOptionsOf(profile, matrix, method, reference, step, limit, rotation);
  options.segments = segments;
  Table table =
      tableOf([&](const Progress& progress) { return slipTable(profile, options, progress); });
  if constexpr (!segments) {
    // Wide enough for any state, whichever are in the table.
    std::size_t longest = 0;
    for (int state = 0; state <= static_cast<int>(SlipState::kSlip); ++state)
      longest = std::max(longest, std::string(nameOf(static_cast<SlipState>(state))).size());
    const py::str key("state");
    table[key] = py::object(table[key]).attr("astype")("U" + std::to_string(longest));
  }
  return table;
}

py::dict momentsOf(const Numbers& values) {
  const Eigen::MatrixXd given = matrixOf(values, "values");
  constexpr Eigen::Index kMaximum = 256;
  if (given.size() == 0 || given.rows() > kMaximum || given.cols() > kMaximum)
    throw py::value_error("values has shape " + shapeText(values) +
                          "; it takes 1..256 rows and columns");
  const MatrixValues matrix = given.cast<float>();
  const ConstMatrixMap map(matrix.data(), matrix.rows(), matrix.cols());
  const ContactMoments moments = contactMoments(map);
  const PrincipalAxis axis = principalAxis(moments);
  ContactOutline outline(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()));
  const OutlineShape shape = outline.describe(map);
  double squares = 0.0;
  const double mean = moments.active > 0 ? moments.sum / moments.active : 0.0;
  for (const float value : matrix.reshaped())
    if (isTouched(value))
      squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
  py::dict result;
  result["active"] = moments.active;
  result["sum"] = moments.sum;
  result["sd"] = moments.active > 0 ? std::sqrt(squares / moments.active) : 0.0;
  result["x"] = moments.x;
  result["y"] = moments.y;
  result["mu20"] = moments.mu20;
  result["mu11"] = moments.mu11;
  result["mu02"] = moments.mu02;
  result["mu30"] = moments.mu30;
  result["mu03"] = moments.mu03;
  result["orientation_deg"] = axis.orientationDeg;
  result["lambda1"] = axis.lambda1;
  result["lambda2"] = axis.lambda2;
  result["eccentricity"] = axis.eccentricity;
  result["study_eccentricity"] = axis.studyEccentricity;
  result["skew_x"] = axis.skewX;
  result["skew_y"] = axis.skewY;
  result["groups"] = shape.groups;
  result["outline_area"] = shape.area;
  result["outline_length"] = shape.length;
  result["roundness"] = shape.roundness;
  return result;
}

SlipShape shapeNamed(const std::string& name) {
  return named("shape", name, slipShapes(), [](SlipShape each) { return nameOf(each); });
}

py::dict slipBenchmark(double noise,
                       const std::vector<std::string>& shapes,
                       std::uint64_t seed,
                       int trials) {
  SlipAccuracyOptions options;
  options.noiseSd = noise;
  for (const std::string& name : shapes) options.shapes.push_back(shapeNamed(name));
  options.seed = seed;
  options.trials = trials;
  const auto measured = unlocked([&](const Progress& progress) {
    return measureSlipAccuracy(benchmarkedMethods(), options, progress);
  });
  py::dict methods;
  for (const MethodAccuracy& method : measured) {
    const SlipAccuracy& all = method.all;
    py::dict one;
    one["rmse"] = all.rmse;
    one["bias"] = all.bias;
    one["gain_x"] = all.gainX;
    one["gain_y"] = all.gainY;
    one["drift_100"] = all.drift100;
    one["rmse_deg"] = all.rmseDeg;
    one["crb"] = all.crb;
    one["crb_deg"] = all.crbDeg;
    one["edge"] = all.edge;
    one["tilt"] = all.tilt;
    one["invalid"] = all.invalid;
    one["steps"] = all.steps;
    one["ns_per_step"] = all.nsPerStep;
    methods[py::str(method.name)] = one;
  }
  return methods;
}

FloatArray syntheticContact(const Numbers& x,
                            const Numbers& y,
                            const Numbers& angleDeg,
                            const std::string& shape,
                            double peak,
                            double noise,
                            std::uint64_t seed,
                            int rows,
                            int columns) {
  const std::vector<double> xs = vectorOf(x, "x"), ys = vectorOf(y, "y"),
                            angles = vectorOf(angleDeg, "angle_deg");
  if (xs.size() != ys.size() || xs.size() != angles.size())
    throw py::value_error("x, y and angle_deg have different lengths");
  SyntheticSensor sensor;
  sensor.layout = MatrixLayout::full(rows, columns, sensor.layout.pitchMm);
  sensor.layout.validate();
  sensor.noiseSd = noise;
  SyntheticSlip source(sensor, seed);
  SyntheticContact contact;
  contact.shape = shapeNamed(shape);
  contact.peakCounts = peak;
  FloatArray frames({xs.size(), static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)});
  float* out = frames.mutable_data();
  for (std::size_t i = 0; i < xs.size(); ++i, out += rows * columns) {
    if (!std::isfinite(xs[i]) || !std::isfinite(ys[i]) || !std::isfinite(angles[i]))
      throw py::value_error("place " + std::to_string(i) + " isn't a finite number");
    contact.x = xs[i];
    contact.y = ys[i];
    contact.angleDeg = angles[i];
    source.read(contact, MatrixMap(out, rows, columns));
  }
  return frames;
}

}  // namespace

void bindSlip(py::module_& module) {
  const SlipRuleOptions rule;
  const auto def = [&](const char* name, auto function, const char* meaning) {
    module.def(name,
               function,
               py::arg("profile"),
               py::arg("matrix") = py::none(),
               py::arg("method") = nameOf(SlipDetectorOptions{}.method),
               py::kw_only(),
               py::arg("reference") = "first",
               py::arg("step") = rule.stepTaxels,
               py::arg("limit") = rule.referenceTaxels,
               py::arg("rotation") = rule.rotationDeg,
               meaning);
  };
  def("slip",
      &slipRows<false>,
      "Measures how contacts move over a matrix (None: over all), and whether they slip: dict of "
      "columns, a row per frame and matrix that is touched. Taxels (x right, y down) and deg (from "
      "x towards y).\n\nframe, time_ms, matrix, active: int64; x, y: centroid; valid: bool; dx, "
      "dy: motion since the frame before, ref_dx, ref_dy: since the reference (NaN: not known); "
      "rotation_valid, rotation_deg, ref_rotation_deg, orientation_deg; eccentricity, roundness, "
      "residual, confidence, p_moved (NaN: no comparison was needed); state: 'still', 'loading', "
      "'load_shift', 'ambiguous', 'slip', 'invalid'; slipping: bool.\n\nmethod: 'contest', "
      "'register', 'centroid', 'alcazar', 'ncc-paraboloid', 'ncc-gauss3', 'phase', "
      "'phase-normalized'. reference: 'first' (first frame with an active taxel), 'rest' (each "
      "contact when it rests), or a frame. step, limit [taxels], rotation [deg]: thresholds of the "
      "motion per frame, since the reference, and of the rotation.");
  def("slip_segments",
      &slipRows<true>,
      "Lists the slips: dict of columns, a row per slip: begin, end (frames, both inclusive), "
      "begin_ms, end_ms [ms since 1970], matrix, path_taxels, rotation_deg, confidence (0..1). "
      "Arguments as for slip().");
  module.def("contact_moments",
             &momentsOf,
             py::arg("values"),
             "Moments and outline of the contact on one matrix: values (rows, columns); values > 0 "
             "count. dict active, sum, sd (population, of the active values); x, y: centroid "
             "[taxels]; mu20, mu11, mu02, mu30, mu03 (central, per sum) [taxels^2, ^3]; "
             "orientation_deg (0..180, from x towards y), lambda1, lambda2 [taxels^2], "
             "eccentricity, study_eccentricity, skew_x, skew_y; groups, outline_area [taxels^2], "
             "outline_length [taxels], roundness (1: circle) of the largest group.");
  module.def("slip_benchmark",
             &slipBenchmark,
             py::kw_only(),
             py::arg("noise") = SlipAccuracyOptions{}.noiseSd,
             py::arg("shapes") = std::vector<std::string>{},
             py::arg("seed") = SlipAccuracyOptions{}.seed,
             py::arg("trials") = SlipAccuracyOptions{}.trials,
             "Accuracy of every method on synthetic data with known motion, next to the Cramer-Rao "
             "bound: dict method -> dict rmse, bias, drift_100, crb, edge, tilt [taxels], gain_x, "
             "gain_y, rmse_deg, crb_deg [deg], invalid, steps, ns_per_step. noise: sd [counts]; "
             "shapes: empty: all; trials: per shape.");
  module.def(
      "synthetic_contact",
      &syntheticContact,
      py::arg("x"),
      py::arg("y"),
      py::arg("angle_deg"),
      py::kw_only(),
      py::arg("shape") = "disc",
      py::arg("peak") = 1500.0,
      py::arg("noise") = 5.0,
      py::arg("seed") = 1,
      py::arg("rows") = 14,
      py::arg("columns") = 6,
      "Makes the frames of a contact with known motion: its centre x, y [taxels] and angle_deg "
      "[deg] per frame, (n,) each; float32 (n, rows, columns) [counts]. shape: 'disc', 'bar', "
      "'flat-ellipse', 'two-blobs', 'gaussian', 'elliptic-gaussian'; peak, noise (sd) [counts].");
}

}  // namespace palpate::python
