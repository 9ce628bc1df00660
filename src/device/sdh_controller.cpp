#include "palpate/device/sdh_controller.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/device/dsa_packet.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "device/sdh_link.h"
#include "device/sdh_quantity.h"
#include "device/wrong_controller_error.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;
using SdhControllerValues = SdhController::Values;

// If an echoed target differs by more than this, the hand misunderstood the command. Lines have few
// decimals, records 24 bits.
constexpr double kEchoDeg = 0.5;
constexpr int kMoveTries = 3;

template <typename Get>
SdhControllerValues ofAxes(Get get) {
  SdhControllerValues values;
  for (const AxisDescription& axis : sdh2().axes) values.push_back(get(axis));
  return values;
}

using std::chrono::milliseconds;
using SdhSettingsValues = SdhController::Values;

constexpr double kAnyGain = 1e9;  // the sensible range of the gains isn't documented

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
  return {command, "current limit", " A", 0.0, sdh::kMaxAmpere};
}

SdhQuantity softLimit(SdhSoftLimit which) {
  const SdhCommand command = which == SdhSoftLimit::kMinimum   ? SdhCommand::kMinimum
                             : which == SdhSoftLimit::kMaximum ? SdhCommand::kMaximum
                                                               : SdhCommand::kOffset;
  return {command, "soft limit", " deg", -sdh::kMaxDeg, sdh::kMaxDeg};
}

void checkGain(const char* what, std::size_t axis, double value) {
  checkSdhAxis(axis);
  if (!(std::abs(value) <= kAnyGain))
    throw std::invalid_argument("axis " + std::to_string(axis) + ": " + what + " " +
                                numberText(value) + " isn't a number; nothing was sent");
}

SdhSettingsValues asNumbers(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

SdhController::SdhController(ByteChannel& channel, const Clock& clock, SdhControllerOptions options)
    : link_(std::make_unique<SdhLink>(channel, clock, std::move(options.urgent))) {
  info_.maximumVelocity = ofAxes([](const auto& axis) { return axis.maximumVelocityDegPerS; });
  info_.maximumAcceleration =
      ofAxes([](const auto& axis) { return axis.maximumAccelerationDegPerS2; });
}

SdhController::~SdhController() = default;

SdhStats SdhController::stats() const noexcept { return link_->stats(); }

void SdhController::limitBadAnswers(milliseconds limit) noexcept { link_->limitBadAnswers(limit); }

// --- Opening

const SdhControllerInfo& SdhController::open() {
  DsaPacketParser tactile;
  struct Watch {
    SdhLink& link;
    ~Watch() { link.watch({}); }
  } const watch{*link_};
  link_->watch([&](SdhLink::Bytes bytes) { tactile.push(bytes, [](const DsaPacket&) {}); });
  const std::uint64_t readBefore = link_->stats().bytesRead;
  link_->sendText(" \r\n");  // ends an incomplete command of another program
  link_->drain(milliseconds(100), milliseconds(300));
  try {
    // If tactile frames arrive, one try is enough.
    info_.firmware = word("ver", {.tries = tactile.stats().packets > 0 ? 1 : 3});
  } catch (const SdhInterrupted&) {
    throw;
  } catch (const DeviceError& error) {
    if (tactile.stats().packets > 0)
      throw WrongControllerError(
          PortAnswer::kTactile,
          error.port(),
          "a tactile controller sends here, not a motion controller: the ports "
          "are swapped; exchange the two names");
    if (error.fault() != DeviceFault::kSilent) throw;
    const bool noise = link_->stats().bytesRead > readBefore;
    link_->fail(DeviceFault::kSilent,
                std::string(noise ? "this device doesn't answer like a motion controller"
                                  : "no motion controller answers here") +
                    "; check cable and power, and that this isn't the tactile port");
  }
  const SdhFirmware firmware = SdhFirmware::parse(info_.firmware);
  binary_ = firmware.atLeast(0, 0, 2, 15);
  readInfo();
  return info_;
}

void SdhController::readInfo() {
  const SdhRetryPolicy briefly{.timeout = milliseconds(500), .tries = 2};
  // Older firmware doesn't know all of these requests: it refuses them, or does not answer (then
  // the others are skipped).
  bool answers = true;
  const auto ifAnswered = [&](const auto& request) {
    if (!answers) return;
    try {
      request();
    } catch (const SdhInterrupted&) {
      throw;
    } catch (const DeviceError& error) {
      if (error.fault() == DeviceFault::kDisconnected || error.fault() == DeviceFault::kWrongDevice)
        throw;
      answers = error.fault() != DeviceFault::kSilent;
    }
  };
  ifAnswered([&] {
    const SdhQuantity axes{SdhCommand::kNumAxes, "number of axes", "", 0.0, 100.0, true};
    const double count = numbers("numaxis", "NUMAXIS", std::nullopt, axes, 1, briefly)[0];
    if (count != static_cast<double>(kSdhAxes))
      link_->fail(DeviceFault::kWrongDevice,
                  "this hand has " + std::to_string(static_cast<int>(count)) +
                      " axes; Palpate drives the SDH-2 with seven");
  });
  ifAnswered([&] { info_.date = word("ver_date", briefly); });
  ifAnswered([&] { info_.soc = word("soc", briefly); });
  ifAnswered([&] { info_.serial = word("sn", briefly); });
  ifAnswered([&] { info_.id = word("id", briefly); });
  // These values decide which commands may be sent, so newer firmware must report them.
  const SdhFirmware firmware = SdhFirmware::parse(info_.firmware);
  if (firmware.atLeast(0, 0, 2, 1)) info_.maximumVelocity = velocityLimits();
  if (firmware.atLeast(0, 0, 2, 7)) info_.maximumAcceleration = accelerationLimits();
  if (firmware.atLeast(0, 0, 2, 6)) info_.controller = controller();
}

void SdhController::needFirmware(const std::string& what, int a, int b, int c, int d) const {
  if (SdhFirmware::parse(info_.firmware).atLeast(a, b, c, d)) return;
  const std::string release = std::to_string(a) + "." + std::to_string(b) + "." +
                              std::to_string(c) + "." + std::to_string(d);
  link_->fail(DeviceFault::kUnsupported,
              what + " needs firmware " + release + " of the hand; this one has " +
                  (info_.firmware.empty() ? "not been opened" : info_.firmware));
}

// --- Asking

std::string SdhController::word(const std::string& command, const SdhRetryPolicy& retryPolicy) {
  std::string name = command;
  for (char& c : name)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return link_
      ->requestLine(
          command,
          name,
          std::nullopt,
          [](const SdhLine& line) { return !line.text.empty(); },
          retryPolicy)
      .text;
}

SdhControllerValues SdhController::numbers(const std::string& request,
                                           std::string_view name,
                                           std::optional<int> axis,
                                           const SdhQuantity& quantity,
                                           std::size_t count,
                                           const SdhRetryPolicy& retryPolicy) {
  SdhControllerValues values;
  link_->requestLine(
      request,
      name,
      axis,
      [&](const SdhLine& line) {
        values = parseSdhNumbers(line.text).value_or(SdhControllerValues{});
        return quantity.plausible(values, count);
      },
      retryPolicy);
  return values;
}

SdhControllerValues SdhController::exchange(const SdhQuantity& quantity,
                                            const SdhControllerValues& values,
                                            const SdhRetryPolicy& retryPolicy) {
  if (binary_ && sdhIsBinary(quantity.command))
    return link_->requestRecord(
        quantity.command,
        values,
        [&](const SdhControllerValues& answer) { return quantity.plausible(answer, kSdhAxes); },
        retryPolicy);
  const std::string name(sdhName(quantity.command));
  std::string upper = name;
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return numbers(sdhLineRequest(name, std::nullopt, values),
                 upper,
                 std::nullopt,
                 quantity,
                 kSdhAxes,
                 retryPolicy);
}

SdhControllerValues SdhController::exchange(const SdhQuantity& quantity,
                                            const SdhControllerValues& values) {
  return exchange(quantity, values, {});
}

SdhControllerValues SdhController::withAxis(std::size_t axis,
                                            SdhControllerValues values,
                                            double value) const {
  values.at(axis) = value;
  return values;
}

// --- State

SdhControllerValues SdhController::angles() { return exchange(sdh::kAngle, {}); }
SdhControllerValues SdhController::velocities() { return exchange(sdh::kVelocity, {}); }
SdhControllerValues SdhController::targets() { return exchange(sdh::kTarget, {}); }
SdhControllerValues SdhController::targetVelocities() { return exchange(sdh::kTargetVelocity, {}); }
SdhControllerValues SdhController::accelerations() { return exchange(sdh::kAcceleration, {}); }
SdhControllerValues SdhController::power() { return exchange(sdh::kPower, {}); }

SdhControllerValues SdhController::referenceVelocities() {
  needFirmware("the reference velocity", 0, 0, 2, 6);
  return exchange(sdh::kReferenceVelocity, {});
}

std::vector<int> SdhController::states() {
  std::vector<int> states;
  for (const double state : exchange(sdh::kState, {})) states.push_back(static_cast<int>(state));
  return states;
}

SdhControllerValues SdhController::temperatures() {
  return numbers("temp", "TEMP", std::nullopt, sdh::kTemperature, kSdhTemperatures, {});
}

// --- Targets

SdhControllerValues SdhController::setTargets(const SdhControllerValues& deg) {
  checkSdhValues(sdh::kTarget,
                 deg,
                 ofAxes([](const auto& axis) { return axis.minimumDeg; }),
                 ofAxes([](const auto& axis) { return axis.maximumDeg; }));
  for (int tries = 0;; ++tries) {
    const SdhControllerValues taken = exchange(sdh::kTarget, deg);
    const bool same = std::equal(deg.begin(), deg.end(), taken.begin(), [](double a, double b) {
      return std::abs(a - b) <= kEchoDeg;
    });
    if (same) return taken;
    if (tries == 1)
      link_->fail(DeviceFault::kProtocol, "the hand took other target angles than were sent");
  }
}

SdhControllerValues SdhController::checkedVelocities(const SdhControllerValues& degPerS) const {
  SdhControllerValues least(kSdhAxes, 0.0);
  if (info_.controller != 0)
    for (std::size_t axis = 0; axis < kSdhAxes; ++axis) least[axis] = -info_.maximumVelocity[axis];
  checkSdhValues(sdh::kTargetVelocity, degPerS, least, info_.maximumVelocity);
  return degPerS;
}

SdhControllerValues SdhController::setVelocities(const SdhControllerValues& degPerS) {
  return exchange(sdh::kTargetVelocity, checkedVelocities(degPerS));
}

SdhControllerValues SdhController::setVelocitiesGetVelocities(const SdhControllerValues& degPerS) {
  return exchange(sdh::kTargetGetVelocity, checkedVelocities(degPerS));
}

SdhControllerValues SdhController::setTargetsGetAngles(const SdhControllerValues& deg) {
  checkSdhValues(sdh::kTargetGetAngle,
                 deg,
                 ofAxes([](const auto& axis) { return axis.minimumDeg; }),
                 ofAxes([](const auto& axis) { return axis.maximumDeg; }));
  return exchange(sdh::kTargetGetAngle, deg);
}

SdhControllerValues SdhController::setAccelerations(const SdhControllerValues& degPerS2) {
  checkSdhValues(
      sdh::kAcceleration, degPerS2, SdhControllerValues(kSdhAxes, 0.0), info_.maximumAcceleration);
  return exchange(sdh::kAcceleration, degPerS2);
}

SdhControllerValues SdhController::setTarget(std::size_t axis, double deg) {
  checkSdhAxis(axis);
  return setTargets(withAxis(axis, targets(), deg));
}

SdhControllerValues SdhController::setVelocity(std::size_t axis, double degPerS) {
  checkSdhAxis(axis);
  return setVelocities(withAxis(axis, targetVelocities(), degPerS));
}

SdhControllerValues SdhController::setAcceleration(std::size_t axis, double degPerS2) {
  checkSdhAxis(axis);
  return setAccelerations(withAxis(axis, accelerations(), degPerS2));
}

SdhControllerValues SdhController::setPower(const SdhControllerValues& onOff) {
  checkSdhValues(sdh::kPower, onOff, 0.0, 1.0);
  return exchange(sdh::kPower, onOff);
}

SdhControllerValues SdhController::setPower(bool on) {
  return setPower(SdhControllerValues(kSdhAxes, on ? 1.0 : 0.0));
}

SdhControllerValues SdhController::setAxisPower(std::size_t axis, bool on) {
  checkSdhAxis(axis);
  return setPower(withAxis(axis, power(), on ? 1.0 : 0.0));
}

// --- Motion

double SdhController::move() {
  constexpr SdhRetryPolicy kOnce{.tries = 1};
  const SdhQuantity duration{SdhCommand::kMove, "duration", " s", 0.0, 3600.0};
  const auto start = [&] { return numbers("m", "M", std::nullopt, duration, 1, kOnce)[0]; };
  for (int tries = 1;; ++tries) try {
      return start();
    } catch (const DeviceError& error) {
      if (error.fault() == DeviceFault::kDisconnected ||
          dynamic_cast<const SdhInterrupted*>(&error) || !link_->mayBeLost() || tries == kMoveTries)
        throw;
      // Either the request or only its answer was lost; a second `m` during the motion would cause
      // a jerk.
      const std::vector<int> now = states();
      if (std::any_of(now.begin(), now.end(), sdhAxisMoves)) return pendingDuration();
    }
}

double SdhController::pendingDuration() {
  const SdhQuantity duration{SdhCommand::kDuration, "duration", " s", 0.0, 3600.0};
  return numbers("get_duration", "GET_DURATION", std::nullopt, duration, 1, {})[0];
}

void SdhController::stop() {
  if (link_->stop()) return;
  // Another line than STOP may be an echo or noise. This is asked also while another stop waits.
  const SdhControllerValues states = exchange(sdh::kState, {}, {.abortsForStop = false});
  if (std::any_of(states.begin(), states.end(), [](double state) {
        return sdhAxisMoves(static_cast<int>(state));
      }))
    link_->fail(DeviceFault::kSilent,
                "'stop' was sent, but the axes still move: use the emergency stop");
}

int SdhController::controller() {
  needFirmware("telling the controller type", 0, 0, 2, 6);
  info_.controller = static_cast<int>(
      numbers("con", "CON", std::nullopt, choice(SdhCommand::kController, 2.0), 1, {})[0]);
  return info_.controller;
}

void SdhController::setController(int controller) {
  checkedChoice("the controller type", controller, 2);
  if (controller > 0) needFirmware("a velocity controller", 0, 0, 2, 6);
  info_.controller = static_cast<int>(numbers("con=" + std::to_string(controller),
                                              "CON",
                                              std::nullopt,
                                              choice(SdhCommand::kController, 2.0),
                                              1,
                                              {})[0]);
  if (info_.controller != controller)
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
  checkSdhValues(softLimit(which), deg, -sdh::kMaxDeg, sdh::kMaxDeg);
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
  const SdhRetryPolicy retryPolicy{
      .timeout = milliseconds(15'000), .tries = 1, .abortsForStop = false};
  link_->requestLine(
      sdhLineRequest("ref", std::nullopt, values),
      "REF",
      std::nullopt,
      [](const SdhLine&) { return true; },
      retryPolicy);
}

void SdhController::savePositions(const std::vector<int>& axes) {
  const SdhQuantity quantity{SdhCommand::kSavePosition, "choice", "", 0.0, 1.0, true};
  const SdhSettingsValues values = asNumbers(axes);
  checkSdhValues(quantity, values, 0.0, 1.0);
  const SdhRetryPolicy once{.tries = 1};  // a single try, because the flash wears
  link_->requestLine(
      sdhLineRequest("pos_save", std::nullopt, values),
      "POS_SAVE",
      std::nullopt,
      [](const SdhLine&) { return true; },
      once);
}

}  // namespace palpate
