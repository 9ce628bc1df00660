// The text commands of the motion controller.
#include <algorithm>
#include <cmath>

#include "palpate/core/number_text.h"
#include "palpate/model/preshape.h"

#include "emulator/sdh_motion.h"

namespace palpate {
namespace {

constexpr FirmwareVersion kQuietFirmware{0, 0, 3, 1};  // before: lines with @ ahead of answers
constexpr FirmwareVersion kSdhTextCommandsControllers{0, 0, 2, 6};
constexpr int kDecimals = 4;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

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

// The built-in grips, by id (the firmware's own angles are not known; those of the preshapes of the
// same names).
constexpr const char* kGrips[] = {"centrical", "parallel", "cylindrical", "spherical"};

std::vector<double> gripAngles(unsigned grip, double ratio) {
  return sdh2Preshape(kGrips[grip]).anglesDeg(ratio);
}

}  // namespace

// A line taken apart: name(index)=values.
struct SdhMotion::Words {
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
      // Any number that is no axis is out of bounds, whatever its sign.
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

SdhAnswer SdhMotion::execute(const std::string& line) {
  // The name first: an unknown command is unknown, whatever follows it.
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
  const SdhQuantity* known = quantity(name);
  if (!known && std::find(std::begin(kOthers), std::end(kOthers), name) == std::end(kOthers))
    throw SdhRefusal{kSdhUnknownCommand};
  // What follows `stop` is ignored.
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

SdhAnswer SdhMotion::quantityCommand(const SdhQuantity& quantity, const Words& words) {
  const int decimals = quantity.whole ? 0 : kDecimals;
  std::vector<double> result;
  if (!words.hasValues) {
    result = get(quantity);
  } else if (words.index) {
    words.require(1);
    if (!quantity.settable) throw SdhRefusal{kSdhNoParameters};
    // The other axes keep what is set for them.
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

SdhAnswer SdhMotion::gainCommand(const Words& words, std::vector<std::vector<double>>& gains) {
  if (!words.index) throw SdhRefusal{kSdhTooFewParameters};
  std::vector<double>& gain = gains[*words.index];
  if (words.hasValues) {
    words.require(gain.size());
    gain = words.values;
  }
  return {upper(words.name) + "(" + std::to_string(*words.index) + ")=" + joined(gain, kDecimals)};
}

std::string SdhMotion::temperatures() const {
  // Motors in steps of 0.25, the FPGA's of 0.125; two decimals, or three where they are needed.
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

std::optional<SdhAnswer> SdhMotion::textCommand(const Words& words) const {
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

std::optional<SdhAnswer> SdhMotion::motionCommand(const Words& words) {
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

// Moves all axes there; returns the duration [s]. The velocities that were set stay set.
double SdhMotion::moveTo(const std::vector<double>& targetDeg, double velocityDegPerS) {
  JointMotion& joints = model_.joints();
  if (joints.controller() != ControllerType::kPose) throw SdhRefusal{kSdhInconsistent};
  std::vector<double> target(numAxes()), velocity(numAxes());
  for (std::size_t i = 0; i < numAxes(); ++i) {
    const AxisDescription& axis = model_.hand().axes[i];
    target[i] = std::clamp(i < targetDeg.size() ? targetDeg[i] : 0.0, leastDeg_[i], mostDeg_[i]);
    velocity[i] = std::min(velocityDegPerS, axis.maximumVelocityDegPerS);
  }
  const std::vector<double> before = joints.targetVelocities();
  joints.setTargets(target);
  joints.setVelocities(velocity);
  const double durationS = joints.startMotion();
  joints.setVelocities(before);
  return durationS;
}

SdhAnswer SdhMotion::preshape(const Words& words) {
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

SdhAnswer SdhMotion::grip(const Words& words) {
  words.require(2);
  const double ratio = words.values[0], velocity = words.values[1];
  constexpr double kLeastVelocity = 0.5, kMostVelocity = 100.0;
  if (ratio < 0.0 || ratio > 1.0 || velocity < kLeastVelocity || velocity > kMostVelocity)
    throw SdhRefusal{kSdhRangeError};
  const double durationS = moveTo(gripAngles(grip_, ratio), velocity);
  return {(isBefore(kQuietFirmware) ? "@ grip\r\nGRIP=" : "GRIP=") + fixedText(durationS, 2) + "," +
              numberText(ratio),
          true,
          durationS};
}

// Each axis runs to its positive (1) or negative (2) stop.
SdhAnswer SdhMotion::reference(const std::vector<double>& kinds, std::optional<std::size_t> axis) {
  std::vector<double> target = model_.joints().angles();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] != 0.0 && kinds[i] != 1.0 && kinds[i] != 2.0) throw SdhRefusal{kSdhRangeError};
    if (kinds[i] == 1.0) target[i] = mostDeg_[i];
    if (kinds[i] == 2.0) target[i] = leastDeg_[i];
  }
  constexpr double kVelocityDegPerS = 40.0;  // 180 deg take 9 s
  const double durationS = moveTo(target, kVelocityDegPerS);
  referenceKind_ = kinds;
  return {referenceText(axis), true, durationS};
}

std::string SdhMotion::referenceText(std::optional<std::size_t> axis) const {
  if (!axis) return "REF=" + joined(referenceKind_, 0);
  return "REF(" + std::to_string(*axis) + ")=" + fixedText(referenceKind_[*axis], 0);
}

}  // namespace palpate
