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
constexpr double kGripStep = 0.002;   // of the search for the grip
constexpr double kClosingS = 1.0;     // from open to closed at full velocity
constexpr double kObjectNPerMm3 = 10.0;

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
    if (!scene_.preshape.empty() && findSphere())
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

  // Finds the sphere that the hand can grasp, and how far it closes on it.
  bool findSphere() {
    std::vector<std::size_t> moved;
    for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m)
      if (geometry_.description().surfaces[m].place.link) moved.push_back(m);
    if (moved.size() < 2) return false;
    double best = std::numeric_limits<double>::infinity();
    for (double close = 0.0; close <= 1.0; close += kCloseStep) tryAt(close, moved, best);
    if (!std::isfinite(best)) return false;
    const Shape sphere{ShapeKind::kSphere, Vector3d::Constant(2.0 * radiusMm_)};
    if (deepestMm(poseAt(0.0), moved, sphere) > 0.0) return false;  // it would touch the open hand
    for (gripClose_ = 0.0; gripClose_ < 1.0; gripClose_ = std::min(gripClose_ + kGripStep, 1.0))
      if (deepestMm(poseAt(gripClose_), moved, sphere) >= depthMm_) break;
    along_ = directionAlong(poseAt(gripClose_), moved);
    return true;
  }

  // Fits a sphere to the matrices at one posture; keeps it if it is the best one.
  void tryAt(double close, const std::vector<std::size_t>& moved, double& best) {
    const HandPose pose = poseAt(close);
    constexpr double kTies = 1e-3;  // between parallel normals the mean of the middles decides
    Matrix3d normal = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero(), mean = Vector3d::Zero();
    std::vector<PadMiddle> middles;
    double padMm = 0.0;
    for (const std::size_t m : moved) {
      middles.push_back(middleOf(pose, m));
      const MatrixLayout& layout = hand_.layout->matrix(m);
      padMm += std::hypot(layout.rows, layout.columns) * layout.pitchMm / 2.0;
      mean += middles.back().atMm;
    }
    const auto count = static_cast<double>(moved.size());
    mean /= count;
    padMm /= count;
    for (const PadMiddle& middle : middles) {
      const Matrix3d across = Matrix3d::Identity() - middle.normal * middle.normal.transpose();
      normal += across;
      right += across * middle.atMm;
    }
    normal += kTies * Matrix3d::Identity();
    right += kTies * mean;
    const Vector3d centre = normal.ldlt().solve(right);
    double radius = 0.0, leastMm = std::numeric_limits<double>::infinity();
    for (const PadMiddle& middle : middles) {
      const double apartMm = (centre - middle.atMm).dot(middle.normal);
      radius += apartMm / count;
      leastMm = std::min(leastMm, apartMm);
    }
    // No object behind a pad, and none that a pad of this size could not hold.
    if (leastMm < 0.25 * padMm || radius > 6.0 * padMm) return;
    double squares = 0.0;
    for (const PadMiddle& middle : middles)
      squares += (centre - middle.atMm - radius * middle.normal).squaredNorm() / count;
    // Among spheres that fit equally well, one of one and a half times the size of the pads.
    constexpr double kSizeWeight = 0.05;
    const double cost =
        std::sqrt(squares) / radius + kSizeWeight * std::abs(std::log(radius / (1.5 * padMm)));
    if (cost >= best) return;
    best = cost;
    centreMm_ = centre;
    radiusMm_ = radius;
  }

  double deepestMm(const HandPose& pose,
                   const std::vector<std::size_t>& moved,
                   const Shape& shape) const {
    double deepest = -std::numeric_limits<double>::infinity();
    for (const std::size_t m : moved) {
      const MatrixLayout& layout = hand_.layout->matrix(m);
      for (int y = 0; y < layout.rows; ++y)
        for (int x = 0; x < layout.columns; ++x)
          if (layout.exists(y, x))
            deepest = std::max(deepest, -shape.distanceMm(pose.positionMm(m, y, x) - centreMm_));
    }
    return deepest;
  }

  // Along all matrices as far as possible, towards rising rows of the first one.
  static Vector3d directionAlong(const HandPose& pose, const std::vector<std::size_t>& moved) {
    Matrix3d normals = Matrix3d::Zero();
    for (const std::size_t m : moved) {
      const Vector3d normal = middleOf(pose, m).normal;
      normals += normal * normal.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(normals);
    const Vector3d main = principal.eigenvectors().col(2);
    const Vector3d down = middleOf(pose, moved.front()).down;
    const Vector3d along = down - main * down.dot(main);
    return along.norm() > 1e-6 ? Vector3d(along.normalized()) : down;
  }

  void addGrasps() {
    scene_.description = "The hand closes on a sphere, which is pulled over the matrices and back";
    SceneObject sphere;
    sphere.shape = {ShapeKind::kSphere, Vector3d::Constant(2.0 * radiusMm_)};
    sphere.stiffnessNPerMm3 = kObjectNPerMm3;
    sphere.fixed = true;
    sphere.positionMm = centreMm_;
    scene_.objects.push_back(sphere);
    double travel = 0.0, velocity = std::numeric_limits<double>::infinity(), pitchMm = 0.0;
    for (const PreshapeJoint& joint : scenePreshape(hand_, scene_.preshape).joints)
      travel = std::max(travel, std::abs(joint.slopeDeg));
    for (const AxisDescription& axis : hand_.axes)
      if (axis.maximumVelocityDegPerS > 0.0)
        velocity = std::min(velocity, axis.maximumVelocityDegPerS);
    velocity = std::min(velocity, travel / kClosingS);
    for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m)
      pitchMm = std::max(pitchMm, hand_.layout->matrix(m).pitchMm);
    const Vector3d pull = 2.0 * pitchMm * along_;
    for (double s = 0.0; s + kGraspCycleS <= kSceneS; s += kGraspCycleS) {
      scene_.script.push_back({s + 1.0, GraspAction{std::nullopt, gripClose_, velocity}});
      scene_.script.push_back({s + 5.0, MoveObject{0, pull, 2.0}});
      scene_.script.push_back({s + 7.5, MoveObject{0, -pull, 2.0}});
      scene_.script.push_back({s + 10.0, ReleaseAction{velocity}});
    }
  }

  void addPads() {
    scene_.description = "A sphere presses on each matrix in turn, slides and rolls";
    const std::size_t count = hand_.layout->numMatrices();
    const HandPose pose = geometry_.pose(restAngles());
    for (std::size_t m = 0; m < count; ++m) {
      const MatrixLayout& layout = hand_.layout->matrix(m);
      const PadMiddle middle = middleOf(pose, m);
      // The contact is five pitches wide.
      const double contactMm = 2.5 * layout.pitchMm;
      const double radius =
          std::clamp(contactMm * contactMm / (2.0 * depthMm_), 2.0 * layout.pitchMm, 150.0);
      SceneObject sphere;
      sphere.shape = {ShapeKind::kSphere, Vector3d::Constant(2.0 * radius)};
      sphere.stiffnessNPerMm3 = kObjectNPerMm3;
      sphere.fixed = true;
      sphere.positionMm = middle.atMm + middle.normal * (radius + kClearanceMm);
      scene_.objects.push_back(sphere);
      const Vector3d press = -middle.normal * (kClearanceMm + depthMm_);
      const double slideMm = 0.2 * layout.columns * layout.pitchMm;
      const Vector3d slide = middle.right * slideMm;
      // Rolling over a plane with the normal n: angular velocity = n x v / radius.
      const Vector3d roll = middle.normal.cross(-slide) / radius * (180.0 / std::numbers::pi);
      const double cycleS = kPadCycleS * static_cast<double>(count);
      for (double s = kPadCycleS * static_cast<double>(m); s + cycleS <= kSceneS; s += cycleS) {
        scene_.script.push_back({s + 0.5, MoveObject{m, press, 0.5}});
        scene_.script.push_back({s + 2.0, MoveObject{m, slide, 2.0}});
        scene_.script.push_back({s + 4.5, MoveObject{m, -slide, 2.0}});
        scene_.script.push_back({s + 4.5, TurnObject{m, roll, 2.0}});
        scene_.script.push_back({s + 7.0, MoveObject{m, -press, 0.5}});
      }
    }
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
  Vector3d along_ = Vector3d::UnitZ();
  Scene scene_;
};

}  // namespace

Scene defaultScene(const HandDescription& hand) { return DefaultSceneMaker(hand).make(); }

}  // namespace palpate
