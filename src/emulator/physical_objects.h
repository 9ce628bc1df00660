// The objects of a scene between the fingers: elastic contact, giving way, friction, weight and load.
// Quasi-static: an object moves as in thick oil, until forces balance or friction holds them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/emulator/scene.h>
#include <palpate/kinematics/hand_geometry.h>

namespace palpate {

// What presses on one matrix.
struct MatrixContact {
  double forceN = 0.0;                                    // sum of the normal forces
  Eigen::Vector3d forceOnPadN = Eigen::Vector3d::Zero();  // base frame
  Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();     // of pressure, base frame
  double surfaceXMm = 0.0, surfaceYMm = 0.0;              // the same place on the sensor surface
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();       // mean outward normal there
  std::optional<std::size_t> object;                      // that presses most
};

class PhysicalObjects {
 public:
  PhysicalObjects(const std::vector<SceneObject>& objects,
                  const HandGeometry& geometry,
                  double rubberNPerMm3);

  // Finds contact in a pose: pressure per place [kPa] and contact per matrix.
  void press(const HandPose& pose, std::vector<double>& pressureKpa);
  const std::vector<MatrixContact>& contacts() const noexcept { return contacts_; }
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
  struct Guided {  // a hand that moves it
    Eigen::Vector3d perS = Eigen::Vector3d::Zero();
    double leftS = 0.0;
  };
  struct Body {
    SceneObject object;
    Eigen::Vector3d positionMm;
    Eigen::Matrix3d rotation;
    bool held = false;  // friction carries it: weight and load act
    double untouchedS = 0.0;
    Eigen::Vector3d normalForceN;  // sum over all contacts, on the object
    Eigen::Vector3d normalTorqueNmm;
    double grip = 0.0;        // sum of the normal forces [N]
    double gripArmNmm = 0.0;  // sum of normal force times distance from the middle
    Eigen::Vector3d loadN = Eigen::Vector3d::Zero(), loadNmm = Eigen::Vector3d::Zero();
    Eigen::Vector3d wantedN = Eigen::Vector3d::Zero(), wantedNmm = Eigen::Vector3d::Zero();
    double loadLeftS = 0.0;
    Guided moved, turned;
    Motion motion;
  };

  void advanceBody(Body& body, double dtS);

  const HandGeometry& geometry_;
  double rubberNPerMm3_;
  std::vector<Body> bodies_;
  std::vector<MatrixContact> contacts_;
};

}  // namespace palpate
