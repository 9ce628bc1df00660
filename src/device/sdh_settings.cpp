// The settings of the hand that are asked and set as lines: controller, limits, currents, gains.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh_controller.h"

#include "device/sdh_link.h"
#include "device/sdh_quantity.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;
using SdhSettingsValues = SdhController::Values;

constexpr double kAnyGain = 1e9;  // their sensible range isn't documented

int checkedChoice(const std::string& what, int value, int most) {
  if (value < 0 || value > most)
    throw std::invalid_argument(what + " must be 0.." + std::to_string(most) + ", not " +
                                std::to_string(value));
  return value;
}

SdhQuantity choice(SdhCommand command, double most) {
  return {command, "choice", "", 0.0, most, true};
}

SdhQuantity gain(SdhCommand command) { return {command, "gain", "", -kAnyGain, kAnyGain}; }

SdhQuantity current(SdhCurrent of) {
  const SdhCommand command = of == SdhCurrent::kMotion ? SdhCommand::kCurrentLimit
                             : of == SdhCurrent::kGrip ? SdhCommand::kGripCurrent
                                                       : SdhCommand::kHoldCurrent;
  return {command, "current limit", " A", 0.0, sdh::kMostAmpere};
}

SdhQuantity softLimit(SdhSoftLimit which) {
  const SdhCommand command = which == SdhSoftLimit::kMinimum   ? SdhCommand::kMinimum
                             : which == SdhSoftLimit::kMaximum ? SdhCommand::kMaximum
                                                               : SdhCommand::kOffset;
  return {command, "soft limit", " deg", -sdh::kMostDeg, sdh::kMostDeg};
}

void checkGain(const char* what, std::size_t axis, double value) {
  checkSdhAxis(axis);
  if (!(std::abs(value) <= kAnyGain))
    throw std::invalid_argument("axis " + std::to_string(axis) + ": " + what + " " +
                                numberText(value) + " is no number; nothing was sent");
}

SdhSettingsValues asNumbers(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

int SdhController::controller() {
  needFirmware("telling the controller type", 0, 0, 2, 6);
  facts_.controller = static_cast<int>(
      numbers("con", "CON", std::nullopt, choice(SdhCommand::kController, 2.0), 1, {})[0]);
  return facts_.controller;
}

void SdhController::setController(int controller) {
  checkedChoice("the controller type", controller, 2);
  if (controller > 0) needFirmware("a velocity controller", 0, 0, 2, 6);
  facts_.controller = static_cast<int>(numbers("con=" + std::to_string(controller),
                                               "CON",
                                               std::nullopt,
                                               choice(SdhCommand::kController, 2.0),
                                               1,
                                               {})[0]);
  if (facts_.controller != controller)
    link_->fail(DeviceFault::kProtocol, "the hand didn't take the controller type");
}

int SdhController::profile() {
  return static_cast<int>(
      numbers("vp", "VP", std::nullopt, choice(SdhCommand::kProfile, 1.0), 1, {})[0]);
}

void SdhController::setProfile(int profile) {
  checkedChoice("the velocity profile", profile, 1);
  const SdhQuantity taken = choice(SdhCommand::kProfile, 1.0);
  if (numbers("vp=" + std::to_string(profile), "VP", std::nullopt, taken, 1, {})[0] !=
      static_cast<double>(profile))
    link_->fail(DeviceFault::kProtocol, "the hand didn't take the velocity profile");
}

SdhSettingsValues SdhController::velocityLimits() {
  needFirmware("telling the velocity limits", 0, 0, 2, 1);
  return exchange(sdh::kVelocityLimit, {});
}

SdhSettingsValues SdhController::accelerationLimits() {
  needFirmware("telling the acceleration limits", 0, 0, 2, 7);
  return exchange(sdh::kAccelerationLimit, {});
}

SdhSettingsValues SdhController::currentLimits(SdhCurrent of) { return exchange(current(of), {}); }

SdhSettingsValues SdhController::setCurrentLimits(SdhCurrent of, const SdhSettingsValues& ampere) {
  checkSdhValues(current(of), ampere, 0.0, 1.0);
  return exchange(current(of), ampere);
}

SdhSettingsValues SdhController::softLimits(SdhSoftLimit which) {
  return exchange(softLimit(which), {});
}

SdhSettingsValues SdhController::setSoftLimits(SdhSoftLimit which, const SdhSettingsValues& deg) {
  checkSdhValues(softLimit(which), deg, -sdh::kMostDeg, sdh::kMostDeg);
  return exchange(softLimit(which), deg);
}

double SdhController::velocityGain(std::size_t axis) {
  checkSdhAxis(axis);
  const int index = static_cast<int>(axis);
  const auto quantity = gain(SdhCommand::kVelocityGain);
  return numbers(sdhLineRequest("kv", index), "KV", index, quantity, 1, {})[0];
}

void SdhController::setVelocityGain(std::size_t axis, double value) {
  checkGain("velocity gain", axis, value);
  const int index = static_cast<int>(axis);
  const auto quantity = gain(SdhCommand::kVelocityGain);
  numbers(sdhLineRequest("kv", index, SdhSettingsValues{value}), "KV", index, quantity, 1, {});
}

std::array<double, 3> SdhController::pid(std::size_t axis) {
  checkSdhAxis(axis);
  const int index = static_cast<int>(axis);
  const SdhSettingsValues values =
      numbers(sdhLineRequest("pid", index), "PID", index, gain(SdhCommand::kPid), 3, {});
  return {values[0], values[1], values[2]};
}

void SdhController::setPid(std::size_t axis, const std::array<double, 3>& gains) {
  for (const double value : gains) checkGain("controller gain", axis, value);
  const int index = static_cast<int>(axis);
  numbers(
      sdhLineRequest("pid", index, gains), "PID", index, gain(SdhCommand::kPid), gains.size(), {});
}

void SdhController::referenceRun(const std::vector<int>& direction) {
  const SdhQuantity quantity{SdhCommand::kReference, "direction", "", 0.0, 2.0, true};
  const SdhSettingsValues values = asNumbers(direction);
  checkSdhValues(quantity, values, 0.0, 2.0);
  const SdhPatience patience{.timeout = milliseconds(15'000), .tries = 1, .heedsUrgent = false};
  link_->ask(
      sdhLineRequest("ref", std::nullopt, values),
      "REF",
      std::nullopt,
      [](const SdhLine&) { return true; },
      patience);
}

void SdhController::savePositions(const std::vector<int>& axes) {
  const SdhQuantity quantity{SdhCommand::kSavePosition, "choice", "", 0.0, 1.0, true};
  const SdhSettingsValues values = asNumbers(axes);
  checkSdhValues(quantity, values, 0.0, 1.0);
  const SdhPatience once{.tries = 1};  // the flash wears
  link_->ask(
      sdhLineRequest("pos_save", std::nullopt, values),
      "POS_SAVE",
      std::nullopt,
      [](const SdhLine&) { return true; },
      once);
}

}  // namespace palpate
