// Finds the replies of the SDH-2's motion controller in its stream of bytes, where lines and binary
// records are mixed. A byte with the top bit set begins a record, everything else is text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include <palpate/device/sdh_protocol.h>

namespace palpate {

using SdhReply = std::variant<SdhLine, SdhRecord>;

// Counts since construction. Every byte pushed is in a line, in a record, skipped, or still
// pending.
struct SdhReplyStats {
  std::uint64_t lines = 0;
  std::uint64_t records = 0;
  std::uint64_t lineBytes = 0;     // with their CR LF
  std::uint64_t recordBytes = 0;   // of accepted records
  std::uint64_t skippedBytes = 0;  // noise, blank lines, lines beyond 254 characters
  std::uint64_t badChecksums = 0;  // records with a wrong checksum
};

// Push parser; one per port thread. Never throws on bad input: after an invalid record the search
// restarts one byte later.
class SdhReplyParser {
 public:
  using Sink = std::function<void(SdhReply&&)>;
  explicit SdhReplyParser(bool checksum) : checksum_(checksum) {}
  // Consumes all of `bytes`; calls `sink` once per reply, in order, before returning.
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Discards an incomplete reply (counted as skipped).
  void reset();
  // Size of an incomplete reply [bytes]; never more than 254.
  std::size_t pendingBytes() const noexcept { return pending_.size(); }
  const SdhReplyStats& stats() const noexcept { return stats_; }

 private:
  // Returns the number of bytes consumed at the start of `in`; 0 when more bytes are needed.
  std::size_t takeRecord(std::span<const std::byte> in, const Sink& sink);
  std::size_t takeLine(std::span<const std::byte> in, const Sink& sink);

  bool checksum_;
  // True while the rest of a line beyond the limit is skipped.
  bool tooLong_ = false;
  SdhReplyStats stats_;
  std::vector<std::byte> pending_;
};

}  // namespace palpate
