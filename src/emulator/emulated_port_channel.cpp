#include "emulator/emulated_port_channel.h"

#include <algorithm>

namespace palpate {
namespace {

// Limit of the bytes that wait for a slow client; messages beyond it are lost as a whole.
constexpr std::size_t kMaxPendingBytes = 1u << 16;
constexpr std::size_t kMaxPacedPendingBytes = 1u << 13;  // 0.7 s of line time
constexpr std::size_t kReadyBytes = 1u << 11;
constexpr std::size_t kReadBytes = 1u << 12;
constexpr std::size_t kBabbleBytes = 512;

}  // namespace

EmulatedPortChannel::EmulatedPortChannel(std::unique_ptr<PortServer> port,
                                         double byteUs,
                                         const Faults& faults,
                                         std::uint64_t seed)
    : port_(std::move(port)),
      paced_(byteUs > 0.0),
      line_(byteUs),
      faults_(faults, seed),
      seed_(seed),
      junkBytes_(faults.junkStartBytes) {}

void EmulatedPortChannel::setFaults(const Faults& faults) {
  faults_ = ByteFaults(faults, seed_ + ++faultSets_);
  junkBytes_ = faults.junkStartBytes;
}

bool EmulatedPortChannel::ready() const noexcept {
  return port_->connected() && !muted_ && !blocked_ && !cut() && line_.pendingBytes() < kReadyBytes;
}

std::span<const std::byte> EmulatedPortChannel::receive(std::int64_t nowUs, FaultCounts& counts) {
  input_.resize(kReadBytes);
  const std::size_t n = port_->read(input_);
  counts_.bytesReceived += n;
  if (n > 0 && junkBytes_ > 0) {
    // In chunks, as far as the line has room.
    while (junkBytes_ > 0) {
      const std::size_t piece = std::min(junkBytes_, kBabbleBytes);
      push({.bytes = faults_.junk(piece)}, nowUs, counts);
      junkBytes_ -= piece;
      counts.junkBytes += piece;
    }
  }
  return std::span(input_).first(n);
}

void EmulatedPortChannel::countLostBytes(const LineMessage& message) {
  counts_.bytesLost += message.bytes.size();
  ended_.push_back({message.frame, message.bytes.size(), message.damaged, true});
}

void EmulatedPortChannel::push(LineMessage message, std::int64_t atUs, FaultCounts& counts) {
  ++counts_.messages;
  if (muted_ || !port_->connected()) return countLostBytes(message);
  const std::size_t most = paced_ ? kMaxPacedPendingBytes : kMaxPendingBytes;
  if (line_.pendingBytes() + message.bytes.size() > most) return countLostBytes(message);
  faults_.apply(message, counts);
  if (message.bytes.empty()) return countLostBytes(message);
  line_.push(std::move(message), atUs);
}

void EmulatedPortChannel::flush(std::int64_t nowUs) {
  if (babble_ > 0 && line_.pendingBytes() == 0 && port_->connected()) {
    const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(babble_, kBabbleBytes));
    line_.push({.bytes = faults_.junk(piece)}, nowUs);
    babble_ -= piece;
  }
  write(nowUs);
  counts_.pending = line_.pendingBytes();
}

void EmulatedPortChannel::write(std::int64_t nowUs) {
  blocked_ = false;
  for (;;) {
    auto bytes = line_.due(nowUs);
    if (bytesUntilCut_) bytes = bytes.first(std::min<std::uint64_t>(bytes.size(), *bytesUntilCut_));
    if (bytes.empty()) return;
    const std::size_t taken = port_->write(bytes);
    counts_.bytesSent += taken;
    if (bytesUntilCut_) *bytesUntilCut_ -= taken;
    const std::size_t rest = bytes.size() - taken;
    line_.pass(taken, false, ended_);
    if (rest == 0) continue;
    if (!port_->connected()) {
      // The client has hung up.
      counts_.bytesLost += line_.pendingBytes();
      line_.clear(ended_);
      return;
    }
    // A serial line does not wait for a reader.
    if (paced_ && !port_->isNetwork()) {
      counts_.bytesLost += rest;
      line_.pass(rest, true, ended_);
      continue;
    }
    blocked_ = true;
    return;
  }
}

void EmulatedPortChannel::unplug() {
  counts_.bytesLost += line_.pendingBytes();
  line_.clear(ended_);
  counts_.pending = 0;
  blocked_ = false;
  bytesUntilCut_.reset();
  port_->unplug();
}

std::optional<std::int64_t> EmulatedPortChannel::nextDueUs() const {
  if (cut()) return std::nullopt;
  if (const auto due = line_.nextDueUs()) return due;
  if (babble_ > 0 && port_->connected()) return 0;
  return std::nullopt;
}

EmulatedPortCounts EmulatedPortChannel::counts() const noexcept { return counts_; }

}  // namespace palpate
