#include "emulator/physical_objects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "emulator/pad_contact.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

constexpr double kKpaPerNPerMm2 = 1000.0;
constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kMobilityMmPerNs = 2.0;  // velocity of an object per force [mm/s per N]
constexpr double kArmMm = 30.0;           // lever that converts it into rotation
constexpr double kMaxMmPerS = 100.0;
constexpr double kMaxRadPerS = 4.0;
constexpr double kMinHoldN = 1e-6;  // minimum of the friction limit, along a normal
constexpr double kTouchN = 0.05;    // a smaller force is no contact
constexpr double kPutDownS = 0.5;   // an object untouched for this time returns to its pose
constexpr double kQuietMmPerS = 0.05;
// Margin of the quick check, because sensor surfaces are curved.
constexpr double kPhysicalObjectsReachMm = 8.0;

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
      contacts_(geometry.description().layout.numMatrices()),
      strongestN_(contacts_.size()) {
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
  pressureKpa.assign(geometry_.description().layout.numCells(), 0.0);
  std::fill(contacts_.begin(), contacts_.end(), SimulatedMatrixContact{});
  std::fill(strongestN_.begin(), strongestN_.end(), 0.0);
  for (std::size_t b = 0; b < bodies_.size(); ++b) pressBody(b, pose, pressureKpa);
  pressPads(pose, pressureKpa);
  for (SimulatedMatrixContact& contact : contacts_) {
    if (contact.forceN <= 0.0) continue;
    contact.centreMm /= contact.forceN;
    contact.surfaceXMm /= contact.forceN;
    contact.surfaceYMm /= contact.forceN;
    contact.normal.normalize();
  }
}

void PhysicalObjects::pressPads(const HandPose& pose, std::vector<double>& pressureKpa) {
  const SensorLayout& layout = geometry_.description().layout;
  const double k = rubberNPerMm3_ / 2.0;  // two foundations in series
  findPadContacts(pose, [&](std::size_t m, int y, int x, double depthMm) {
    const MatrixLayout& matrix = layout.matrix(m);
    const std::size_t place = layout.offset(m) + static_cast<std::size_t>(y * matrix.columns + x);
    const double forceN = k * depthMm * matrix.taxelAreaMm2();
    const Vector3d outwardN = pose.normals()[place] * forceN;
    pressureKpa[place] += k * depthMm * kKpaPerNPerMm2;
    SimulatedMatrixContact& contact = contacts_[m];
    contact.forceN += forceN;
    contact.forceOnPadN -= outwardN;
    contact.centreMm += pose.positionsMm()[place] * forceN;
    contact.normal += outwardN;
    contact.surfaceXMm += matrix.pitchMm.x * x * forceN;
    contact.surfaceYMm += matrix.pitchMm.y * y * forceN;
  });
}

void PhysicalObjects::pressBody(std::size_t index,
                                const HandPose& pose,
                                std::vector<double>& pressureKpa) {
  const SensorLayout& layout = geometry_.description().layout;
  Body& body = bodies_[index];
  body.touches.clear();
  body.normalForceN = body.normalTorqueNmm = Vector3d::Zero();
  body.grip = body.stiffnessNPerMm = body.turnStiffnessNmm = 0.0;
  // The rubber and the object's surface are two springs in series.
  const double k = rubberNPerMm3_ * body.object.stiffnessNPerMm3 /
                   (rubberNPerMm3_ + body.object.stiffnessNPerMm3);
  const Eigen::Matrix3d toBody = body.rotation.transpose();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    const Vector3d middle = pose.positionMm(m, matrix.rows / 2, matrix.columns / 2);
    const double radius =
        std::hypot(matrix.rows * matrix.pitchMm.y, matrix.columns * matrix.pitchMm.x) / 2.0;
    if (body.object.shape.distanceMm(toBody * (middle - body.positionMm)) >
        radius + kPhysicalObjectsReachMm)
      continue;
    const double area = matrix.taxelAreaMm2();
    SimulatedMatrixContact& contact = contacts_[m];
    Touch touch;
    double armSquares = 0.0;
    std::size_t place = layout.offset(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x, ++place) {
        if (!matrix.exists(y, x)) continue;
        const Vector3d& at = pose.positionsMm()[place];
        const Vector3d arm = at - body.positionMm;
        const double depth = -body.object.shape.distanceMm(toBody * arm);
        if (depth <= 0.0) continue;
        const double forceN = k * depth * area;
        pressureKpa[place] += k * depth * kKpaPerNPerMm2;
        const Vector3d onObject = pose.normals()[place] * forceN;
        body.normalForceN += onObject;
        body.normalTorqueNmm += arm.cross(onObject);
        body.stiffnessNPerMm += k * area;
        body.turnStiffnessNmm += k * area * arm.squaredNorm();
        touch.forceN += forceN;
        touch.normal += onObject;
        touch.armMm += arm * forceN;
        armSquares += arm.squaredNorm() * forceN;
        contact.forceN += forceN;
        contact.forceOnPadN -= onObject;
        contact.centreMm += at * forceN;
        contact.normal += onObject;
        contact.surfaceXMm += matrix.pitchMm.x * x * forceN;
        contact.surfaceYMm += matrix.pitchMm.y * y * forceN;
      }
    if (touch.forceN <= 0.0) continue;
    body.grip += touch.forceN;
    touch.normal.normalize();
    touch.armMm /= touch.forceN;
    touch.contactRadiusMm =
        std::sqrt(std::max(armSquares / touch.forceN - touch.armMm.squaredNorm(), 0.0));
    body.touches.push_back(touch);
    if (touch.forceN > strongestN_[m]) {
      strongestN_[m] = touch.forceN;
      contact.object = index;
    }
  }
}

Vector3d PhysicalObjects::pullN(const Body& body) {
  return body.loadN - Vector3d::UnitZ() * (body.object.massKg * kGravity);
}

double PhysicalObjects::frictionLimitN(const Body& body, const Vector3d& direction) {
  double sum = 0.0;
  for (const Touch& touch : body.touches)
    sum += touch.forceN * touch.normal.cross(direction).norm();
  return body.object.friction * sum;
}

Vector3d PhysicalObjects::netForceN(const Body& body, const Vector3d& forceN) {
  if (body.touches.empty()) return forceN;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const Touch& touch : body.touches)
    normals += touch.forceN * touch.normal * touch.normal.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal;
  principal.computeDirect(normals);
  double used = 0.0;  // fraction of the limit, squared
  for (int i = 0; i < 3; ++i) {
    const Vector3d axis = principal.eigenvectors().col(i);
    const double share = forceN.dot(axis) / std::max(frictionLimitN(body, axis), kMinHoldN);
    used += share * share;
  }
  return used <= 1.0 ? Vector3d(Vector3d::Zero())
                     : Vector3d(forceN * (1.0 - 1.0 / std::sqrt(used)));
}

double PhysicalObjects::frictionLimitNmm(const Body& body, const Vector3d& axis) {
  double sum = 0.0;
  for (const Touch& touch : body.touches)
    sum += touch.forceN * (touch.normal.cross(axis.cross(touch.armMm)).norm() +
                           touch.contactRadiusMm * std::abs(touch.normal.dot(axis)));
  return body.object.friction * sum;
}

Vector3d PhysicalObjects::heldShare(std::size_t object) const {
  const Body& body = bodies_.at(object);
  if (!body.held || body.grip < kTouchN) return Vector3d::Zero();
  return pullN(body) / body.grip;
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
  const Vector3d pull = pullN(body);
  body.untouchedS = body.grip < kTouchN ? body.untouchedS + dtS : 0.0;
  if (body.untouchedS > kPutDownS) body.held = false;
  if (body.grip >= kTouchN && frictionLimitN(body, pull.normalized()) >= pull.norm())
    body.held = true;

  // The force beyond the friction moves the object, limited by viscosity, and never past the
  // position where the springs of the contacts balance it (the denominator).
  Vector3d velocity = Vector3d::Zero(), angular = Vector3d::Zero();
  if (!body.object.fixed) {
    const auto speed = [dtS](double mobility, double spring) {
      return mobility / (1.0 + mobility * spring * dtS);
    };
    Vector3d force = body.normalForceN, torque = body.normalTorqueNmm;
    if (body.held) {
      force += pull;
      torque += body.loadNmm;
    }
    velocity =
        limited(netForceN(body, force) * speed(kMobilityMmPerNs, body.stiffnessNPerMm), kMaxMmPerS);
    const double excess = torque.norm() - frictionLimitNmm(body, torque.normalized());
    if (excess > 0.0)
      angular = limited(torque.normalized() * excess *
                            speed(kMobilityMmPerNs / (kArmMm * kArmMm), body.turnStiffnessNmm),
                        kMaxRadPerS);
  }
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

std::vector<SceneObject> PhysicalObjects::present() const {
  std::vector<SceneObject> objects;
  for (const Body& body : bodies_) {
    objects.push_back(body.object);
    objects.back().positionMm = body.positionMm;
    objects.back().rotation = body.rotation;
  }
  return objects;
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
