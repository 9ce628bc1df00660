#include "palpate/emulator/physical_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <Eigen/Geometry>

#include "palpate/emulator/assumed_characteristics.h"
#include "palpate/emulator/emulated_geometry.h"
#include "palpate/emulator/sensor_model.h"
#include "palpate/model/hand_file.h"

#include "emulator/physical_objects.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

constexpr double kQuietStepS = 0.05;   // while nothing moves
constexpr double kContactN = 0.05;     // for the truth: a smaller force is no contact
constexpr double kAmbientDegC = 34.0;  // of the housing
constexpr double kWarmUpS = 900.0;     // time constant of a motor
constexpr double kMovingDegC = 14.0;   // final rise at full speed
constexpr double kHoldingDegC = 10.0;  // final rise at full torque
constexpr double kPoweredDegC = 2.0;
constexpr double kBoardSlowness = 2.0;
constexpr double kStretchMm = 0.3;  // of the rubber, until an object slides over it

// Assumed rises above the ambient temperature at rest [deg C]: of motors, which differ, and of
// electronics.
constexpr double kMotorRiseDegC[] = {2.0, 3.25, 1.5, 2.75, 1.0, 3.0, 1.75};
constexpr double kElectronicsRiseDegC[] = {10.5, 8.25};
constexpr double kAssumedVelocity = 100.0;  // of an axis without a limit [deg/s, mm/s]

std::vector<double> risesAtRest(const HandDescription& hand) {
  std::vector<double> rises;
  for (std::size_t i = 0; i < hand.temperatureSensors.size(); ++i) {
    const std::size_t numAxes = hand.axes.size();
    rises.push_back(i < numAxes
                        ? kMotorRiseDegC[i % std::size(kMotorRiseDegC)]
                        : kElectronicsRiseDegC[(i - numAxes) % std::size(kElectronicsRiseDegC)]);
  }
  return rises;
}

HandDescription withVelocities(HandDescription hand) {
  for (AxisDescription& axis : hand.axes)
    if (axis.maximumVelocityDegPerS <= 0.0) axis.maximumVelocityDegPerS = kAssumedVelocity;
  return hand;
}

std::vector<double> motorsOf(const PhysicalHandOptions& options) {
  if (!options.motorNmm.empty()) return options.motorNmm;
  std::vector<double> motors;
  for (const AxisDescription& axis : options.hand.axes) motors.push_back(axis.maximumTorqueNmm);
  return motors;
}

SensorCharacteristics characteristicsOf(const HandDescription& hand) {
  return hand.file && hand.file->characteristics ? *hand.file->characteristics
                                                 : assumedCharacteristics(hand);
}

// The axes' values at the beginning: those of the preshape; without one at rest.
std::vector<double> startAngles(const HandDescription& hand,
                                const std::string& preshape,
                                double close) {
  if (!preshape.empty()) return scenePreshape(hand, preshape).anglesDeg(close);
  std::vector<double> angles;
  for (const AxisDescription& axis : hand.axes)
    angles.push_back(std::clamp(0.0, axis.minimumDeg, axis.maximumDeg));
  return angles;
}

}  // namespace

struct PhysicalHand::Impl {
  Impl(const Scene& scene, const PhysicalHandOptions& given)
      : options(given),
        hand(withVelocities(given.hand)),
        characteristics(characteristicsOf(hand)),
        geometry(emulatedGeometry(hand)),
        objects(scene.objects, geometry, given.rubberNPerMm3),
        preshape(scene.preshape.empty() ? startPreshape(hand) : scene.preshape),
        joints(hand, startAngles(hand, preshape, scene.close)),
        sensor(hand, characteristics, given.seed),
        script(scene.script),
        repeatS(given.repeatsScript ? scene.repeatS : 0.0),
        wantsOpen(scene.close == 0.0),
        motorNmm(motorsOf(given)),
        riseDegC(risesAtRest(hand)),
        truth(hand.layout->numMatrices()),
        stretchMm(truth.size(), Eigen::Vector2d::Zero()),
        torqueNmm(hand.axes.size()) {
    if (!(options.rubberNPerMm3 > 0.0)) throw std::invalid_argument("PhysicalHandOptions: rubber");
    if (!(options.stepS > 0.0 && options.stepS <= 0.01))
      throw std::invalid_argument("PhysicalHandOptions: stepS is not in 0..0.01");
    if (motorNmm.size() != hand.axes.size())
      throw std::invalid_argument("PhysicalHandOptions: one motorNmm per axis");
    if (!options.zeroErrorDeg.empty() && options.zeroErrorDeg.size() != hand.axes.size())
      throw std::invalid_argument("PhysicalHandOptions: one zeroErrorDeg per axis, or none");
    for (const double error : options.zeroErrorDeg)
      if (!std::isfinite(error)) throw std::invalid_argument("PhysicalHandOptions: zeroErrorDeg");
    if (const double gain = characteristics.gainCountsPerKpa(kAmbientDegC);
        !(gain > 0.0 && std::isfinite(gain)))
      throw std::invalid_argument(hand.name +
                                  ": characteristics.pressure_plane: the value does not rise with "
                                  "the pressure");
    for (const ScriptStep& step : script)
      if (const auto* grasp = std::get_if<GraspAction>(&step.action))
        scenePreshape(hand, grasp->preshape.value_or(preshape));
    for (const double rise : riseDegC) degC.push_back(kAmbientDegC + rise);
    geometry.pose(trueAngles(), pose);
    before = pose;
    objects.press(pose, pressure);
    spreadPressure(*hand.layout, characteristics.neighbourFraction, pressure);
  }

  void step(double dtS) {
    const std::vector<double> anglesBefore = joints.angles();
    joints.advance(dtS);
    const bool moved = joints.angles() != anglesBefore;
    if (moved) {
      std::swap(before, pose);
      geometry.pose(trueAngles(), pose);
    }
    if (moved || (objects.size() > 0 && !still)) {
      objects.press(pose, pressure);
      objects.advance(dtS);
      hold();
      follow(dtS, moved);
      spreadPressure(*hand.layout, characteristics.neighbourFraction, pressure);
    }
    still = !moved && objects.quiet();
    sensor.advance(pressure, dtS);
    warm(dtS);
  }

  // The true joint angles, in contrast to the reported ones.
  std::vector<double> trueAngles() const {
    std::vector<double> angles = joints.angles();
    for (std::size_t axis = 0; axis < options.zeroErrorDeg.size(); ++axis)
      angles[axis] += options.zeroErrorDeg[axis];
    return angles;
  }

  // Slows or stops the axes whose torque is too large for their motors.
  void hold() {
    std::fill(torqueNmm.begin(), torqueNmm.end(), 0.0);
    for (const JointAxis& line : pose.jointAxes())
      for (std::size_t m = 0; m < objects.contacts().size(); ++m) {
        const SensorSurface& surface = geometry.description().surfaces[m];
        const SimulatedMatrixContact& contact = objects.contacts()[m];
        if (!surface.place.link || surface.place.finger != line.finger ||
            *surface.place.link < line.link || contact.forceN <= 0.0)
          continue;
        torqueNmm[line.axis] +=
            line.type == JointType::kPrismatic
                ? contact.forceOnPadN.dot(line.direction)
                : (contact.centreMm - line.originMm).cross(contact.forceOnPadN).dot(line.direction);
      }
    // An axis keeps its full speed up to half of its torque; above that, the speed decreases.
    for (std::size_t axis = 0; axis < torqueNmm.size(); ++axis) {
      if (motorNmm[axis] <= 0.0) continue;
      const double share = 2.0 * torqueNmm[axis] / motorNmm[axis];
      joints.setResistance(axis, -share - 1.0, share - 1.0);
    }
  }

  // Updates how far the objects have moved over the matrices.
  void follow(double dtS, bool moved) {
    for (std::size_t m = 0; m < truth.size(); ++m) {
      const SimulatedMatrixContact& contact = objects.contacts()[m];
      MatrixTruth& now = truth[m];
      if (contact.forceN < kContactN) {
        now = MatrixTruth{};
        stretchMm[m].setZero();
        continue;
      }
      if (!now.contact) now = MatrixTruth{};
      now.contact = true;
      now.forceN = contact.forceN;
      now.xMm = contact.centreMm.x();
      now.yMm = contact.centreMm.y();
      now.zMm = contact.centreMm.z();
      if (!contact.object) continue;  // contact with another pad: there is no slip
      const PhysicalObjects::Motion& motion = objects.motion(*contact.object);
      const Vector3d arm = contact.centreMm - objects.positionMm(*contact.object);
      Vector3d slide = (motion.velocityMmPerS + motion.angularRadPerS.cross(arm)) * dtS;
      if (moved)
        slide -= pose.pointMm(m, contact.surfaceXMm, contact.surfaceYMm) -
                 before.pointMm(m, contact.surfaceXMm, contact.surfaceYMm);
      const Vector3d right = pose.baseFromMatrix(m).linear().col(0);
      const Vector3d down = right.cross(contact.normal);
      const TaxelPitch& pitchMm = geometry.description().layout.matrix(m).pitchMm;
      now.slipXTaxels += slide.dot(right) / pitchMm.x;
      now.slipYTaxels += slide.dot(down) / pitchMm.y;
      // Rotation from x towards y: about x right cross y down, which points into the sensor.
      now.turnDeg -= motion.angularRadPerS.dot(contact.normal) * dtS * 180.0 / std::numbers::pi;
      const auto along = [&](const Vector3d& of) {
        return Eigen::Vector2d(of.dot(right), of.dot(down));
      };
      const auto atMost = [](const Eigen::Vector2d& of, double most) {
        return Eigen::Vector2d(of * std::min(1.0, most / std::max(of.norm(), 1e-12)));
      };
      stretchMm[m] = atMost(stretchMm[m] + along(slide), kStretchMm);
      const double friction = objects.friction(*contact.object);
      const Eigen::Vector2d shear =
          atMost(stretchMm[m] * (friction / kStretchMm) + along(objects.heldShare(*contact.object)),
                 friction);
      now.shearXN = shear.x() * contact.forceN;
      now.shearYN = shear.y() * contact.forceN;
    }
  }

  void warm(double dtS) {
    for (std::size_t i = 0; i < degC.size(); ++i) {
      double towards = ambientDegC + riseDegC[i];
      double slowS = kWarmUpS;
      if (i < joints.angles().size()) {
        const AxisDescription& axis = hand.axes[i];
        const double speed = std::abs(joints.velocities()[i]) / axis.maximumVelocityDegPerS;
        const double torque =
            motorNmm[i] > 0.0 ? std::min(std::abs(torqueNmm[i]) / motorNmm[i], 1.0) : 0.0;
        if (joints.power()[i])
          towards += kPoweredDegC + kMovingDegC * speed + kHoldingDegC * torque * torque;
      } else {
        slowS *= kBoardSlowness;
      }
      degC[i] += (towards - degC[i]) * (1.0 - std::exp(-dtS / slowS));
    }
  }

  // Nobody but the script has ordered anything.
  bool isOurs() const { return joints.orderCount() == ordersOfScript; }

  std::string_view ownMotion() const {
    const bool ended = nextStep == script.size() && repeatS == 0.0 && !joints.moving();
    if (script.empty() || ended || !isOurs()) return {};
    if (joints.moving()) return wantsOpen ? "opening" : "closing";
    if (wantsOpen) return "open";
    const bool touches = std::any_of(
        truth.begin(), truth.end(), [](const MatrixTruth& matrix) { return matrix.contact; });
    return touches ? "holding an object" : "closed";
  }

  // The time of the next step of the script; nothing: none follows.
  std::optional<double> nextStepS() {
    if (nextStep == script.size() && repeatS > 0.0 && !script.empty() && isOurs()) {
      nextStep = 0;
      passFromS += repeatS;
    }
    if (nextStep == script.size()) return std::nullopt;
    return passFromS + script[nextStep].atS;
  }

  void act(const SceneAction& action) {
    still = false;
    if (const auto* move = std::get_if<MoveObject>(&action)) objects.move(*move);
    if (const auto* turn = std::get_if<TurnObject>(&action)) objects.turn(*turn);
    if (const auto* load = std::get_if<LoadObject>(&action)) objects.load(*load);
    // Once a client moves the hand, the script no longer does.
    const bool mayMove = isOurs();
    if (const auto* grasp = std::get_if<GraspAction>(&action); grasp && mayMove) {
      if (grasp->preshape) preshape = *grasp->preshape;
      go(grasp->close, grasp->velocityDegPerS);
    }
    if (const auto* release = std::get_if<ReleaseAction>(&action); release && mayMove)
      go(0.0, release->velocityDegPerS);
    if (const auto* ambient = std::get_if<SetTemperature>(&action))
      ambientDegC = ambient->ambientDegC;
    for (std::size_t m = 0; m < sensor.settings().size(); ++m) {
      const auto meant = [&](const std::optional<std::size_t>& matrix) {
        return !matrix || *matrix == m;
      };
      if (const auto* set = std::get_if<SetSceneThreshold>(&action); set && meant(set->matrix))
        sensor.settings()[m].thresholdCounts = set->counts;
      if (const auto* set = std::get_if<SetSceneSensitivity>(&action); set && meant(set->matrix))
        sensor.settings()[m].sensitivity = set->sensitivity;
    }
  }

  void go(double close, double velocityDegPerS) {
    wantsOpen = close == 0.0;
    joints.setController(ControllerType::kPose);
    ordersOfScript = joints.orderCount();
    if (preshape.empty()) return;  // nothing to open
    std::vector<double> velocities;
    for (const AxisDescription& axis : hand.axes)
      velocities.push_back(std::min(velocityDegPerS, axis.maximumVelocityDegPerS));
    joints.setVelocities(velocities);
    joints.setTargets(scenePreshape(hand, preshape).anglesDeg(close));
    joints.startMotion();
    ordersOfScript = joints.orderCount();
  }

  // Temperature for the noise of each matrix: that of its sensor, otherwise of the whole hand.
  std::vector<double> matrixDegC() const {
    std::vector<double> temperatures;
    for (const MatrixDescription& matrix : hand.matrices)
      temperatures.push_back(matrix.temperatureSensor ? degC.at(*matrix.temperatureSensor)
                                                      : handDegC());
    return temperatures;
  }
  // Temperature of the whole hand: the mean of its sensors, or the ambient one.
  double handDegC() const {
    if (degC.empty()) return ambientDegC;
    return std::accumulate(degC.begin(), degC.end(), 0.0) / static_cast<double>(degC.size());
  }

  const PhysicalHandOptions options;
  const HandDescription hand;  // with a velocity for every axis
  const SensorCharacteristics characteristics;
  const HandGeometry geometry;
  PhysicalObjects objects;
  std::string preshape;  // empty: the hand has none
  JointMotion joints;
  SensorModel sensor;
  std::vector<ScriptStep> script;
  const double repeatS;  // 0: not repeated
  bool wantsOpen;        // where the script moved the hand last
  const std::vector<double> motorNmm;
  const std::vector<double> riseDegC;
  std::size_t nextStep = 0;
  double passFromS = 0.0;            // when the present pass of the script began
  std::uint64_t ordersOfScript = 0;  // JointMotion::orderCount() after its last motion
  double nowS = 0.0;
  bool still = false;
  HandPose pose, before;
  std::vector<double> pressure;  // per place [kPa]
  std::vector<MatrixTruth> truth, scanned;
  std::vector<Eigen::Vector2d> stretchMm;  // of the rubber of each matrix, along its surface
  std::vector<double> torqueNmm;
  std::vector<double> degC;
  double ambientDegC = kAmbientDegC;
};

PhysicalHand::PhysicalHand(const Scene& scene, const PhysicalHandOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}

PhysicalHand::~PhysicalHand() = default;

const HandDescription& PhysicalHand::hand() const { return impl_->options.hand; }

void PhysicalHand::advanceTo(double timeS) {
  Impl& hand = *impl_;
  if (!std::isfinite(timeS)) throw std::invalid_argument("PhysicalHand: time is not a number");
  while (hand.nowS < timeS) {
    std::optional<double> nextStepS = hand.nextStepS();
    for (; nextStepS && *nextStepS <= hand.nowS; nextStepS = hand.nextStepS())
      hand.act(hand.script[hand.nextStep++].action);
    double untilS = timeS;
    if (nextStepS) untilS = std::min(untilS, std::max(*nextStepS, hand.nowS + 1e-9));
    // While nothing moves the steps are large, unless the rubber still changes (exact at any step).
    const bool quiet = (hand.still || hand.objects.size() == 0) && !hand.joints.moving();
    const double most = quiet ? kQuietStepS : hand.options.stepS;
    const double leftS = untilS - hand.nowS;
    // A long time without changes is simulated in one step.
    const double dtS = quiet && leftS > 10.0 ? leftS : std::min(most, leftS);
    hand.step(dtS);
    hand.nowS += dtS;
  }
}

double PhysicalHand::timeS() const { return impl_->nowS; }
JointMotion& PhysicalHand::joints() { return impl_->joints; }
std::vector<MatrixSetting>& PhysicalHand::settings() { return impl_->sensor.settings(); }

void PhysicalHand::scan(std::span<std::uint16_t> counts) {
  impl_->sensor.scan(impl_->matrixDegC(), impl_->handDegC(), counts);
  impl_->scanned = impl_->truth;
}

void PhysicalHand::measure(std::span<float> values) {
  std::vector<std::array<double, 2>> shear;
  for (const MatrixTruth& matrix : impl_->truth)
    shear.push_back(matrix.contact
                        ? std::array{matrix.shearXN / matrix.forceN, matrix.shearYN / matrix.forceN}
                        : std::array{0.0, 0.0});
  impl_->sensor.measure(impl_->matrixDegC(), impl_->handDegC(), values, shear);
  impl_->scanned = impl_->truth;
}

Baseline PhysicalHand::baseline() const { return impl_->sensor.baseline(impl_->matrixDegC()); }

std::string_view PhysicalHand::ownMotion() const { return impl_->ownMotion(); }
std::vector<double> PhysicalHand::temperatures() { return impl_->degC; }
std::vector<MatrixTruth> PhysicalHand::truth() const { return impl_->scanned; }
std::vector<SceneObject> PhysicalHand::objects() const { return impl_->objects.present(); }
const std::vector<double>& PhysicalHand::pressureKpa() const noexcept { return impl_->pressure; }

}  // namespace palpate
