#include "palpate/emulator/paced_line.h"

#include <algorithm>
#include <cmath>

namespace palpate {
namespace {

constexpr std::size_t kPieceBytes = 64;

// The chunks of one message have equal sizes, so that none is very short.
std::size_t pieceEnd(std::size_t bytes, std::size_t passed) {
  const std::size_t pieces = (bytes + kPieceBytes - 1) / kPieceBytes;
  std::size_t piece = passed * pieces / bytes;
  while (bytes * piece / pieces <= passed) ++piece;
  return bytes * piece / pieces;
}

}  // namespace

void PacedLine::push(LineMessage message, std::int64_t atUs) {
  if (message.bytes.empty()) return;
  Entry entry;
  entry.message = {message.frame, message.bytes.size(), message.damaged, false};
  entry.startUs = std::max(static_cast<double>(atUs), freeAtUs_);
  if (byteUs_ > 0.0)
    freeAtUs_ = entry.startUs + byteUs_ * static_cast<double>(message.bytes.size());
  entries_.push_back(entry);
  if (head_ == buffer_.size()) {
    buffer_.clear();
    head_ = 0;
  }
  buffer_.insert(buffer_.end(), message.bytes.begin(), message.bytes.end());
}

std::int64_t PacedLine::freeAtUs() const noexcept {
  return static_cast<std::int64_t>(std::ceil(freeAtUs_));
}

double PacedLine::leftUs(const Entry& entry, std::size_t bytes) const {
  return entry.startUs + byteUs_ * static_cast<double>(bytes);
}

std::optional<std::int64_t> PacedLine::nextDueUs() const {
  if (entries_.empty()) return std::nullopt;
  const Entry& first = entries_.front();
  if (byteUs_ <= 0.0) return static_cast<std::int64_t>(first.startUs);
  return static_cast<std::int64_t>(
      std::ceil(leftUs(first, pieceEnd(first.message.bytes, first.passed))));
}

std::span<const std::byte> PacedLine::due(std::int64_t nowUs) const {
  const auto pending = std::span(buffer_).subspan(head_);
  if (byteUs_ <= 0.0) return pending;
  std::size_t count = 0;
  for (const Entry& entry : entries_) {
    std::size_t passed = entry.passed;
    while (passed < entry.message.bytes) {
      const std::size_t end = pieceEnd(entry.message.bytes, passed);
      if (std::ceil(leftUs(entry, end)) > static_cast<double>(nowUs))
        return pending.first(count + passed - entry.passed);
      passed = end;
    }
    count += passed - entry.passed;
  }
  return pending.first(count);
}

void PacedLine::pass(std::size_t count, bool lost, std::vector<SentMessage>& ended) {
  count = std::min(count, pendingBytes());
  head_ += count;
  while (count > 0) {
    Entry& first = entries_.front();
    const std::size_t here = std::min(count, first.message.bytes - first.passed);
    first.passed += here;
    first.message.lost = first.message.lost || lost;
    count -= here;
    if (first.passed < first.message.bytes) break;
    ended.push_back(first.message);
    entries_.pop_front();
  }
  constexpr std::size_t kCompactBytes = 1u << 16;
  if (head_ >= kCompactBytes) {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(head_));
    head_ = 0;
  }
}

void PacedLine::clear(std::vector<SentMessage>& ended) {
  pass(pendingBytes(), true, ended);
  freeAtUs_ = 0.0;
}

}  // namespace palpate
