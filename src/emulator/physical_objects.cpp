#include "emulator/physical_objects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace palpate {
namespace {

using Eigen::Vector3d;

constexpr double kKpaPerNPerMm2 = 1000.0;
constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kMobilityMmPerNs = 2.0;  // how an object gives way [mm/s per N]
constexpr double kArmMm = 30.0;           // turns the same into rotation
constexpr double kMostMmPerS = 100.0;
constexpr double kMostRadPerS = 4.0;
constexpr double kSlideMmPerNs = 8.0;  // what friction doesn't hold slides so fast
constexpr double kTouchN = 0.05;       // less is no contact
constexpr double kPutDownS = 0.5;      // untouched for so long it stands again
constexpr double kQuietMmPerS = 0.05;
constexpr double kReachMm = 8.0;  // sensor surfaces are bent: slack of the quick check

Vector3d limited(const Vector3d& v, double most) {
  const double norm = v.norm();
  return norm > most ? Vector3d(v * (most / norm)) : v;
}

}  // namespace

PhysicalObjects::PhysicalObjects(const std::vector<SceneObject>& objects,
                                 const HandGeometry& geometry,
                                 double rubberNPerMm3)
    : geometry_(geometry),
      rubberNPerMm3_(rubberNPerMm3),
      contacts_(geometry.description().layout.numMatrices()) {
  for (const SceneObject& object : objects) {
    Body body;
    body.object = object;
    body.positionMm = object.positionMm;
    body.rotation = object.rotation;
    body.normalForceN = body.normalTorqueNmm = Vector3d::Zero();
    bodies_.push_back(std::move(body));
  }
}

void PhysicalObjects::press(const HandPose& pose, std::vector<double>& pressureKpa) {
  const SensorLayout& layout = geometry_.description().layout;
  pressureKpa.assign(layout.numPlaces(), 0.0);
  std::fill(contacts_.begin(), contacts_.end(), MatrixContact{});
  std::vector<double> strongest(layout.numMatrices(), 0.0);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    body.normalForceN = body.normalTorqueNmm = Vector3d::Zero();
    body.grip = body.gripArmNmm = 0.0;
    const double k = rubberNPerMm3_ * body.object.stiffnessNPerMm3 /
                     (rubberNPerMm3_ + body.object.stiffnessNPerMm3);
    const Eigen::Matrix3d toBody = body.rotation.transpose();
    for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
      const MatrixLayout& matrix = layout.matrix(m);
      const Vector3d middle = pose.positionMm(m, matrix.rows / 2, matrix.columns / 2);
      const double radius =
          std::hypot(matrix.rows * matrix.pitchMm, matrix.columns * matrix.pitchMm) / 2.0;
      if (body.object.shape.distanceMm(toBody * (middle - body.positionMm)) > radius + kReachMm)
        continue;
      const double area = matrix.taxelAreaMm2();
      double here = 0.0;
      std::size_t place = layout.offset(m);
      for (int y = 0; y < matrix.rows; ++y)
        for (int x = 0; x < matrix.columns; ++x, ++place) {
          if (!matrix.exists(y, x)) continue;
          const Vector3d& at = pose.positionsMm()[place];
          const double depth = -body.object.shape.distanceMm(toBody * (at - body.positionMm));
          if (depth <= 0.0) continue;
          const double forceN = k * depth * area;
          pressureKpa[place] += k * depth * kKpaPerNPerMm2;
          const Vector3d& normal = pose.normals()[place];
          const Vector3d onObject = normal * forceN;
          const Vector3d arm = at - body.positionMm;
          body.normalForceN += onObject;
          body.normalTorqueNmm += arm.cross(onObject);
          body.grip += forceN;
          body.gripArmNmm += forceN * arm.norm();
          MatrixContact& contact = contacts_[m];
          contact.forceN += forceN;
          contact.forceOnPadN -= onObject;
          contact.centreMm += at * forceN;
          contact.normal += onObject;
          contact.surfaceXMm += matrix.pitchMm * x * forceN;
          contact.surfaceYMm += matrix.pitchMm * y * forceN;
          here += forceN;
        }
      if (here > strongest[m]) {
        strongest[m] = here;
        contacts_[m].object = b;
      }
    }
  }
  for (MatrixContact& contact : contacts_) {
    if (contact.forceN <= 0.0) continue;
    contact.centreMm /= contact.forceN;
    contact.surfaceXMm /= contact.forceN;
    contact.surfaceYMm /= contact.forceN;
    contact.normal.normalize();
  }
}

void PhysicalObjects::advance(double dtS) {
  for (Body& body : bodies_) advanceBody(body, dtS);
}

void PhysicalObjects::advanceBody(Body& body, double dtS) {
  if (body.loadLeftS > 0.0) {
    const double share = std::min(dtS / body.loadLeftS, 1.0);
    body.loadN += (body.wantedN - body.loadN) * share;
    body.loadNmm += (body.wantedNmm - body.loadNmm) * share;
    body.loadLeftS -= dtS;
  }
  const Vector3d pull = body.loadN - Vector3d::UnitZ() * (body.object.massKg * kGravity);
  const double carries = body.object.friction * body.grip;
  body.untouchedS = body.grip < kTouchN ? body.untouchedS + dtS : 0.0;
  if (body.untouchedS > kPutDownS) body.held = false;
  if (carries > pull.norm()) body.held = true;

  // Friction of all contacts together holds against what drives the object; the rest moves it.
  const auto moves = [](const Vector3d& drive, double holds, double most, double mobility) {
    const double excess = drive.norm() - holds;
    return excess > 0.0 ? limited(drive.normalized() * (excess * mobility), most)
                        : Vector3d(Vector3d::Zero());
  };
  Vector3d velocity = moves(body.normalForceN + (body.held ? pull : Vector3d(Vector3d::Zero())),
                            carries,
                            kMostMmPerS,
                            kMobilityMmPerNs);
  Vector3d angular =
      moves(body.normalTorqueNmm + (body.held ? body.loadNmm : Vector3d(Vector3d::Zero())),
            body.object.friction * body.gripArmNmm,
            kMostRadPerS,
            kMobilityMmPerNs / (kArmMm * kArmMm));
  if (body.moved.leftS > 0.0) {
    velocity = body.moved.perS * std::min(1.0, body.moved.leftS / dtS);
    body.moved.leftS -= dtS;
  }
  if (body.turned.leftS > 0.0) {
    angular = body.turned.perS * std::min(1.0, body.turned.leftS / dtS);
    body.turned.leftS -= dtS;
  }
  body.motion = {velocity, angular};
  body.positionMm += velocity * dtS;
  if (const double angle = angular.norm() * dtS; angle > 0.0)
    body.rotation = (Eigen::AngleAxisd(angle, angular.normalized()) * body.rotation).eval();
}

bool PhysicalObjects::quiet() const noexcept {
  return std::all_of(bodies_.begin(), bodies_.end(), [](const Body& body) {
    return body.moved.leftS <= 0.0 && body.turned.leftS <= 0.0 && body.loadLeftS <= 0.0 &&
           body.motion.velocityMmPerS.norm() < kQuietMmPerS &&
           body.motion.angularRadPerS.norm() * kArmMm < kQuietMmPerS;
  });
}

void PhysicalObjects::move(const MoveObject& move) {
  bodies_.at(move.object).moved = {move.byMm / move.durationS, move.durationS};
}

void PhysicalObjects::turn(const TurnObject& turn) {
  bodies_.at(turn.object).turned = {turn.byDeg * (std::numbers::pi / 180.0) / turn.durationS,
                                    turn.durationS};
}

void PhysicalObjects::load(const LoadObject& load) {
  Body& body = bodies_.at(load.object);
  body.wantedN = load.forceN;
  body.wantedNmm = load.torqueNmm;
  body.loadLeftS = std::max(load.durationS, 1e-9);
}

}  // namespace palpate
