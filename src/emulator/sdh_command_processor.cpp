// Commands of the emulated motion controller: quantities with one value per axis, text, motions.
#include "emulator/sdh_command_processor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

constexpr FirmwareVersion kAlways{0, 0, 0, 0};
constexpr FirmwareVersion kVelocityLimits{0, 0, 2, 1};
constexpr FirmwareVersion kSdhMotionControllers{0, 0, 2, 6};
constexpr FirmwareVersion kAccelerationLimits{0, 0, 2, 7};

constexpr SdhAxisVariable kQuantities[] = {
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

// Converts the exceptions of JointMotion (out of range, invalid) to error codes.
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

// earlier releases send lines with @ before answers
constexpr FirmwareVersion kQuietFirmware{0, 0, 3, 1};
constexpr FirmwareVersion kSdhTextCommandsControllers{0, 0, 2, 6};
constexpr int kDecimals = 4;

std::string upper(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string joined(const std::vector<double>& values, int decimals) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + fixedText(value, decimals);
  return text;
}

// The built-in grips, by id. The firmware's own angles are unknown; those of the preshapes of the
// same names are used.
constexpr const char* kGrips[] = {"centrical", "parallel", "cylindrical", "spherical"};

std::vector<double> gripAngles(unsigned grip, double ratio) {
  return sdh2Preshape(kGrips[grip]).anglesDeg(ratio);
}

}  // namespace

FirmwareVersion parseFirmware(std::string_view text) {
  for (const char c : text)
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
          c == '-'))
      throw std::invalid_argument("firmware '" + shortened(text) +
                                  "' has other characters than letters, digits, '.' and '-'");
  FirmwareVersion version{};
  const char* at = text.data();
  const char* end = at + text.size();
  for (std::size_t i = 0; i < version.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, version[i]);
    if (error != std::errc() || (i < 3 && (next == end || *next != '.')))
      throw std::invalid_argument("firmware '" + shortened(text) +
                                  "' isn't a release such as 0.0.3.3");
    at = i < 3 ? next + 1 : next;
  }
  return version;
}

SdhCommandProcessor::SdhCommandProcessor(HandModel& model, const SdhServerOptions& options)
    : model_(model), options_(options), firmware_(parseFirmware(options.firmware)) {
  const std::size_t n = numAxes();
  // Values seen in logs of a real hand [A].
  constexpr double kGripA = 0.5, kBaseGripA = 1.0, kHoldA = 0.2, kBaseHoldA = 0.1;
  gripCurrentA_.assign(n, kGripA);
  holdCurrentA_.assign(n, kHoldA);
  if (n > 0) {
    gripCurrentA_[0] = kBaseGripA;
    holdCurrentA_[0] = kBaseHoldA;
  }
  motionCurrentA_ = gripCurrentA_;
  for (const AxisDescription& axis : model.hand().axes) {
    minDeg_.push_back(axis.minimumDeg);
    maxDeg_.push_back(axis.maximumDeg);
  }
  offsetDeg_ = referenceKind_ = saved_ = std::vector<double>(n, 0.0);
  gain_.assign(n, {1.0});
  pid_.assign(n, {1.0, 0.0, 0.0});
}

void SdhCommandProcessor::powerCycle() {
  JointMotion& joints = model_.joints();
  joints.stop();
  joints.setController(ControllerType::kPose);
  joints.setProfile(VelocityProfile::kSinSquare);
  joints.setPower(std::vector<bool>(numAxes(), false));
}

const SdhAxisVariable* SdhCommandProcessor::quantity(std::string_view name) const {
  for (const SdhAxisVariable& known : kQuantities)
    if (known.name == name && !isBefore(known.since)) return &known;
  return nullptr;
}

const SdhAxisVariable* SdhCommandProcessor::quantity(unsigned number) const {
  for (const SdhAxisVariable& known : kQuantities)
    if (known.number == number && number != 0 && !isBefore(known.since)) return &known;
  return nullptr;
}

std::vector<double> SdhCommandProcessor::get(const SdhAxisVariable& quantity) const {
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
  if (name == "p_min") return minDeg_;
  if (name == "p_max") return maxDeg_;
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

std::vector<double> SdhCommandProcessor::set(const SdhAxisVariable& quantity,
                                             const std::vector<double>& values) {
  JointMotion& joints = model_.joints();
  const std::string_view name = quantity.name;
  if (!quantity.settable) throw SdhRefusal{kSdhNoParameters};
  if (values.size() != numAxes()) throw SdhRefusal{kSdhTooFewParameters};
  for (const double value : values)
    if (!std::isfinite(value)) throw SdhRefusal{kSdhInvalidParameter};
  if (name == "p" || name == "tpap") {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < minDeg_[i] || values[i] > maxDeg_[i]) throw SdhRefusal{kSdhRangeError};
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
    // A soft limit is refused when the present angle violates it.
    const bool least = name == "p_min";
    const auto& axes = model_.hand().axes;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < axes[i].minimumDeg || values[i] > axes[i].maximumDeg ||
          (least ? joints.angles()[i] < values[i] : joints.angles()[i] > values[i]))
        throw SdhRefusal{kSdhRangeError};
    (least ? minDeg_ : maxDeg_) = values;
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

// The parts of a line: name(index)=values.
struct SdhCommandProcessor::Words {
  std::string name;  // lower case
  std::optional<std::size_t> index;
  std::vector<double> values;
  bool hasValues = false;

  explicit Words(std::string_view line) {
    line = trimmed(line);
    const std::size_t equals = line.find('=');
    std::string_view head = trimmed(line.substr(0, equals));
    if (const std::size_t open = head.find('('); open != std::string_view::npos) {
      if (head.back() != ')') throw SdhRefusal{kSdhFormatError};
      const auto number = parseInteger(head.substr(open + 1, head.size() - open - 2));
      if (!number) throw SdhRefusal{kSdhFormatError};
      // A number that is no axis is out of bounds, whatever its sign.
      index = static_cast<std::size_t>(*number);
      head = trimmed(head.substr(0, open));
    }
    for (const char c : head) name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (equals == std::string_view::npos) return;
    hasValues = true;
    std::string_view rest = line.substr(equals + 1);
    for (;;) {
      const std::size_t comma = rest.find(',');
      const auto value = parseDouble(rest.substr(0, comma));
      if (!value) throw SdhRefusal{kSdhFormatError};
      values.push_back(*value);
      if (comma == std::string_view::npos) return;
      rest.remove_prefix(comma + 1);
    }
  }

  void requireNone() const {
    if (hasValues) throw SdhRefusal{kSdhNoParameters};
  }
  void require(std::size_t count) const {
    if (values.size() < count) throw SdhRefusal{kSdhTooFewParameters};
    if (values.size() > count) throw SdhRefusal{kSdhFormatError};
  }
};

SdhAnswer SdhCommandProcessor::execute(const std::string& line) {
  // The name is checked first: an unknown command is reported as unknown, whatever follows it.
  const std::string name = Words(line.substr(0, line.find_first_of("(="))).name;
  static constexpr std::string_view kOthers[] = {"ver",
                                                 "ver_date",
                                                 "soc",
                                                 "soc_date",
                                                 "id",
                                                 "sn",
                                                 "numaxis",
                                                 "temp",
                                                 "con",
                                                 "vp",
                                                 "m",
                                                 "stop",
                                                 "get_duration",
                                                 "selgrip",
                                                 "grip",
                                                 "demo",
                                                 "kv",
                                                 "pid",
                                                 "ref",
                                                 "user_errors",
                                                 "terminal",
                                                 "debug",
                                                 "use_fixed_length",
                                                 "change_rs232",
                                                 "change_channel"};
  const SdhAxisVariable* known = quantity(name);
  if (!known && std::find(std::begin(kOthers), std::end(kOthers), name) == std::end(kOthers))
    throw SdhRefusal{kSdhUnknownCommand};
  // Text after `stop` is ignored.
  const Words words(name == "stop" ? std::string_view("stop") : std::string_view(line));
  if (words.index && *words.index >= numAxes()) throw SdhRefusal{kSdhIndexOutOfBounds};
  if (known) return quantityCommand(*known, words);
  if (name == "kv") return gainCommand(words, gain_);
  if (name == "pid") return gainCommand(words, pid_);
  if (words.index && name != "ref") throw SdhRefusal{kSdhFormatError};
  if (auto answer = textCommand(words)) return *answer;
  if (auto answer = motionCommand(words)) return *answer;
  throw SdhRefusal{kSdhUnsupported};
}

SdhAnswer SdhCommandProcessor::quantityCommand(const SdhAxisVariable& quantity,
                                               const Words& words) {
  const int decimals = quantity.whole ? 0 : kDecimals;
  std::vector<double> result;
  if (!words.hasValues) {
    result = get(quantity);
  } else if (words.index) {
    words.require(1);
    if (!quantity.settable) throw SdhRefusal{kSdhNoParameters};
    // The other axes keep their values.
    std::vector<double> values = quantity.name == "tpap"   ? model_.joints().targets()
                                 : quantity.name == "tvav" ? model_.joints().targetVelocities()
                                                           : get(quantity);
    values[*words.index] = words.values[0];
    result = set(quantity, values);
  } else {
    if (!quantity.settable) throw SdhRefusal{kSdhNoParameters};
    words.require(numAxes());
    result = set(quantity, words.values);
  }
  const std::string name = upper(quantity.name);
  if (!words.index) return {name + "=" + joined(result, decimals)};
  return {name + "(" + std::to_string(*words.index) +
          ")=" + fixedText(result[*words.index], decimals)};
}

SdhAnswer SdhCommandProcessor::gainCommand(const Words& words,
                                           std::vector<std::vector<double>>& gains) {
  if (!words.index) throw SdhRefusal{kSdhTooFewParameters};
  std::vector<double>& gain = gains[*words.index];
  if (words.hasValues) {
    words.require(gain.size());
    gain = words.values;
  }
  return {upper(words.name) + "(" + std::to_string(*words.index) + ")=" + joined(gain, kDecimals)};
}

std::string SdhCommandProcessor::temperatures() const {
  // Temperatures of motors have steps of 0.25, that of the FPGA 0.125; two decimals, or three where
  // needed.
  constexpr double kStep = 0.25, kFineStep = 0.125;
  std::string text;
  const auto& sensors = model_.hand().temperatureSensors;
  const std::vector<double> degC = model_.temperatures();
  for (std::size_t i = 0; i < degC.size(); ++i) {
    const double step = i < sensors.size() && sensors[i].name == "FPGA" ? kFineStep : kStep;
    const double value = std::round(degC[i] / step) * step;
    const bool fine = std::round(value * 4.0) != value * 4.0;
    text += (text.empty() ? "" : ",") + fixedText(value, fine ? 3 : 2);
  }
  return text;
}

std::optional<SdhAnswer> SdhCommandProcessor::textCommand(const Words& words) const {
  const std::pair<std::string_view, std::string> texts[] = {
      {"ver", options_.firmware},
      {"ver_date", options_.firmwareDate},
      {"soc", options_.soc},
      {"soc_date", options_.socDate},
      {"id", options_.id},
      {"sn", options_.serial},
      {"numaxis", std::to_string(numAxes())},
      {"temp", words.name == "temp" ? temperatures() : std::string()}};
  for (const auto& [name, text] : texts) {
    if (words.name != name) continue;
    words.requireNone();
    return SdhAnswer{upper(name) + "=" + text};
  }
  return std::nullopt;
}

std::optional<SdhAnswer> SdhCommandProcessor::motionCommand(const Words& words) {
  JointMotion& joints = model_.joints();
  const bool chatty = isBefore(kQuietFirmware);
  const std::string& name = words.name;
  const bool isChoice = name == "con" || name == "vp" || name == "demo";
  if (isChoice) {
    if (name == "con" && isBefore(kSdhTextCommandsControllers))
      throw SdhRefusal{kSdhUnknownCommand};
    double value = name == "con"  ? static_cast<double>(joints.controller())
                   : name == "vp" ? static_cast<double>(joints.profile())
                                  : 0.0;
    if (words.hasValues) {
      words.require(1);
      value = words.values[0];
      if (value < 0.0 || value > (name == "con" ? 2.0 : 1.0)) throw SdhRefusal{kSdhRangeError};
      if (value != std::floor(value)) throw SdhRefusal{kSdhInvalidParameter};
      if (name == "con") joints.setController(static_cast<ControllerType>(value));
      if (name == "vp") joints.setProfile(static_cast<VelocityProfile>(value));
    }
    return SdhAnswer{upper(name) + "=" + fixedText(value, 0)};
  }
  if (name == "stop") {
    joints.stop();
    return SdhAnswer{"STOP"};
  }
  if (name == "m" || name == "get_duration") {
    words.requireNone();
    if (joints.controller() != ControllerType::kPose) throw SdhRefusal{kSdhInconsistent};
    const double durationS = name == "m" ? joints.startMotion() : joints.durationOfPending();
    return SdhAnswer{(chatty ? "@ planning\r\n" : "") + upper(name) + "=" +
                     fixedText(durationS, 2)};
  }
  if (name == "selgrip") return preshape(words);
  if (name == "grip") return grip(words);
  if (name == "ref") {
    if (words.hasValues) {
      words.require(words.index ? 1 : numAxes());
      std::vector<double> kinds = words.values;
      if (words.index) {
        kinds.assign(numAxes(), 0.0);
        kinds[*words.index] = words.values[0];
      }
      return reference(kinds, words.index);
    }
    return SdhAnswer{referenceText(words.index)};
  }
  return std::nullopt;
}

// Moves all axes to the targets; returns the duration [s]. The velocities set by the client are
// kept.
double SdhCommandProcessor::moveTo(const std::vector<double>& targetDeg, double velocityDegPerS) {
  JointMotion& joints = model_.joints();
  if (joints.controller() != ControllerType::kPose) throw SdhRefusal{kSdhInconsistent};
  std::vector<double> target(numAxes()), velocity(numAxes());
  for (std::size_t i = 0; i < numAxes(); ++i) {
    const AxisDescription& axis = model_.hand().axes[i];
    target[i] = std::clamp(i < targetDeg.size() ? targetDeg[i] : 0.0, minDeg_[i], maxDeg_[i]);
    velocity[i] = std::min(velocityDegPerS, axis.maximumVelocityDegPerS);
  }
  const std::vector<double> before = joints.targetVelocities();
  joints.setTargets(target);
  joints.setVelocities(velocity);
  const double durationS = joints.startMotion();
  joints.setVelocities(before);
  return durationS;
}

SdhAnswer SdhCommandProcessor::preshape(const Words& words) {
  words.require(1);
  const double id = words.values[0];
  constexpr double kLastGrip = 3.0, kVelocityDegPerS = 40.0;
  if (id < 0.0 || id > kLastGrip) throw SdhRefusal{kSdhRangeError};
  if (id != std::floor(id)) throw SdhRefusal{kSdhInvalidParameter};
  const auto chosen = static_cast<unsigned>(id);
  const double durationS = moveTo(gripAngles(chosen, 0.0), kVelocityDegPerS);
  grip_ = chosen;
  const std::string number = std::to_string(grip_);
  if (isBefore(kQuietFirmware)) return {"@ preshape\r\nSELGRIP=" + number, true, durationS};
  return {"SELGRIP=" + fixedText(durationS, 2) + "," + number, true, durationS};
}

SdhAnswer SdhCommandProcessor::grip(const Words& words) {
  words.require(2);
  const double ratio = words.values[0], velocity = words.values[1];
  constexpr double kMinVelocity = 0.5, kMaxVelocity = 100.0;
  if (ratio < 0.0 || ratio > 1.0 || velocity < kMinVelocity || velocity > kMaxVelocity)
    throw SdhRefusal{kSdhRangeError};
  const double durationS = moveTo(gripAngles(grip_, ratio), velocity);
  return {(isBefore(kQuietFirmware) ? "@ grip\r\nGRIP=" : "GRIP=") + fixedText(durationS, 2) + "," +
              numberText(ratio),
          true,
          durationS};
}

// Moves each axis to its positive (1) or negative (2) stop.
SdhAnswer SdhCommandProcessor::reference(const std::vector<double>& kinds,
                                         std::optional<std::size_t> axis) {
  std::vector<double> target = model_.joints().angles();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] != 0.0 && kinds[i] != 1.0 && kinds[i] != 2.0) throw SdhRefusal{kSdhRangeError};
    if (kinds[i] == 1.0) target[i] = maxDeg_[i];
    if (kinds[i] == 2.0) target[i] = minDeg_[i];
  }
  constexpr double kVelocityDegPerS = 40.0;  // 180 deg take 9 s
  const double durationS = moveTo(target, kVelocityDegPerS);
  referenceKind_ = kinds;
  return {referenceText(axis), true, durationS};
}

std::string SdhCommandProcessor::referenceText(std::optional<std::size_t> axis) const {
  if (!axis) return "REF=" + joined(referenceKind_, 0);
  return "REF(" + std::to_string(*axis) + ")=" + fixedText(referenceKind_[*axis], 0);
}

}  // namespace palpate
