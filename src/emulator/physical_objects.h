// The objects of a scene between the fingers: elastic contact, giving way, friction, weight and
// load. Quasi-static: an object moves as in thick oil, until forces balance or friction holds it.
// Friction is Coulomb's, contact by contact: across a contact it holds up to friction times normal
// force, and about its normal up to that times the print's radius; along the normal it holds
// nothing. Forces in several directions at once share it: an ellipsoid over the principal axes of
// the normals is the limit (the limit surface of Goyal, Ruina and Papadopoulos, 1991, in its usual
// approximation).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/emulator/scene.h>
#include <palpate/kinematics/hand_geometry.h>

namespace palpate {

// What presses on one matrix.
struct SimulatedMatrixContact {
  double forceN = 0.0;                                    // sum of the normal forces
  Eigen::Vector3d forceOnPadN = Eigen::Vector3d::Zero();  // base frame
  Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();     // of pressure, base frame
  double surfaceXMm = 0.0, surfaceYMm = 0.0;              // the same place on the sensor surface
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();       // mean outward normal there
  std::optional<std::size_t> object;                      // that presses most; nothing: another pad
};

class PhysicalObjects {
 public:
  PhysicalObjects(const std::vector<SceneObject>& objects,
                  const HandGeometry& geometry,
                  double rubberNPerMm3);

  // Finds contact in a pose, with the objects and of pads with each other: pressure per place [kPa]
  // and contact per matrix.
  void press(const HandPose& pose, std::vector<double>& pressureKpa);
  const std::vector<SimulatedMatrixContact>& contacts() const noexcept { return contacts_; }
  // Moves the objects for a time under what press() found.
  void advance(double dtS);
  // Whether nothing moves: no object gives way or slides, nor is moved.
  bool quiet() const noexcept;

  void move(const MoveObject& move);
  void turn(const TurnObject& turn);
  void load(const LoadObject& load);

  struct Motion {
    Eigen::Vector3d velocityMmPerS = Eigen::Vector3d::Zero();
    Eigen::Vector3d angularRadPerS = Eigen::Vector3d::Zero();
  };
  // Of the last advance().
  const Motion& motion(std::size_t object) const { return bodies_.at(object).motion; }
  const Eigen::Vector3d& positionMm(std::size_t object) const {
    return bodies_.at(object).positionMm;
  }
  std::size_t size() const noexcept { return bodies_.size(); }

 private:
  struct ScriptedMotion {  // a hand that moves it
    Eigen::Vector3d perS = Eigen::Vector3d::Zero();
    double leftS = 0.0;
  };
  struct Touch {  // between the object and one matrix
    double forceN = 0.0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // mean, towards the object
    Eigen::Vector3d armMm = Eigen::Vector3d::Zero();   // from the object's middle
    double contactRadiusMm = 0.0;                      // radius of gyration of its pressure
  };
  struct Body {
    SceneObject object;
    Eigen::Vector3d positionMm;
    Eigen::Matrix3d rotation;
    bool held = false;  // friction carries it: weight and load act
    double untouchedS = 0.0;
    std::vector<Touch> touches;                     // one per matrix that it meets
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
  // What is left of a force [N] that friction opposes; zero where it holds.
  static Eigen::Vector3d netForceN(const Body& body, const Eigen::Vector3d& forceN);
  // What friction holds against a force in a direction [N], a torque about an axis [N mm] (unit
  // vectors).
  static double frictionLimitN(const Body& body, const Eigen::Vector3d& direction);
  static double frictionLimitNmm(const Body& body, const Eigen::Vector3d& axis);

  const HandGeometry& geometry_;
  double rubberNPerMm3_;
  std::vector<Body> bodies_;
  std::vector<SimulatedMatrixContact> contacts_;
  std::vector<double> strongestN_;  // per matrix: of the object that presses it most
};

}  // namespace palpate
