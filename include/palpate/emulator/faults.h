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
  // Begin since the faults were set [s of the hand's time].
  double atS = 0.0;
  double durationS = 0.0;  // [s]
  bool operator==(const Outage&) const = default;
};

struct Faults {
  double crcRate = 0.0;             // fraction of packets whose checksum is changed, 0..1
  double dropRate = 0.0;            // fraction of bytes that are dropped, 0..1
  double insertRate = 0.0;          // probability per byte of a random byte inserted after it, 0..1
  std::vector<Outage> stalls = {};  // the controllers neither receive nor send
  std::vector<Outage> unplugs = {};  // both ports are disconnected
  std::size_t junkStartBytes = 0;    // random bytes before a port's first answer, 0..1e9
  // If set, the hand has just been switched on and takes this time to boot [s].
  std::optional<double> bootS = {};
  bool operator==(const Faults&) const = default;
};

// Parses "crc=0.01,drop=1e-4,insert=1e-4,stall=2@10,unplug=1@20,junk_start=500,boot=8". Each item
// is optional; stall and unplug (duration@begin) may be repeated; an empty text means no faults.
// Throws std::invalid_argument that names the wrong item and its correct form.
Faults parseFaults(std::string_view text);

struct FaultCounts {
  std::uint64_t spoiltChecksums = 0;  // messages with a changed checksum
  std::uint64_t droppedBytes = 0;
  std::uint64_t insertedBytes = 0;
  std::uint64_t damagedFrames = 0;  // tactile frames changed by any of the three
  std::uint64_t junkBytes = 0;
  std::uint64_t stalls = 0;
  std::uint64_t unplugs = 0;
};

// Applies the faults of a bad cable to the messages of one port.
class ByteFaults {
 public:
  // Throws std::invalid_argument for a rate outside 0..1.
  ByteFaults(const Faults& faults, std::uint64_t seed);
  // Changes the message according to the rates, marks it as damaged and counts the faults. A byte
  // inserted behind the last one does not damage the message.
  void apply(LineMessage& message, FaultCounts& counts);
  // Returns `count` random bytes.
  std::vector<std::byte> junk(std::size_t count);

 private:
  std::uint64_t untilNext(double rate);

  double crcRate_, dropRate_, insertRate_;
  std::mt19937_64 random_;
  std::uint64_t untilDrop_ = 0;  // bytes until the next one is dropped
  // Number of bytes until the next one is followed by a random byte.
  std::uint64_t untilInsert_ = 0;
};

}  // namespace palpate
