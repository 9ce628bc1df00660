// Quantities with one value per axis.
#include "emulator/sdh_motion.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

constexpr FirmwareVersion kAlways{0, 0, 0, 0};
constexpr FirmwareVersion kVelocityLimits{0, 0, 2, 1};
constexpr FirmwareVersion kSdhMotionControllers{0, 0, 2, 6};
constexpr FirmwareVersion kAccelerationLimits{0, 0, 2, 7};

constexpr SdhQuantity kQuantities[] = {
    {"v", 0x80, true, false, kAlways},
    {"vel", 0x81, false, false, kAlways},
    {"rvel", 0x82, false, false, kSdhMotionControllers},
    {"pos", 0x83, false, false, kAlways},
    {"state", 0x84, false, true, kAlways},
    {"p", 0x85, true, false, kAlways},
    {"a", 0x86, true, false, kAlways},
    {"tpap", 0x8B, true, false, kAlways},
    {"tvav", 0x8C, true, false, kAlways},
    {"ilim", 0xA3, true, false, kAlways},
    {"power", 0xA4, true, true, kAlways},
    {"vlim", 0, false, false, kVelocityLimits},
    {"alim", 0, false, false, kAccelerationLimits},
    {"igrip", 0, true, false, kAlways},
    {"ihold", 0, true, false, kAlways},
    {"p_min", 0, true, false, kAlways},
    {"p_max", 0, true, false, kAlways},
    {"p_offset", 0, true, false, kAlways},
    {"pos_save", 0, true, true, kAlways},
};

void requireRange(const std::vector<double>& values, double least, double most) {
  for (const double value : values)
    if (value < least || value > most) throw SdhRefusal{kSdhRangeError};
}

std::vector<double> fromFlags(const std::vector<bool>& flags) {
  std::vector<double> values;
  for (const bool flag : flags) values.push_back(flag ? 1.0 : 0.0);
  return values;
}

// As a joint says it: outside of its range, or nonsense.
template <typename Setter>
void setJoints(Setter&& setter) {
  try {
    setter();
  } catch (const std::out_of_range&) {
    throw SdhRefusal{kSdhRangeError};
  } catch (const std::invalid_argument&) {
    throw SdhRefusal{kSdhInvalidParameter};
  }
}

}  // namespace

FirmwareVersion parseFirmware(std::string_view text) {
  for (const char c : text)
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
          c == '-'))
      throw std::invalid_argument("firmware '" + std::string(text) +
                                  "' has other characters than letters, digits, '.' and '-'");
  FirmwareVersion version{};
  const char* at = text.data();
  const char* end = at + text.size();
  for (std::size_t i = 0; i < version.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, version[i]);
    if (error != std::errc() || (i < 3 && (next == end || *next != '.')))
      throw std::invalid_argument("firmware '" + std::string(text) + "' is no release as 0.0.3.3");
    at = i < 3 ? next + 1 : next;
  }
  return version;
}

SdhMotion::SdhMotion(HandModel& model, const SdhServerOptions& options)
    : model_(model), options_(options), firmware_(parseFirmware(options.firmware)) {
  const std::size_t n = numAxes();
  // As logs of a real hand show them [A].
  constexpr double kGripA = 0.5, kBaseGripA = 1.0, kHoldA = 0.2, kBaseHoldA = 0.1;
  gripCurrentA_.assign(n, kGripA);
  holdCurrentA_.assign(n, kHoldA);
  if (n > 0) {
    gripCurrentA_[0] = kBaseGripA;
    holdCurrentA_[0] = kBaseHoldA;
  }
  motionCurrentA_ = gripCurrentA_;
  for (const AxisDescription& axis : model.hand().axes) {
    leastDeg_.push_back(axis.minimumDeg);
    mostDeg_.push_back(axis.maximumDeg);
  }
  offsetDeg_ = referenceKind_ = saved_ = std::vector<double>(n, 0.0);
  gain_.assign(n, {1.0});
  pid_.assign(n, {1.0, 0.0, 0.0});
}

void SdhMotion::powerCycle() {
  JointMotion& joints = model_.joints();
  joints.stop();
  joints.setController(ControllerType::kPose);
  joints.setProfile(VelocityProfile::kSinSquare);
  joints.setPower(std::vector<bool>(numAxes(), false));
}

const SdhQuantity* SdhMotion::quantity(std::string_view name) const {
  for (const SdhQuantity& known : kQuantities)
    if (known.name == name && !isBefore(known.since)) return &known;
  return nullptr;
}

const SdhQuantity* SdhMotion::quantity(unsigned number) const {
  for (const SdhQuantity& known : kQuantities)
    if (known.number == number && number != 0 && !isBefore(known.since)) return &known;
  return nullptr;
}

std::vector<double> SdhMotion::get(const SdhQuantity& quantity) const {
  const JointMotion& joints = model_.joints();
  const std::string_view name = quantity.name;
  std::vector<double> values;
  if (name == "v") return joints.targetVelocities();
  if (name == "vel" || name == "tvav") return joints.velocities();
  if (name == "rvel") return joints.referenceVelocities();
  if (name == "pos" || name == "tpap") return joints.angles();
  if (name == "p") return joints.targets();
  if (name == "a") return joints.accelerations();
  if (name == "power") return fromFlags(joints.power());
  if (name == "ilim") return motionCurrentA_;
  if (name == "igrip") return gripCurrentA_;
  if (name == "ihold") return holdCurrentA_;
  if (name == "p_min") return leastDeg_;
  if (name == "p_max") return mostDeg_;
  if (name == "p_offset") return offsetDeg_;
  if (name == "pos_save") return saved_;
  if (name == "state") {
    for (const AxisState state : joints.states())
      values.push_back(static_cast<double>(static_cast<int>(state)));
    return values;
  }
  for (const AxisDescription& axis : model_.hand().axes)
    values.push_back(name == "vlim" ? axis.maximumVelocityDegPerS
                                    : axis.maximumAccelerationDegPerS2);
  return values;
}

std::vector<double> SdhMotion::set(const SdhQuantity& quantity, const std::vector<double>& values) {
  JointMotion& joints = model_.joints();
  const std::string_view name = quantity.name;
  if (!quantity.settable) throw SdhRefusal{kSdhNoParameters};
  if (values.size() != numAxes()) throw SdhRefusal{kSdhTooFewParameters};
  for (const double value : values)
    if (!std::isfinite(value)) throw SdhRefusal{kSdhInvalidParameter};
  if (name == "p" || name == "tpap") {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < leastDeg_[i] || values[i] > mostDeg_[i]) throw SdhRefusal{kSdhRangeError};
    setJoints([&] { joints.setTargets(values); });
  } else if (name == "v" || name == "tvav") {
    if (joints.controller() != ControllerType::kPose)
      for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] != 0.0 && !joints.power()[i]) throw SdhRefusal{kSdhAxisDisabled};
    setJoints([&] { joints.setVelocities(values); });
  } else if (name == "a") {
    setJoints([&] { joints.setAccelerations(values); });
  } else if (name == "power") {
    requireRange(values, 0.0, 1.0);
    std::vector<bool> on;
    for (const double value : values) on.push_back(value >= 0.5);
    joints.setPower(on);
  } else if (name == "p_min" || name == "p_max") {
    // Soft limits that the hand already violates are refused.
    const bool least = name == "p_min";
    const auto& axes = model_.hand().axes;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < axes[i].minimumDeg || values[i] > axes[i].maximumDeg ||
          (least ? joints.angles()[i] < values[i] : joints.angles()[i] > values[i]))
        throw SdhRefusal{kSdhRangeError};
    (least ? leastDeg_ : mostDeg_) = values;
  } else if (name == "p_offset") {
    offsetDeg_ = values;
  } else if (name == "pos_save") {
    requireRange(values, 0.0, 1.0);
    saved_ = values;
  } else {
    requireRange(values, 0.0, 1.0);  // currents [A]
    (name == "ilim" ? motionCurrentA_ : name == "igrip" ? gripCurrentA_ : holdCurrentA_) = values;
  }
  return get(quantity);
}

}  // namespace palpate
