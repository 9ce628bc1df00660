// Executes the motion controller's commands for SdhServer, in text or binary form: quantities with
// one value per axis, motions and text answers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/emulator/hand_model.h"
#include "palpate/emulator/sdh_server.h"

namespace palpate {

// Error numbers of the protocol.
constexpr unsigned kSdhUnsupported = 4;
constexpr unsigned kSdhInconsistent = 5;
constexpr unsigned kSdhTooFewParameters = 11;
constexpr unsigned kSdhNoParameters = 12;
constexpr unsigned kSdhUnknownCommand = 13;
constexpr unsigned kSdhFormatError = 14;
constexpr unsigned kSdhInvalidParameter = 23;
constexpr unsigned kSdhRangeError = 24;
constexpr unsigned kSdhIndexOutOfBounds = 26;
constexpr unsigned kSdhAxisDisabled = 28;
constexpr unsigned kSdhLineTooLong = 32;
constexpr unsigned kSdhChecksumError = 33;

constexpr std::size_t kSdhRecordAxes = 7;
constexpr std::size_t kSdhMaxLine = 254;

// The controller refuses a command with this error; thrown inside this module only.
struct SdhRefusal {
  unsigned code = 0;
};

using FirmwareVersion = std::array<int, 4>;
// Parses "0.0.3.3", with any text after the numbers. Throws std::invalid_argument.
FirmwareVersion parseFirmware(std::string_view text);

// A quantity with one value per axis.
struct SdhAxisVariable {
  std::string_view name;
  unsigned number = 0;  // of the binary record; 0: text only
  bool settable = false;
  bool whole = false;  // printed without decimals
  FirmwareVersion since{};
};

// An answer, to be sent now or after the motion.
struct SdhAnswer {
  std::string text;
  bool afterMotion = false;
  double durationS = 0.0;  // expected duration [s], with afterMotion
};

class SdhCommandProcessor {
 public:
  SdhCommandProcessor(HandModel& model, const SdhServerOptions& options);

  // Finds quantities by name or number; null if this firmware doesn't have it.
  const SdhAxisVariable* quantity(std::string_view name) const;
  const SdhAxisVariable* quantity(unsigned number) const;
  // Throw SdhRefusal. `set` returns the resulting values; for tpap and tvav the actual ones.
  std::vector<double> get(const SdhAxisVariable& quantity) const;
  std::vector<double> set(const SdhAxisVariable& quantity, const std::vector<double>& values);
  // Executes a text command. Throws SdhRefusal.
  SdhAnswer execute(const std::string& line);
  bool moving() const { return model_.joints().moving(); }
  void powerCycle();

 private:
  struct Words;
  SdhAnswer quantityCommand(const SdhAxisVariable& quantity, const Words& words);
  std::optional<SdhAnswer> textCommand(const Words& words) const;
  std::optional<SdhAnswer> motionCommand(const Words& words);
  SdhAnswer gainCommand(const Words& words, std::vector<std::vector<double>>& gains);
  SdhAnswer grip(const Words& words);
  SdhAnswer preshape(const Words& words);
  SdhAnswer reference(const std::vector<double>& kinds, std::optional<std::size_t> axis);
  std::string referenceText(std::optional<std::size_t> axis) const;
  double moveTo(const std::vector<double>& targetDeg, double velocityDegPerS);
  std::string temperatures() const;
  std::size_t numAxes() const { return model_.hand().axes.size(); }
  bool isBefore(const FirmwareVersion& version) const { return firmware_ < version; }

  HandModel& model_;
  SdhServerOptions options_;
  FirmwareVersion firmware_;
  std::vector<double> motionCurrentA_, gripCurrentA_, holdCurrentA_;
  std::vector<double> minDeg_, maxDeg_, offsetDeg_;
  std::vector<double> referenceKind_, saved_;
  std::vector<std::vector<double>> gain_, pid_;  // per axis
  unsigned grip_ = 1;                            // selected by selgrip
};

}  // namespace palpate
