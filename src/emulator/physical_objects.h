// The objects of a scene between the fingers of PhysicalHand: elastic contact, yielding, friction,
// weight and load. The model is quasi-static: an object moves as in a viscous fluid until the
// forces balance or friction holds it. Each contact has Coulomb friction: in its plane up to
// friction times normal force, about its normal up to that times the radius of the contact area,
// and none along the normal. Forces in several directions share this limit: it is an ellipsoid over
// the principal axes of the normals (the limit surface of Goyal, Ruina and Papadopoulos, 1991, in
// its usual approximation).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/emulator/scene.h>
#include <palpate/kinematics/hand_geometry.h>

namespace palpate {

// Contact on one matrix.
struct SimulatedMatrixContact {
  double forceN = 0.0;                                    // sum of the normal forces
  Eigen::Vector3d forceOnPadN = Eigen::Vector3d::Zero();  // base frame
  Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();     // centre of pressure, base frame
  double surfaceXMm = 0.0, surfaceYMm = 0.0;              // the same point on the sensor surface
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();       // mean outward normal there
  // Object with the largest force; empty for another pad.
  std::optional<std::size_t> object;
};

class PhysicalObjects {
 public:
  PhysicalObjects(const std::vector<SceneObject>& objects,
                  const HandGeometry& geometry,
                  double rubberNPerMm3);

  // Computes the contacts in a pose, with the objects and between pads: pressure per place [kPa]
  // and contact per matrix.
  void press(const HandPose& pose, std::vector<double>& pressureKpa);
  const std::vector<SimulatedMatrixContact>& contacts() const noexcept { return contacts_; }
  // Moves the objects for a time under the forces found by press().
  void advance(double dtS);
  // True if no object moves, neither under forces nor by the script.
  bool quiet() const noexcept;

  void move(const MoveObject& move);
  void turn(const TurnObject& turn);
  void load(const LoadObject& load);

  struct Motion {
    Eigen::Vector3d velocityMmPerS = Eigen::Vector3d::Zero();
    Eigen::Vector3d angularRadPerS = Eigen::Vector3d::Zero();
  };
  // Motion during the last advance().
  const Motion& motion(std::size_t object) const { return bodies_.at(object).motion; }
  const Eigen::Vector3d& positionMm(std::size_t object) const {
    return bodies_.at(object).positionMm;
  }
  double friction(std::size_t object) const { return bodies_.at(object).object.friction; }
  // Weight and load of an object that friction holds, per newton of its normal forces.
  Eigen::Vector3d heldShare(std::size_t object) const;
  std::size_t size() const noexcept { return bodies_.size(); }
  // The objects in their present poses.
  std::vector<SceneObject> present() const;

 private:
  // A motion by the script.
  struct ScriptedMotion {
    Eigen::Vector3d perS = Eigen::Vector3d::Zero();
    double leftS = 0.0;
  };
  // Contact between the object and one matrix.
  struct Touch {
    double forceN = 0.0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // mean, towards the object
    Eigen::Vector3d armMm = Eigen::Vector3d::Zero();   // from the object's centre
    double contactRadiusMm = 0.0;                      // radius of gyration of its pressure
  };
  struct Body {
    SceneObject object;
    Eigen::Vector3d positionMm;
    Eigen::Matrix3d rotation;
    bool held = false;  // friction holds it: weight and load are applied
    double untouchedS = 0.0;
    std::vector<Touch> touches;                     // one per matrix in contact
    Eigen::Vector3d normalForceN, normalTorqueNmm;  // sum over all contacts, on the object
    double grip = 0.0;                              // sum of the normal forces [N]
    double stiffnessNPerMm = 0.0;                   // of all contacts together
    double turnStiffnessNmm = 0.0;                  // [N mm/rad]
    Eigen::Vector3d loadN = Eigen::Vector3d::Zero(), loadNmm = Eigen::Vector3d::Zero();
    Eigen::Vector3d wantedN = Eigen::Vector3d::Zero(), wantedNmm = Eigen::Vector3d::Zero();
    double loadLeftS = 0.0;
    ScriptedMotion moved, turned;
    Motion motion;
  };

  void pressPads(const HandPose& pose, std::vector<double>& pressureKpa);
  void pressBody(std::size_t index, const HandPose& pose, std::vector<double>& pressureKpa);
  static void advanceBody(Body& body, double dtS);
  // Its load and weight.
  static Eigen::Vector3d pullN(const Body& body);
  // The part of a force [N] that exceeds the friction; zero where friction holds.
  static Eigen::Vector3d netForceN(const Body& body, const Eigen::Vector3d& forceN);
  // Largest force in a direction [N], and largest torque about an axis [N mm], that friction holds
  // (unit vectors).
  static double frictionLimitN(const Body& body, const Eigen::Vector3d& direction);
  static double frictionLimitNmm(const Body& body, const Eigen::Vector3d& axis);

  const HandGeometry& geometry_;
  double rubberNPerMm3_;
  std::vector<Body> bodies_;
  std::vector<SimulatedMatrixContact> contacts_;
  // Per matrix: force of the object with the largest force.
  std::vector<double> strongestN_;
};

}  // namespace palpate
