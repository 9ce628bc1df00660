#include "palpate/slip/slip_rows.h"

#include <stdexcept>
#include <tuple>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/model/matrix_rows.h"

namespace palpate {
namespace {

using Segment = SlipSegment;
using Detection = SlipDetection;

std::vector<ColumnOf<Segment>> segmentColumns() {
  return {columnOf<Segment>("begin", "", "first frame", &Segment::begin),
          columnOf<Segment>("end", "", "last frame", &Segment::end),
          columnOf<Segment>("begin_ms",
                            "ms",
                            "host time of the first frame, since 1970",
                            [](const Segment& s) { return s.beginUs / kUsPerMs; }),
          columnOf<Segment>("end_ms",
                            "ms",
                            "host time of the last frame, since 1970",
                            [](const Segment& s) { return s.endUs / kUsPerMs; }),
          columnOf<Segment>("matrix", "", "number of the matrix, from 0", &Segment::matrix),
          columnOf<Segment>("path_taxels", "taxels", "length of the path", &Segment::pathTaxels),
          columnOf<Segment>("rotation_deg", "deg", "sum of the rotations", &Segment::rotationDeg),
          columnOf<Segment>(
              "confidence", "", "largest confidence of its frames, 0 to 1", &Segment::confidence)};
}

// A column of the motion, or of the rotation, that is known where `known` says so.
template <typename Of, typename Known>
ColumnOf<Detection> motionColumn(
    const char* name, const char* unit, const char* meaning, Of of, Known known) {
  return columnOf<Detection>(name, unit, meaning, [of, known](const Detection& detection) {
    const SlipMotion& motion = detection.motion;
    return knownIf(known(motion), of(motion));
  });
}
using Motion = const SlipMotion&;
bool hasMoved(Motion m) { return m.valid; }
bool hasReference(Motion m) { return m.valid && m.refValid; }
bool hasTurned(Motion m) { return m.rotation.valid; }
bool hasTurnedFromReference(Motion m) { return m.rotation.valid && m.rotation.refValid; }

}  // namespace

std::vector<ColumnOf<SlipDetection>> slipColumns(bool withCentroid) {
  std::vector<ColumnOf<Detection>> columns = {
      columnOf<Detection>(
          "active", "taxels", "touched taxels", [](const auto& v) { return v.motion.active; }),
      columnOf<Detection>("valid",
                          "",
                          "whether the motion since the frame before is known",
                          [](const auto& v) { return v.motion.valid; }),
      motionColumn(
          "dx",
          "taxels",
          "motion since the frame before, to the right",
          [](Motion m) { return m.dx; },
          hasMoved),
      motionColumn(
          "dy",
          "taxels",
          "motion since the frame before, downwards",
          [](Motion m) { return m.dy; },
          hasMoved),
      motionColumn(
          "ref_dx",
          "taxels",
          "motion since the reference, to the right",
          [](Motion m) { return m.refDx; },
          hasReference),
      motionColumn(
          "ref_dy",
          "taxels",
          "motion since the reference, downwards",
          [](Motion m) { return m.refDy; },
          hasReference),
      columnOf<Detection>("rotation_valid",
                          "",
                          "whether the rotation is known",
                          [](const auto& v) { return hasTurned(v.motion); }),
      motionColumn(
          "rotation_deg",
          "deg",
          "rotation since the frame before",
          [](Motion m) { return m.rotation.rotationDeg; },
          hasTurned),
      motionColumn(
          "ref_rotation_deg",
          "deg",
          "rotation since the reference",
          [](Motion m) { return m.rotation.refRotationDeg; },
          hasTurnedFromReference),
      columnOf<Detection>("orientation_deg",
                          "deg",
                          "direction of the contact's long axis",
                          [](const auto& v) { return v.motion.rotation.axis.orientationDeg; }),
      columnOf<Detection>("eccentricity",
                          "",
                          "of the contact: 0 round, 1 a line",
                          [](const auto& v) { return v.motion.rotation.axis.eccentricity; }),
      columnOf<Detection>("roundness",
                          "",
                          "of the contact's outline: 1 a circle",
                          [](const auto& v) { return v.motion.rotation.roundness; }),
      columnOf<Detection>("residual", "", "what the motion doesn't explain", &Detection::residual),
      columnOf<Detection>("confidence", "", "of the state, 0 to 1", &Detection::confidence),
      columnOf<Detection>("p_moved",
                          "",
                          "probability that the contact moved, not only its load",
                          &Detection::pMoved),
      columnOf<Detection>(
          "state", "", "what the contact does", [](const auto& v) { return nameOf(v.state); }),
      columnOf<Detection>("slipping", "", "whether that is slip", &Detection::slipping)};
  if (!withCentroid) return columns;
  for (const auto& [name, meaning, of] :
       {std::tuple("y", "centroid, downwards", &SlipMotion::y),
        std::tuple("x", "centroid, to the right", &SlipMotion::x)})
    columns.insert(columns.begin() + 1,
                   columnOf<Detection>(
                       name, "taxels", meaning, [of](const Detection& v) { return v.motion.*of; }));
  return columns;
}

std::unique_ptr<ResultTable> slipTable(const Profile& profile,
                                       const SlipRowsOptions& options,
                                       const Progress& progress) {
  const auto wanted = [only = options.matrix](std::size_t matrix) {
    return !only || *only == static_cast<std::int64_t>(matrix);
  };
  const auto noted = [&profile](std::unique_ptr<ResultTable> table) {
    if (!profile.layout().hasSquareTaxels())
      table->note("no rotation is measured where taxels aren't square");
    return table;
  };
  if (options.segments) {
    std::vector<SlipSegment> found = findSlips(profile, {.pass = options.pass}, progress);
    std::erase_if(found, [&](const SlipSegment& each) { return !wanted(each.matrix); });
    return noted(std::make_unique<RowTable<SlipSegment>>(
        "slip_segments", segmentColumns(), std::move(found)));
  }
  using Row = MatrixRow<SlipDetection>;
  return noted(std::make_unique<RowTable<Row>>(
      "slip",
      matrixRowColumns(slipColumns(options.withCentroid)),
      [run = std::make_shared<SlipRun>(profile, options.pass),
       numFrames = profile.numFrames(),
       wanted,
       progress](std::vector<Row>& rows) {
        if (!run->next()) return false;
        reportProgress(progress, run->frame(), numFrames);
        const std::vector<SlipDetection>& detections = run->detections();
        for (std::size_t m = 0; m < detections.size(); ++m)
          if (detections[m].motion.active > 0 && wanted(m))
            rows.push_back({run->frame(), run->timeUs(), m, detections[m]});
        return true;
      }));
}

void setSlipMethod(SlipRowsOptions& table, std::string_view name) {
  const auto method = slipMethodNamed(name);
  if (!method) throw std::invalid_argument("there is no method '" + shortened(name) + "' of slip");
  table.pass.detector.method = *method;
  table.pass.detector.hypothesisAlarm = *method == SlipMethod::kContest;
}

void setSlipReference(SlipRowsOptions& table, const std::string& word) {
  SlipDetectorOptions& detector = table.pass.detector;
  if (word == "first") {
    detector.reference = SlipReference::kFirst;
  } else if (word == "rest") {
    detector.reference = SlipReference::kWhenAtRest;
  } else if (const auto frame = parseInteger(word); frame && *frame >= 0) {
    detector.reference = SlipReference::kGiven;
    table.pass.referenceFrame = static_cast<std::size_t>(*frame);
  } else {
    throw std::invalid_argument("'" + shortened(word) +
                                "'; it is first, rest, or the number of a frame");
  }
}

void requireThere(const std::filesystem::path& file,
                  const Profile& profile,
                  const SlipRowsOptions& table) {
  requireMatrix(file, profile.layout(), table.matrix);
  if (table.pass.detector.reference == SlipReference::kGiven &&
      table.pass.referenceFrame >= profile.numFrames())
    throw Error(file.string() + ": has no frame " + std::to_string(table.pass.referenceFrame) +
                " to be the reference; it has " + std::to_string(profile.numFrames()));
}

}  // namespace palpate
