#include "palpate/kinematics/contact_rows.h"

#include <algorithm>
#include <utility>

#include "palpate/core/time.h"
#include "palpate/model/matrix_rows.h"

namespace palpate {
namespace {

// Columns NAMEx, NAMEy, NAMEz of a vector that `of` returns where it is known.
template <typename Row, typename Of>
void appendVector(std::vector<ColumnOf<Row>>& columns,
                  const std::string& name,
                  const std::string& ending,
                  const std::string& unit,
                  const std::string& meaning,
                  Of of) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    columns.push_back(
        columnOf<Row>(name + kAxes[axis] + ending, unit, meaning, [of, axis](const Row& row) {
          const std::optional<Eigen::Vector3d> vector = of(row);
          return vector ? std::optional((*vector)[axis]) : std::nullopt;
        }));
}

// Columns NAME_x_mm, NAME_y_mm, NAME_z_mm and NAME_radius_mm.
void appendSphere(std::vector<ColumnOf<FrameContact>>& columns,
                  const std::string& name,
                  const std::string& meaning,
                  std::optional<Sphere> FrameContact::*of) {
  appendVector(columns, name + "_", "_mm", "mm", meaning, [of](const FrameContact& row) {
    return row.*of ? std::optional((row.*of)->centreMm) : std::nullopt;
  });
  columns.push_back(columnOf<FrameContact>(
      name + "_radius_mm", "mm", "its radius", [of](const FrameContact& row) {
        return row.*of ? std::optional((row.*of)->radiusMm) : std::nullopt;
      }));
}

// The rows of a run, and what went wrong in it.
class Counted {
 public:
  Counted(const Profile& profile,
          const GeometryDescription& geometry,
          const ContactRowsOptions& options,
          Progress progress)
      : run_(profile, geometry, options),
        options_(options),
        progress_(std::move(progress)),
        numFrames_(profile.numFrames()) {}

  bool next() {
    if (!run_.next()) return false;
    reportProgress(progress_, run_.frame(), numFrames_);
    ++frames_;
    const AnglesCheck& angles = run_.angles();
    if (angles.state == AngleValidity::kOutOfRange && outOfRange_++ == 0)
      firstOutOfRange_ = angles.problem;
    if (angles.state == AngleValidity::kUnusable && unusable_++ == 0)
      firstUnusable_ = angles.problem;
    if (run_.contact().numNotFinite > 0) ++notFinite_;
    return true;
  }
  std::optional<double> forceN() {
    if (!options_.forceOf) return std::nullopt;
    const ForceReading force = options_.forceOf(run_.values());
    if (!force.forceN) ++(force.isTooLight ? tooLight_ : noForce_);
    return force.forceN;
  }
  const ContactRun& run() const { return run_; }

  std::vector<std::string> notes() const {
    std::vector<std::string> lines;
    add(lines, outOfRange_, "have joint angles that the hand can't take: " + firstOutOfRange_);
    add(lines,
        tooLight_,
        "have no force_n: a contact is lighter than all that the calibration measured");
    return lines;
  }
  std::vector<std::string> problems() const {
    std::vector<std::string> lines;
    add(lines, notFinite_, "have values that are not numbers; these were left out");
    add(lines, noForce_, "have no force_n: " + options_.noForceText);
    add(lines,
        unusable_,
        "have no usable joint angles, and no sphere: " + firstUnusable_ +
            "; give some with --angles");
    return lines;
  }

 private:
  void add(std::vector<std::string>& lines, std::size_t frames, const std::string& what) const {
    if (frames > 0)
      lines.push_back(std::to_string(frames) + " of " + std::to_string(frames_) + " frames " +
                      what);
  }

  ContactRun run_;
  const ContactRowsOptions options_;
  const Progress progress_;
  const std::size_t numFrames_;
  std::size_t frames_ = 0, outOfRange_ = 0, unusable_ = 0, notFinite_ = 0, noForce_ = 0,
              tooLight_ = 0;
  std::string firstOutOfRange_, firstUnusable_;
};

template <typename Row>
class ContactTable final : public RowTable<Row> {
 public:
  ContactTable(std::string name,
               std::vector<ColumnOf<Row>> columns,
               std::shared_ptr<Counted> counted,
               void (*add)(Counted&, std::vector<Row>&))
      : RowTable<Row>(std::move(name),
                      std::move(columns),
                      [counted, add](std::vector<Row>& rows) {
                        if (!counted->next()) return false;
                        add(*counted, rows);
                        return true;
                      }),
        counted_(counted) {}
  std::vector<std::string> notes() const override { return counted_->notes(); }
  std::vector<std::string> problems() const override { return counted_->problems(); }

 private:
  std::shared_ptr<Counted> counted_;
};

using MatrixContactRow = MatrixRow<PlacedContact>;

void addFrame(Counted& counted, std::vector<FrameContact>& rows) {
  rows.push_back(contactOfFrame(counted.run()));
  rows.back().forceN = counted.forceN();
}

void addMatrices(Counted& counted, std::vector<MatrixContactRow>& rows) {
  const ContactRun& run = counted.run();
  const std::vector<MatrixContact>& matrices = run.contact().matrices;
  for (std::size_t m = 0; m < matrices.size(); ++m)
    rows.push_back({run.frame(), run.values().hostUs, m, {matrices[m], run.isPosed()}});
}

}  // namespace

ContactRun::ContactRun(Profile profile,
                       GeometryDescription geometry,
                       const ContactRowsOptions& options)
    : profile_(std::move(profile)),
      geometry_(std::move(geometry)),
      options_(options),
      next_(options.first),
      pose_(geometry_.pose(
          options.anglesDeg.value_or(std::vector<double>(geometry_.description().numAxes, 0.0)))) {
  if (!options_.anglesDeg && profile_.numAngles() == 0)
    angles_ = checkAngles({}, profile_.hand().axes);  // usable if the hand has no joints
}

// The pose is kept, because joint angles change less often than frames; where those of a frame are
// unusable, it stays as it was.
void ContactRun::takePose() {
  if (options_.anglesDeg) return;
  const auto sample = profile_.angleSampleAt(values_.hostUs);
  if (sample == sample_) return;
  sample_ = sample;
  const std::vector<double> anglesDeg = profile_.angles(sample.value()).values;
  angles_ = checkAngles(anglesDeg, profile_.hand().axes);
  if (isPosed()) geometry_.pose(anglesDeg, pose_);
}

bool ContactRun::next() {
  if (next_ >= profile_.numFrames() || next_ > options_.last) return false;
  profile_.readFrame(next_++, values_);
  takePose();
  contactOf(values_, pose_, options_.contact, contact_);
  return true;
}

FrameContact contactOfFrame(const ContactRun& run) {
  const HandContact& contact = run.contact();
  FrameContact row{
      .frame = run.frame(), .timeUs = run.values().hostUs, .active = contact.numActive};
  if (!run.isPosed()) return row;
  row.sphere = contact.taxelSphere;
  row.centroidSphere = contact.centroidSphere;
  return row;
}

std::vector<ColumnOf<FrameContact>> frameContactColumns(bool withCentroids) {
  using Row = FrameContact;
  std::vector<ColumnOf<Row>> columns = {
      columnOf<Row>("frame", "", "number of the frame, from 0", &Row::frame),
      columnOf<Row>("time_ms",
                    "ms",
                    "host time, since 1970",
                    [](const Row& row) { return row.timeUs / kUsPerMs; }),
      columnOf<Row>("active", "taxels", "touched taxels of all matrices", &Row::active)};
  appendSphere(columns,
               "sphere",
               "centre of the smallest sphere around the touched taxels, in the hand's base frame",
               &Row::sphere);
  if (withCentroids)
    appendSphere(columns,
                 "centroid_sphere",
                 "centre of the smallest sphere around the centroids of the matrices, in the "
                 "hand's base frame",
                 &Row::centroidSphere);
  columns.push_back(
      columnOf<Row>("force_n", "N", "force of the hand, with a calibration", &Row::forceN));
  return columns;
}

std::vector<ColumnOf<PlacedContact>> matrixContactColumns(const std::string& unit) {
  using Row = PlacedContact;
  const auto inSpace = [](Eigen::Vector3d MatrixContact::*of) {
    return [of](const Row& row) {
      return row.isPosed && row.contact.numActive > 0 ? std::optional(row.contact.*of)
                                                      : std::nullopt;
    };
  };
  const auto where = [](bool needsPose, double MatrixContact::*of) {
    return [needsPose, of](const Row& row) {
      return knownIf(row.contact.numActive > 0 && (row.isPosed || !needsPose), row.contact.*of);
    };
  };
  std::vector<ColumnOf<Row>> columns = {
      columnOf<Row>("active",
                    "taxels",
                    "touched taxels",
                    [](const Row& row) { return row.contact.numActive; }),
      columnOf<Row>(
          "sum", unit, "sum of their values", [](const Row& row) { return row.contact.sum; }),
      columnOf<Row>(
          "area_mm2", "mm^2", "their area", [](const Row& row) { return row.contact.areaMm2; })};
  appendVector(columns,
               "centroid_",
               "_mm",
               "mm",
               "centre of pressure, in the hand's base frame",
               inSpace(&MatrixContact::centroidMm));
  appendVector(
      columns, "n", "", "", "mean normal, a unit vector", inSpace(&MatrixContact::meanNormal));
  appendVector(columns,
               "major_",
               "",
               "",
               "direction in which the contact is longest",
               inSpace(&MatrixContact::majorAxis));
  columns.push_back(columnOf<Row>(
      "major_sd_mm", "mm", "standard deviation along it", where(true, &MatrixContact::majorSdMm)));
  appendVector(columns,
               "minor_",
               "",
               "",
               "direction at a right angle to the major one",
               inSpace(&MatrixContact::minorAxis));
  columns.push_back(columnOf<Row>(
      "minor_sd_mm", "mm", "standard deviation along it", where(true, &MatrixContact::minorSdMm)));
  for (const auto& [name, of] : {std::pair("surface_x_mm", &MatrixContact::xMm),
                                 std::pair("surface_y_mm", &MatrixContact::yMm)})
    columns.push_back(
        columnOf<Row>(name,
                      "mm",
                      "centre of pressure on the unrolled surface, from the first taxel",
                      where(false, of)));
  return columns;
}

std::unique_ptr<ResultTable> contactTable(const Profile& profile,
                                          const GeometryDescription& geometry,
                                          const ContactRowsOptions& options,
                                          const Progress& progress) {
  const auto counted = std::make_shared<Counted>(profile, geometry, options, progress);
  if (options.matrices)
    return std::make_unique<ContactTable<MatrixContactRow>>(
        "contact_matrices",
        matrixRowColumns(matrixContactColumns(profile.hand().unit)),
        counted,
        &addMatrices);
  return std::make_unique<ContactTable<FrameContact>>(
      "contact", frameContactColumns(), counted, &addFrame);
}

}  // namespace palpate
