#include "palpate/emulator/default_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "palpate/emulator/assumed_characteristics.h"
#include "palpate/emulator/emulated_geometry.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

namespace palpate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSceneS = 3600.0;
constexpr double kSceneDegC = 34.0;   // of the emulated housing
constexpr double kPartOfScale = 0.5;  // of the full scale, under the deepest taxel
constexpr double kClearanceMm = 2.0;  // of an object that does not touch
constexpr double kCloseStep = 0.01;   // of the search for a sphere
constexpr double kGripClose = 0.6;    // where no common sphere fits
constexpr double kClosingS = 1.0;     // from open to closed at full velocity
constexpr double kObjectNPerMm3 = 10.0;
// Radius of a contact [pitches].
constexpr double kPadContactPitches = 2.5, kGraspContactPitches = 1.5;

// The middle of a matrix: the taxel that is nearest to the mean of all its taxels.
struct PadMiddle {
  Vector3d atMm, normal, right, down;
};

PadMiddle middleOf(const HandPose& pose, std::size_t m) {
  const MatrixLayout& layout = pose.description().layout.matrix(m);
  Vector3d mean = Vector3d::Zero();
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x)
      if (layout.exists(y, x)) mean += pose.positionMm(m, y, x);
  mean /= static_cast<double>(layout.numTaxels());
  PadMiddle middle;
  double leastMm = std::numeric_limits<double>::infinity();
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      if (!layout.exists(y, x)) continue;
      const double apartMm = (pose.positionMm(m, y, x) - mean).norm();
      if (apartMm >= leastMm) continue;
      leastMm = apartMm;
      middle.atMm = pose.positionMm(m, y, x);
      middle.normal = pose.normal(m, y, x);
    }
  const Vector3d right = pose.baseFromMatrix(m).linear().col(0);
  middle.right = (right - middle.normal * right.dot(middle.normal)).normalized();
  middle.down = middle.right.cross(middle.normal);
  return middle;
}

class DefaultSceneMaker {
 public:
  explicit DefaultSceneMaker(const HandDescription& hand)
      : hand_(hand), geometry_(emulatedGeometry(hand)), depthMm_(usualDepthMm(hand)) {
    scene_.name = "default";
    scene_.preshape = startPreshape(hand);
  }

  Scene make() {
    if (!scene_.preshape.empty() && findSpheres())
      addGrasps();
    else
      addPads();
    std::stable_sort(scene_.script.begin(),
                     scene_.script.end(),
                     [](const ScriptStep& a, const ScriptStep& b) { return a.atS < b.atS; });
    return std::move(scene_);
  }

 private:
  // Indentation at which a taxel reads kPartOfScale of the full scale, between 0.05 and 4 mm.
  static double usualDepthMm(const HandDescription& hand) {
    const SensorCharacteristics sensor = hand.file && hand.file->characteristics
                                             ? *hand.file->characteristics
                                             : assumedCharacteristics(hand);
    const double full = std::min(sensor.largestCounts, static_cast<double>(hand.maximumCounts));
    const double kpa =
        kPartOfScale * full / sensor.gainCountsPerKpa(kSceneDegC) + sensor.deadZoneKpa(kSceneDegC);
    const double rubber = PhysicalHandOptions().rubberNPerMm3;
    const double k = rubber * kObjectNPerMm3 / (rubber + kObjectNPerMm3);
    return std::isfinite(kpa) ? std::clamp(kpa * 1e-3 / k, 0.05, 4.0) : 0.5;
  }

  HandPose poseAt(double close) const {
    return geometry_.pose(scenePreshape(hand_, scene_.preshape).anglesDeg(close));
  }

  // Finds the matrices that the preshape moves, and where spheres touch them all at one posture.
  // Returns false when there are none.
  bool findSpheres() {
    const HandPose open = poseAt(0.0);
    const HandPose grip = poseAt(kGripClose);
    for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m)
      if ((middleOf(open, m).atMm - middleOf(grip, m).atMm).norm() > kClearanceMm)
        moved_.push_back(m);
    if (moved_.empty()) return false;
    gripClose_ = kGripClose;
    double best = std::numeric_limits<double>::infinity();
    if (moved_.size() > 1)
      for (double close = kCloseStep; close <= 1.0; close += kCloseStep) tryAt(close, best);
    if (!std::isfinite(best))
      for (const std::size_t m : moved_) {
        const PadMiddle middle = middleOf(grip, m);
        const double radiusMm = sphereRadiusMm(hand_.layout->matrix(m), kGraspContactPitches);
        addSphere(middle.atMm + middle.normal * (radiusMm - depthMm_), radiusMm);
        downs_.push_back(middle.down);
      }
    else
      useCommonSphere();
    return true;
  }

  void useCommonSphere() {
    addSphere(centreMm_, radiusMm_);
    // Along all matrices as far as possible.
    const HandPose pose = poseAt(gripClose_);
    Matrix3d normals = Matrix3d::Zero();
    for (const std::size_t m : moved_) {
      const Vector3d normal = middleOf(pose, m).normal;
      normals += normal * normal.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(normals);
    const Vector3d main = principal.eigenvectors().col(2);
    const Vector3d down = middleOf(pose, moved_.front()).down;
    const Vector3d along = down - main * down.dot(main);
    downs_.push_back(along.norm() > 1e-6 ? Vector3d(along.normalized()) : down);
  }

  void addSphere(const Vector3d& centreMm, double radiusMm) {
    SceneObject sphere;
    sphere.shape = {ShapeKind::kSphere, Vector3d::Constant(2.0 * radiusMm)};
    sphere.stiffnessNPerMm3 = kObjectNPerMm3;
    sphere.fixed = true;
    sphere.positionMm = centreMm;
    scene_.objects.push_back(sphere);
  }

  // Radius of the sphere whose contact at the usual depth has a radius of so many pitches, or
  // reaches over half of the matrix.
  double sphereRadiusMm(const MatrixLayout& layout, double pitches) const {
    const double contactMm = std::min(std::min(pitches, layout.rows / 2.0) * layout.pitchMm.y,
                                      std::min(pitches, layout.columns / 2.0) * layout.pitchMm.x);
    const double leastMm = 2.0 * std::max(layout.pitchMm.x, layout.pitchMm.y);
    return std::clamp(contactMm * contactMm / (2.0 * depthMm_), leastMm, std::max(leastMm, 150.0));
  }

  // Fits one sphere to the middles of all moved matrices at a posture; keeps it if it touches them
  // there, within half a pitch, and is the best one so far.
  void tryAt(double close, double& best) {
    const HandPose pose = poseAt(close);
    constexpr double kTies = 1e-3;  // between parallel normals the mean of the middles decides
    Matrix3d normal = kTies * Matrix3d::Identity();
    Vector3d right = Vector3d::Zero();
    std::vector<PadMiddle> middles;
    double padMm = 0.0, pitchMm = std::numeric_limits<double>::infinity();
    const auto count = static_cast<double>(moved_.size());
    for (const std::size_t m : moved_) {
      middles.push_back(middleOf(pose, m));
      const PadMiddle& middle = middles.back();
      const MatrixLayout& layout = hand_.layout->matrix(m);
      padMm += layout.pitchMm.lengthMm(layout.columns, layout.rows) / 2.0 / count;
      pitchMm = std::min({pitchMm, layout.pitchMm.x, layout.pitchMm.y});
      const Matrix3d across = Matrix3d::Identity() - middle.normal * middle.normal.transpose();
      normal += across;
      right += across * middle.atMm + kTies / count * middle.atMm;
    }
    const Vector3d centre = normal.ldlt().solve(right);
    double radius = 0.0;
    for (const PadMiddle& middle : middles)
      radius += (centre - middle.atMm).dot(middle.normal) / count;
    radius += depthMm_;
    double worstMm = 0.0;
    for (const PadMiddle& middle : middles)
      worstMm =
          std::max(worstMm, (centre - middle.atMm - (radius - depthMm_) * middle.normal).norm());
    // Among the spheres one of about one and a half times the size of the pads.
    const double cost = std::abs(std::log(radius / (1.5 * padMm)));
    if (radius < 0.25 * padMm || worstMm > 0.5 * pitchMm || cost >= best) return;
    best = cost;
    centreMm_ = centre;
    radiusMm_ = radius;
    gripClose_ = close;
  }

  void addGrasps() {
    scene_.description = "The hand closes on spheres, which are pulled over the matrices and back";
    double travel = 0.0, velocity = std::numeric_limits<double>::infinity(), pitchMm = 0.0;
    for (const PreshapeJoint& joint : scenePreshape(hand_, scene_.preshape).joints)
      travel = std::max(travel, std::abs(joint.slopeDeg));
    for (const AxisDescription& axis : hand_.axes)
      if (axis.maximumVelocityDegPerS > 0.0)
        velocity = std::min(velocity, axis.maximumVelocityDegPerS);
    velocity = std::min(velocity, travel / kClosingS);
    for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m)
      pitchMm = std::max(pitchMm, hand_.layout->matrix(m).pitchMm.y);
    for (double s = 0.0; s + kGraspCycleS <= kSceneS; s += kGraspCycleS) {
      add(s + 1.0, GraspAction{std::nullopt, gripClose_, velocity});
      for (std::size_t object = 0; object < downs_.size(); ++object) {
        const Vector3d pull = 2.0 * pitchMm * downs_[object];
        add(s + 5.0, MoveObject{object, pull, 2.0});
        add(s + 7.5, MoveObject{object, -pull, 2.0});
      }
      add(s + 10.0, ReleaseAction{velocity});
    }
  }

  void addPads() {
    scene_.description = "A sphere presses on each matrix in turn, slides and rolls";
    const std::size_t count = hand_.layout->numMatrices();
    const HandPose pose = geometry_.pose(restAngles());
    for (std::size_t m = 0; m < count; ++m) {
      const MatrixLayout& layout = hand_.layout->matrix(m);
      const PadMiddle middle = middleOf(pose, m);
      const double radius = sphereRadiusMm(layout, kPadContactPitches);
      addSphere(middle.atMm + middle.normal * (radius + kClearanceMm), radius);
      const Vector3d press = -middle.normal * (kClearanceMm + depthMm_);
      const double slideMm = 0.2 * layout.columns * layout.pitchMm.x;
      const Vector3d slide = middle.right * slideMm;
      // Rolling over a plane with the normal n: angular velocity = n x v / radius.
      const Vector3d roll = middle.normal.cross(-slide) / radius * (180.0 / std::numbers::pi);
      const double cycleS = kPadCycleS * static_cast<double>(count);
      for (double s = kPadCycleS * static_cast<double>(m); s + cycleS <= kSceneS; s += cycleS) {
        add(s + 0.5, MoveObject{m, press, 0.5});
        add(s + 2.0, MoveObject{m, slide, 2.0});
        add(s + 4.5, MoveObject{m, -slide, 2.0});
        add(s + 4.5, TurnObject{m, roll, 2.0});
        add(s + 7.0, MoveObject{m, -press, 0.5});
      }
    }
  }

  void add(double atS, const SceneAction& action) {
    ScriptStep& step = scene_.script.emplace_back();
    step.atS = atS;
    step.action = action;
  }

  std::vector<double> restAngles() const {
    if (!scene_.preshape.empty())
      return scenePreshape(hand_, scene_.preshape).anglesDeg(scene_.close);
    std::vector<double> angles;
    for (const AxisDescription& axis : hand_.axes)
      angles.push_back(std::clamp(0.0, axis.minimumDeg, axis.maximumDeg));
    return angles;
  }

  const HandDescription& hand_;
  const HandGeometry geometry_;
  const double depthMm_;
  Vector3d centreMm_ = Vector3d::Zero();
  double radiusMm_ = 0.0;
  double gripClose_ = 1.0;
  std::vector<std::size_t> moved_;  // matrices that the preshape moves
  std::vector<Vector3d> downs_;     // per object: the direction in which it is pulled
  Scene scene_;
};

}  // namespace

Scene defaultScene(const HandDescription& hand) { return DefaultSceneMaker(hand).make(); }

}  // namespace palpate
