// Reads a stream of text lines: numbers separated by commas, semicolons or white space, one line
// per frame, or JSON objects as `palpate stream` sends them. docs/stream_protocol.md specifies
// both.
//
// The numbers of a line are read without an allocation; JSON objects take several.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/device/stream_shape.h>

namespace palpate {
class Json;

// The time at the beginning of a line.
enum class StreamTime {
  // A time is there if the line has exactly one number more than the item has values. It is in
  // seconds when it is written with a decimal point or an exponent, otherwise in milliseconds.
  kAuto,
  kNone,
  kSeconds,
  kMilliseconds,
  kMicroseconds,
};

struct StreamLineOptions {
  StreamTime time = StreamTime::kAuto;
  bool acceptNumbers = true;  // lines of numbers
  bool acceptJson = true;     // lines that begin with '{'
  // True when the first line may lack its beginning, as on a serial port whose sender is running.
  // It is not used then, because a number could lack its first digits.
  bool startsInside = false;
};

// Every byte that was pushed is in exactly one of lineBytes, skippedBytes and pendingBytes().
struct StreamLineStats {
  std::uint64_t lines = 0;  // complete lines, also empty ones and comments
  std::uint64_t items = 0;  // handed to the sink
  // Lines with another content than an item, empty lines and comments.
  std::uint64_t refused = 0;
  std::uint64_t lineBytes = 0;  // bytes of complete lines, with their line ends
  // Bytes of lines that are too long, or that lack their beginning.
  std::uint64_t skippedBytes = 0;
};

// Not thread-safe. Never throws for bad input: a bad line is counted, and lastFault() names it.
class StreamLineParser {
 public:
  using Sink = std::function<void(const StreamItem&)>;
  explicit StreamLineParser(StreamShape shape, const StreamLineOptions& options = {});

  // Consumes all bytes; calls `sink` once for each item, in order.
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Takes what is pending as a line, at the end of a datagram or of the input.
  void endLine(const Sink& sink);
  const StreamLineStats& stats() const noexcept { return stats_; }
  std::size_t pendingBytes() const noexcept { return pending_.size(); }
  // What is wrong with the last refused line, and which it is: "line 812: 255 numbers instead of
  // 256". Lines are counted from 1. Empty when none was refused.
  const std::string& lastFault() const noexcept { return lastFault_; }
  // Longest line that is read [bytes], enough for the hand's values with 25 characters each.
  std::size_t longestLine() const noexcept { return longestLine_; }

 private:
  struct Head;
  void takeLine(std::string_view line, const Sink& sink);
  void readNumbers(std::string_view line, const Sink& sink);
  void readJson(std::string_view line, const Sink& sink);
  std::optional<StreamItem> readJsonFrame(const Json& object);
  void dropPart();
  bool readHead(std::string_view line, Head& head);
  std::size_t readValues(const char* at, const char* end, bool& failed);
  void deliver(const Head& head, std::size_t count, const Sink& sink);
  void refuse(const std::string& why) { refuse(stats_.lines, why); }
  void refuse(std::uint64_t line, const std::string& why);

  StreamShape shape_;
  StreamLineOptions options_;
  std::size_t longestLine_;
  StreamLineStats stats_;
  std::string lastFault_;
  std::string pending_;           // a line without its end yet; never longer than longestLine_
  bool skipping_ = false;         // until the end of a line that is not used
  std::vector<double> numbers_;   // of the present line, as many as an item has at most
  std::string_view firstNumber_;  // as it was written
  std::vector<float> values_;
  // A frame of which only some matrices came yet.
  std::size_t numPartMatrices_ = 0;  // 0: none
  std::optional<std::uint32_t> partSequence_;
  std::vector<bool> partSeen_;  // per matrix
  std::vector<float> partValues_;
  // Whether signals of a frame were read: further parts of them hold nothing to show.
  bool readsSignals_ = false;
};

}  // namespace palpate
