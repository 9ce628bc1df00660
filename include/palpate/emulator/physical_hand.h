// Physical model of an emulated hand, of any description: joints that are stopped by contact,
// objects pressed by the fingers, rubber, sensors, motor temperatures, and a script of events.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/emulator/scene.h>
#include <palpate/model/hand_file.h>
#include <palpate/model/touch.h>

namespace palpate {

struct PhysicalHandOptions {
  std::uint64_t seed = 1;  // seed of the sensors' noise
  // Elastic foundation of the sensor's rubber: 1 mm of indentation gives 150 kPa, which read about
  // the 3554 counts that the study reports for 1 mm.
  double rubberNPerMm3 = 0.15;
  // Torque at which each motor stalls (current limit) [N mm; N for a sliding axis]; 0: never.
  // Empty: the largest torques of the hand's description.
  std::vector<double> motorNmm = {};
  // Zero error of each joint [deg]: the true angle minus the reported one. Empty: no error. On a
  // real hand it differs between sessions (recognition/session_offset.h).
  std::vector<double> zeroErrorDeg = {};
  // Time step of the simulation while something moves [s].
  double stepS = 0.004;
  // Whether the script of a scene that can be repeated (Scene::repeatS) begins again and again.
  bool repeatsScript = false;
  // The hand. Its sensor characteristics are those of its file, otherwise assumedCharacteristics();
  // its geometry is emulatedGeometry(). An axis without a velocity moves with up to 100 per s. The
  // first temperature sensors are those of the axes' motors, the others those of electronics.
  HandDescription hand = defaultHand();
};

// The script moves the hand until somebody else gives its joints an order
// (JointMotion::orderCount): a motion, a stop, also at rest, the power. From then on the script
// doesn't move the hand and is not repeated; what it does to the objects in its present pass still
// happens.
class PhysicalHand final : public HandModel {
 public:
  // Throws std::invalid_argument (options, preshapes of the scene), and Error when the hand's
  // geometry is inconsistent.
  explicit PhysicalHand(const Scene& scene, const PhysicalHandOptions& options = {});
  ~PhysicalHand() override;

  const HandDescription& hand() const override;
  // Throws std::invalid_argument when the time isn't finite.
  void advanceTo(double timeS) override;
  double timeS() const override;
  JointMotion& joints() override;
  std::vector<MatrixSetting>& settings() override;
  void scan(std::span<std::uint16_t> counts) override;
  // Fills `values` with what the hand's sender streams now, see SensorModel::measure(). The truth
  // is that of this moment then. Size: numReadings(). Draws other noise than scan().
  //
  // Shear: where an object moves over a matrix, it stretches the rubber, whose force grows to
  // friction times normal force within 0.3 mm and stays there. Weight and load of a held object
  // are shared among its contacts by their normal forces. Together they don't exceed the friction.
  void measure(std::span<float> values);
  // What measure() gives of matrices that decide touch when nothing presses, see
  // SensorModel::baseline().
  Baseline baseline() const;
  std::vector<double> temperatures() override;
  std::vector<MatrixTruth> truth() const override;
  // By the script of the scene.
  std::string_view ownMotion() const override;

  // The objects of the scene in their poses after the last step.
  std::vector<SceneObject> objects() const;
  // Pressure on each place in the last step, before the effects of rubber and sensor [kPa].
  const std::vector<double>& pressureKpa() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
