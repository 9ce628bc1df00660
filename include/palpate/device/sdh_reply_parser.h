// Finds the replies of the SDH-2's motion controller in its stream of bytes: lines and binary
// records, mixed. A byte with the top bit set begins a record, everything else is text.
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
  std::uint64_t lineBytes = 0;     // with their ends
  std::uint64_t recordBytes = 0;   // of accepted records
  std::uint64_t skippedBytes = 0;  // noise, blank lines, lines beyond 254 characters
  std::uint64_t badChecksums = 0;  // records with a wrong checksum
};

// Push parser; one per port thread. Never throws on bad input: after a record that is none the
// search goes on one byte later.
class SdhReplyParser {
 public:
  using Sink = std::function<void(SdhReply&&)>;
  explicit SdhReplyParser(bool checksum) : checksum_(checksum) {}
  // Consumes all of `bytes`; calls `sink` once per reply, in order, before returning.
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Gives up what is incomplete (counted as skipped).
  void reset();
  // [bytes] of an incomplete reply; never more than 254.
  std::size_t pendingBytes() const noexcept { return pending_.size(); }
  const SdhReplyStats& stats() const noexcept { return stats_; }

 private:
  // Bytes consumed at the start of `in`; 0: wait for more.
  std::size_t takeRecord(std::span<const std::byte> in, const Sink& sink);
  std::size_t takeLine(std::span<const std::byte> in, const Sink& sink);

  bool checksum_;
  bool tooLong_ = false;  // in the rest of a line beyond the limit
  SdhReplyStats stats_;
  std::vector<std::byte> pending_;
};

}  // namespace palpate
