// The SDH-2's motion controller as it looks from its line: text commands and binary records, mixed.
// Written from the protocol alone, without the driver's code. Knows neither line nor clock: the
// caller hands in bytes and times, and takes the messages.
//
// Text: `name`, `name(i)`, `name(i)=x`, `name=x0,..,x6`, ended by CR or LF or both; the answer is
// `NAME=..` CR LF, or `E` and an error number. Binary: cmd u8 (>= 0x80) | length u8 | count u8 (0
// or 7) | floats | checksum u16; the answer has always 34 bytes. One command at a time: what comes
// meanwhile waits (up to 4096 bytes, then it is lost). `grip`, `selgrip` and `ref` answer when the
// motion has ended and are deaf until then, to `stop` too.
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
  // Release; letters, digits, '.' and '-'. Commands that came later are unknown to it (rvel, con
  // 0.0.2.6; vlim 0.0.2.1; alim 0.0.2.7); before 0.0.3.1 lines that begin with @ precede some
  // answers.
  std::string firmware = "0.0.3.3";
  std::string firmwareDate = "2013-09-19";
  std::string soc = "2009-10-26-r1";
  std::string socDate = "2009-10-26";
  std::string id = "SDH-2";
  std::string serial = "48";
  // of binary records: on serial lines yes, over TCP no (records of 32 bytes)
  bool checksum = true;
  // time from a command to its answer, evenly between these two [us]
  double minResponseDelayUs = 0.0;
  double maxResponseDelayUs = 0.0;  // (a real one: 2000..3000)
  double requestByteUs = 0.0;       // line time of each byte of a request [us]
  double bootS = 0.0;               // deaf for so long after the start [s]
  std::uint64_t seed = 1;           // of the think times
};

class SdhCommandProcessor;

// Not thread-safe. Times [us] are the caller's, since the start of the hand, and never go back.
class SdhServer {
 public:
  // The model must outlive it. Throws std::invalid_argument for think times that are negative or in
  // the wrong order, or for a firmware that is no release.
  SdhServer(HandModel& model, const SdhServerOptions& options = {});
  ~SdhServer();

  // Bytes of the client.
  void receive(std::span<const std::byte> bytes, std::int64_t nowUs);
  // The client has been silent for a while: a binary record that isn't complete by now never will
  // be. Half a text line stays.
  void onReceiveTimeout();
  // Whether quiet() would change anything.
  bool hasPartialRequest() const noexcept;
  // Carries out what is due.
  void advance(std::int64_t nowUs);
  // When advance() has something to do again; nothing: not before the client speaks.
  std::optional<std::int64_t> nextUs() const;
  // The messages since the last call, in order.
  std::vector<LineMessage> take();

  // Switched off and on: axes without power where they are, deaf for `bootS`.
  void powerCycle(std::int64_t nowUs, double bootS);
  std::uint64_t lostBytes() const noexcept { return lostBytes_; }  // came while too much waited

 private:
  struct Command {
    std::vector<std::byte> record;  // binary; else empty
    std::string line;
    std::optional<unsigned> refusal;  // of what could not be read; carried out as an error
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
  std::optional<Pending> pending_;  // being thought about
  std::string answerAfterMotion_;   // of grip, selgrip, ref; empty: none runs
  std::int64_t motionCheckUs_ = 0;  // when to look whether it has ended
  std::int64_t motionEndsUs_ = 0;   // it ends at last
  bool discarding_ = false;         // garbage: until the line end, or until it is quiet
  bool tooLong_ = false;            // a line of more than 254 characters is running in
  std::int64_t nowUs_ = 0;
  std::int64_t bootEndUs_ = 0;
  std::uint64_t lostBytes_ = 0;
};

}  // namespace palpate
