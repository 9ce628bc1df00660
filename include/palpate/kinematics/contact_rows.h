// Where a hand touches in space as result tables: one row for each frame, or one for each frame and
// matrix. docs/manual/columns.md explains the columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/kinematics/contact_geometry.h>
#include <palpate/kinematics/geometry_description.h>
#include <palpate/kinematics/hand_geometry.h>
#include <palpate/kinematics/joint_range.h>
#include <palpate/model/profile.h>

namespace palpate {

// The force of the hand in a frame.
struct ForceReading {
  std::optional<double> forceN;  // empty: not known
  bool isTooLight = false;       // only because contacts are lighter than the calibration's
};

struct ContactRowsOptions {
  // Used instead of recorded joint angles [deg, sliding: mm].
  std::optional<std::vector<double>> anglesDeg = {};
  ContactOptions contact = {};
  bool matrices = false;                   // a row per matrix instead of one per frame
  std::size_t first = 0, last = SIZE_MAX;  // frames, both inclusive
  std::function<ForceReading(const TactileFrame&)> forceOf = {};  // fills force_n of frames
  std::string noForceText = {};  // why it may be unknown, for problems()
};

// Computes the contacts of the frames of a profile, one after the other.
class ContactRun {
 public:
  ContactRun(Profile profile, GeometryDescription geometry, const ContactRowsOptions& options);
  // Takes the next frame; false after the last one. Throws FileError.
  bool next();
  std::size_t frame() const noexcept { return next_ - 1; }
  const TactileFrame& values() const noexcept { return values_; }
  const HandContact& contact() const noexcept { return contact_; }
  // Whether the joint angles are usable; otherwise places in space mean nothing.
  bool isPosed() const noexcept { return angles_.state != AngleValidity::kUnusable; }
  const AnglesCheck& angles() const noexcept { return angles_; }

 private:
  void takePose();

  Profile profile_;
  const HandGeometry geometry_;
  const ContactRowsOptions options_;
  std::size_t next_;
  HandPose pose_;
  std::optional<std::size_t> sample_;
  AnglesCheck angles_;
  TactileFrame values_;
  HandContact contact_;
};

// What a frame says of the whole hand; spheres only where the joint angles are usable.
struct FrameContact {
  std::size_t frame = 0;
  std::int64_t timeUs = 0;  // host time [us since 1970]
  std::size_t active = 0;
  std::optional<Sphere> sphere = {}, centroidSphere = {};
  std::optional<double> forceN = {};  // left empty by contactOfFrame()
};
FrameContact contactOfFrame(const ContactRun& run);
// `withCentroids`: also the sphere around the centroids of the matrices.
std::vector<ColumnOf<FrameContact>> frameContactColumns(bool withCentroids = false);

// One matrix in a frame, and whether it is placed in space.
struct PlacedContact {
  MatrixContact contact;
  bool isPosed = false;
};
std::vector<ColumnOf<PlacedContact>> matrixContactColumns(const std::string& unit);

// The table "contact", or "contact_matrices". Its notes and problems say which frames have no pose,
// values or forces.
std::unique_ptr<ResultTable> contactTable(const Profile& profile,
                                          const GeometryDescription& geometry,
                                          const ContactRowsOptions& options = {},
                                          const Progress& progress = {});

}  // namespace palpate
