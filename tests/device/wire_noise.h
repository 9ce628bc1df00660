// Sends a stream of frames through a noisy line to parser, decoder and clock, and compares received
// with sent frames (reliability R6, R7).
#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <unordered_map>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/dsa_frame.h"
#include "palpate/device/dsa_packet.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "device/dsa_wire.h"

namespace palpate::testing {

// Probabilities per byte.
struct LineNoise {
  double flip = 0.0;
  double insert = 0.0;
  double remove = 0.0;
};

struct NoiseCount {
  std::uint64_t sent = 0;
  std::uint64_t intact = 0;  // frames whose bytes arrived unchanged and contiguous
  std::uint64_t corrupt = 0;
  std::uint64_t arrived = 0;  // received as they were sent
  std::uint64_t intactLost = 0;
  std::uint64_t wrong = 0;   // accepted, but never sent with this content
  std::uint64_t events = 0;  // insertions and deletions
  std::uint64_t bytes = 0;   // pushed
  DsaPacketStats stats;
  std::size_t pending = 0;
};

// Returns the number of bytes of the next read.
using ChunkSize = std::function<std::size_t()>;

class NoisyLine {
 public:
  NoisyLine(LineNoise noise, std::uint32_t seed, ChunkSize chunk)
      : noise_(noise), random_(seed), chunk_(std::move(chunk)) {}

  NoiseCount run(std::uint64_t frames) {
    std::uint32_t stampMs = 1000;
    for (std::uint64_t i = 0; i < frames; ++i) {
      stampMs += 28 + random_() % 8;
      nowUs_ = std::int64_t{stampMs} * 1000;
      send(framePayload(stampMs, graspCounts(random_), true), stampMs);
      if (waiting_.size() > 65'536) receive(false);
    }
    receive(true);
    parser_.flush(sink());
    if (held_) ++dropped_;
    for (const auto& [stamp, frame] : sentFrames_)
      if (frame.intact && !frame.arrived) ++count_.intactLost;
    count_.stats = parser_.stats();
    count_.pending = parser_.pendingBytes();
    return count_;
  }

 private:
  struct Sent {
    std::uint64_t fingerprint = 0;
    bool intact = true;
    bool arrived = false;
  };

  static std::uint64_t fingerprintOf(std::span<const std::byte> payload) {
    std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
    for (const std::byte b : payload)
      hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 1099511628211ull;
    return hash;
  }

  bool happens(double rate) { return rate > 0.0 && uniform_(random_) < rate; }

  void send(const Bytes& payload, std::uint32_t stampMs) {
    Sent& sent = sentFrames_[stampMs];
    sent.fingerprint = fingerprintOf(payload);
    ++count_.sent;
    const Bytes packet = wirePacket(0, payload);
    for (std::size_t i = 0; i < packet.size(); ++i) {
      if (happens(noise_.insert)) {
        waiting_.push_back(static_cast<std::byte>(random_() & 0xFFu));
        ++count_.events;
        sent.intact = sent.intact && i == 0;  // a byte inserted before the first one is harmless
      }
      if (happens(noise_.remove)) {
        ++count_.events;
        sent.intact = false;
        continue;
      }
      std::byte byte = packet[i];
      if (happens(noise_.flip)) {
        byte ^= static_cast<std::byte>(1 + random_() % 255);
        sent.intact = false;
      }
      waiting_.push_back(byte);
    }
    ++(sent.intact ? count_.intact : count_.corrupt);
  }

  void receive(bool all) {
    std::size_t at = 0;
    while (at < waiting_.size() && (all || waiting_.size() - at > 2048)) {
      const std::size_t n = std::min(chunk_(), waiting_.size() - at);
      parser_.push(std::span(waiting_).subspan(at, n), sink());
      count_.bytes += n;
      at += n;
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  DsaPacketParser::Sink sink() {
    return [this](const DsaPacket& packet) {
      if (packet.id != DsaId::kFrame) return;
      const auto frame = decodeDsaFrame(packet.payload, *sdh2().layout, true, counts_);
      if (!frame) return;
      const Seen seen{frame->stampMs, fingerprintOf(packet.payload)};
      switch (clock_.checkStamp(frame->stampMs, nowUs_)) {
        case DsaClock::FrameAcceptance::kHold:
          held_ = seen;
          return;
        case DsaClock::FrameAcceptance::kReplaceHeld:
          held_ = seen;
          return;
        case DsaClock::FrameAcceptance::kRestarted:
          accept(*held_);
          break;
        case DsaClock::FrameAcceptance::kDropHeld:
        case DsaClock::FrameAcceptance::kAccept:
          break;
      }
      held_.reset();
      accept(seen);
    };
  }

  struct Seen {
    std::uint32_t stampMs = 0;
    std::uint64_t fingerprint = 0;
  };

  void accept(const Seen& seen) {
    const auto sent = sentFrames_.find(seen.stampMs);
    if (sent == sentFrames_.end() || sent->second.fingerprint != seen.fingerprint ||
        sent->second.arrived) {
      ++count_.wrong;
      return;
    }
    sent->second.arrived = true;
    ++count_.arrived;
  }

  LineNoise noise_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  ChunkSize chunk_;
  DsaPacketParser parser_;
  DsaClock clock_;
  std::int64_t nowUs_ = 0;
  std::vector<float> counts_ = std::vector<float>(486);
  std::optional<Seen> held_;
  std::uint64_t dropped_ = 0;
  std::unordered_map<std::uint32_t, Sent> sentFrames_;
  Bytes waiting_;
  NoiseCount count_;
};

// Runs all three rates and kinds; checks the guarantees and prints the figures.
inline void expectNoiseIsSurvived(std::uint64_t frames) {
  for (const double rate : {1e-4, 1e-3, 1e-2}) {
    for (const bool slips : {false, true}) {
      std::mt19937 sizes(11);
      const LineNoise noise =
          slips ? LineNoise{rate / 3, rate / 3, rate / 3} : LineNoise{rate, 0, 0};
      NoisyLine line(noise, static_cast<std::uint32_t>(rate * 1e6) + (slips ? 1 : 0), [&] {
        return std::size_t{1} + sizes() % 600;
      });
      const NoiseCount count = line.run(frames);
      std::printf(
          "noise %g per byte%s: %llu frames, %llu corrupt, %llu intact ones lost, %llu wrong "
          "ones accepted, %llu insertions and deletions\n",
          rate,
          slips ? " (a third each flipped, inserted, deleted)" : "",
          static_cast<unsigned long long>(count.sent),
          static_cast<unsigned long long>(count.corrupt),
          static_cast<unsigned long long>(count.intactLost),
          static_cast<unsigned long long>(count.wrong),
          static_cast<unsigned long long>(count.events));
      EXPECT_EQ(count.stats.packetBytes + count.stats.skippedBytes + count.pending, count.bytes);
      EXPECT_GT(count.corrupt, 0u);
      EXPECT_LE(count.intactLost, slips ? count.events : 0u);
      EXPECT_LE(static_cast<double>(count.wrong), 5e-5 * static_cast<double>(count.corrupt) + 1.0);
    }
  }
}

}  // namespace palpate::testing
