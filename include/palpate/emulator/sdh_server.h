// Emulates the protocol side of the SDH-2's motion controller: text commands and binary records,
// mixed. EmulatedHand connects it to a port. It is written from the protocol alone, without the
// driver's code. It knows neither port nor clock: the caller passes bytes and times, and collects
// the messages.
//
// Text: `name`, `name(i)`, `name(i)=x`, `name=x0,..,x6`, ended by CR or LF or both; the answer is
// `NAME=..` CR LF, or `E` and an error number. Binary: cmd u8 (>= 0x80) | length u8 | count u8 (0
// or 7) | floats | checksum u16; the answer always has 34 bytes. One command is executed at a time:
// later input waits (up to 4096 bytes, the rest is lost). `grip`, `selgrip` and `ref` answer when
// their motion has ended, and the controller ignores all input until then, including `stop`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/emulator/paced_line.h>

namespace palpate {

struct SdhServerOptions {
  // Release; letters, digits, '.' and '-'. Commands introduced later are unknown to it (rvel, con
  // 0.0.2.6; vlim 0.0.2.1; alim 0.0.2.7); before 0.0.3.1 lines that begin with @ precede some
  // answers.
  std::string firmware = "0.0.3.3";
  std::string firmwareDate = "2013-09-19";
  std::string soc = "2009-10-26-r1";
  std::string socDate = "2009-10-26";
  std::string id = "SDH-2";
  std::string serial = "48";
  // Whether binary records have a checksum: on serial lines yes, over TCP no (records of 32 bytes).
  bool checksum = true;
  // Time from a command to its answer, uniformly distributed between these two [us].
  double minResponseDelayUs = 0.0;
  double maxResponseDelayUs = 0.0;  // a real controller: 2000..3000
  double requestByteUs = 0.0;       // line time of each byte of a request [us]
  // Time after the start in which the controller ignores all input [s].
  double bootS = 0.0;
  std::uint64_t seed = 1;  // seed of the response delays
};

class SdhCommandProcessor;

// Not thread-safe. Times [us] are the caller's, counted from the start of the hand, and never
// decrease.
class SdhServer {
 public:
  // The model must outlive the server. Throws std::invalid_argument for response delays that are
  // negative or in the wrong order, or for a firmware that is no release.
  SdhServer(HandModel& model, const SdhServerOptions& options = {});
  ~SdhServer();

  // Processes bytes from the client.
  void receive(std::span<const std::byte> bytes, std::int64_t nowUs);
  // Call this when the client has been silent for a while: discards an incomplete binary record. An
  // incomplete text line is kept.
  void onReceiveTimeout();
  // True if onReceiveTimeout() would discard something.
  bool hasPartialRequest() const noexcept;
  // Executes the commands that are due.
  void advance(std::int64_t nowUs);
  // Next time at which advance() has something to do; empty when it only waits for the client.
  std::optional<std::int64_t> nextUs() const;
  // Returns the messages since the last call, in order.
  std::vector<LineMessage> take();

  // Switches the controller off and on: the axes keep their angles without power, and it ignores
  // all input for `bootS`.
  void powerCycle(std::int64_t nowUs, double bootS);
  // Number of bytes that arrived while the input buffer was full.
  std::uint64_t lostBytes() const noexcept { return lostBytes_; }

 private:
  struct Command {
    std::vector<std::byte> record;  // a binary command; else empty
    std::string line;
    // Error number for input that could not be parsed; executed as an error.
    std::optional<unsigned> refusal;
  };
  struct Pending {
    Command command;
    std::int64_t dueUs = 0;
  };
  std::optional<Command> next();
  std::optional<Command> nextRecord();
  std::optional<Command> nextLine();
  void start(Command command);
  void execute(const Command& command);
  void executeRecord(std::span<const std::byte> record);
  void executeLine(const std::string& line);
  void endMotion();
  void sendText(const std::string& text);
  void sendRecord(unsigned command, unsigned status, const std::vector<double>& values);
  std::size_t recordBytes(bool set) const noexcept;

  HandModel& model_;
  SdhServerOptions options_;
  std::unique_ptr<SdhCommandProcessor> motion_;
  std::mt19937_64 random_;
  std::deque<std::byte> input_;
  std::vector<LineMessage> output_;
  std::optional<Pending> pending_;  // waits for its response delay
  // Answer of grip, selgrip or ref; empty when none runs.
  std::string answerAfterMotion_;
  std::int64_t motionCheckUs_ = 0;  // time of the next check whether the motion has ended
  std::int64_t motionEndsUs_ = 0;   // latest time at which the motion ends
  // Skips invalid input until the end of the line or until the client is silent.
  bool discarding_ = false;
  // True while a line of more than 254 characters arrives.
  bool tooLong_ = false;
  std::int64_t nowUs_ = 0;
  std::int64_t bootEndUs_ = 0;
  std::uint64_t lostBytes_ = 0;
};

}  // namespace palpate
