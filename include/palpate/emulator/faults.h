// Fault injection for the emulated hand: wrong checksums, lost or inserted bytes, silence,
// disconnection, random bytes at the start, a slow boot. The same seed gives the same faults in the
// same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

#include <palpate/emulator/paced_line.h>

namespace palpate {

struct Outage {
  double atS = 0.0;        // when it begins, since the faults were set [s of the hand's time]
  double durationS = 0.0;  // [s]
  bool operator==(const Outage&) const = default;
};

struct Faults {
  double crcRate = 0.0;              // share of packets whose checksum is changed, 0..1
  double dropRate = 0.0;             // share of bytes that vanish, 0..1
  double insertRate = 0.0;           // per byte: a random byte more behind it, 0..1
  std::vector<Outage> stalls = {};   // the controllers neither listen nor speak
  std::vector<Outage> unplugs = {};  // both plugs are pulled
  std::size_t junkStartBytes = 0;    // random bytes ahead of a port's first answer, 0..1e9
  // the hand has just been switched on and takes so long to boot [s]
  std::optional<double> bootS = {};
  bool operator==(const Faults&) const = default;
};

// "crc=0.01,drop=1e-4,insert=1e-4,stall=2@10,unplug=1@20,junk_start=500,boot=8", each optional,
// stall and unplug more than once; empty: no faults. Throws std::invalid_argument that names the
// word and what it should be.
Faults parseFaults(std::string_view text);

struct FaultCounts {
  std::uint64_t spoiltChecksums = 0;  // messages
  std::uint64_t droppedBytes = 0;
  std::uint64_t insertedBytes = 0;
  std::uint64_t damagedFrames = 0;  // tactile frames hit by any of the three
  std::uint64_t junkBytes = 0;
  std::uint64_t stalls = 0;
  std::uint64_t unplugs = 0;
};

// What a bad cable does to the messages of one port.
class ByteFaults {
 public:
  // Throws std::invalid_argument for a rate outside 0..1.
  ByteFaults(const Faults& faults, std::uint64_t seed);
  // Changes the message as the rates say, marks it as damaged and counts. A byte inserted behind
  // the last one leaves the message whole.
  void apply(LineMessage& message, FaultCounts& counts);
  // Random bytes.
  std::vector<std::byte> junk(std::size_t count);

 private:
  std::uint64_t untilNext(double rate);

  double crcRate_, dropRate_, insertRate_;
  std::mt19937_64 random_;
  std::uint64_t untilDrop_ = 0;  // bytes that pass before the next one vanishes
  // Number of bytes until the next one is followed by a random byte.
  std::uint64_t untilInsert_ = 0;
};

}  // namespace palpate
