// Splits the bytes of a sender into lines, in bounded memory: those of frames and those of series.
//
// "\n", "\r", "\r\n", "\n\r" and "\r\r\n" end one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace palpate {

// Every byte that was pushed is in exactly one of lineBytes, skippedBytes and pendingBytes().
struct LineCounts {
  std::uint64_t lines = 0;  // that have ended, also empty and skipped ones
  std::uint64_t lineBytes = 0;
  std::uint64_t skippedBytes = 0;  // of lines that are too long, or that lack their beginning
};

struct SplitLine {
  enum class Kind {
    kWhole,
    kTooLong,  // as soon as it is; what follows up to its end is skipped
    kCutOff,   // the last one has no end: digits may be missing
  };
  Kind kind = Kind::kWhole;
  std::uint64_t number = 0;    // from 1
  std::string_view text = {};  // of a whole line, without its end; valid during the call
};

// Not thread-safe.
class LineSplitter {
 public:
  using Take = std::function<void(const SplitLine&)>;
  // `longest` [bytes], without the end of the line.
  explicit LineSplitter(std::size_t longest, bool skipsFirst = false)
      : longest_(longest), skipping_(skipsFirst) {}

  // Consumes all bytes; calls `take` once for each line, in order.
  void push(std::span<const std::byte> bytes, const Take& take);
  // Takes what is pending as a line, at the end of a datagram or of the input.
  void endLine(const Take& take);
  // The same where more may have followed, at the end of a connection. A line is whole without its
  // end if a closing bracket ends it (an object, a list), if it is a comment, and if it has zeros.
  void cutOff(const Take& take);
  // Forgets what is pending; the counts go on.
  void restart();

  const LineCounts& counts() const noexcept { return counts_; }
  std::size_t pendingBytes() const noexcept { return pending_.size(); }
  std::size_t longest() const noexcept { return longest_; }

 private:
  bool continuesEnd(char c, const Take& take);
  void takePiece(std::string_view piece, bool ended, const Take& take);
  void hand(std::string_view line, const Take& take);
  void handPending(const Take& take);
  void endHeldReturn(const Take& take);

  std::size_t longest_;
  bool skipping_;  // until the end of a line that is not used
  LineCounts counts_;
  std::string pending_;      // a line without its end yet; never longer than longest_
  std::string line_;         // the one that is handed out
  char lastEnd_ = '\0';      // '\n' or '\r' directly before, of which no pair was made yet
  bool heldReturn_ = false;  // a second '\r' came, which may belong to "\r\r\n"
};

}  // namespace palpate
