// The native recording `*.palpate`: one SQLite 3 file (docs/palpate_format.md). What writer, reader
// and recovery agree on: names, codings, checksums, the bytes of a block.
//
// A block holds consecutive items of one stream. Its data, per item, little-endian:
//   u32 host time offset from the block's t0_us [us] | i64 device time [ms] | values
// Device time INT64_MIN: none.
// Values of a frame: run-length coded (model/frame_coding.h); of angles and temperatures: one
// number each, f32 where that is exact, else f64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <palpate/model/profile.h>

namespace palpate {

constexpr std::int32_t kPalpateApplicationId = 0x50414C50;  // "PALP"
constexpr std::int32_t kPalpateVersion = 1;                 // user_version
// of data: a block then never overflows its 4096-byte page
constexpr std::size_t kMaxBlockBytes = 4000;

// Bounds of what is read, so that a hostile file costs little.
constexpr std::size_t kMaxMatrices = 64;
constexpr std::size_t kMaxPlaces = 65'536;    // of all matrices
constexpr std::size_t kMaxSampleValues = 64;  // axes or temperature sensors

enum class Stream : std::uint8_t { kTactile = 0, kAngles = 1, kTemperatures = 2 };

enum class BlockCoding : std::uint8_t {
  kCountsRuns = 0,  // u16 units run << 12 | value
  kFloatRuns = 1,   // pairs (u8 run, f32 value)
  kPlainF32 = 2,
  kPlainF64 = 3,
  // a bit per value (it counts as active), then as kFloatRuns (frame_coding.h, kFiltered)
  kFilteredRuns = 4,
};

struct Block {
  Stream stream = Stream::kTactile;
  std::int64_t first = 0;  // index of the first item in its stream
  std::int64_t n = 0;      // items
  std::int64_t t0Us = 0;   // host time of the first item [us since 1970]
  std::int64_t t1Us = 0;   // of the last item
  BlockCoding coding = BlockCoding::kCountsRuns;
  std::vector<std::byte> data;
};

// zlib's CRC-32 over stream, first, n, t0_us, t1_us, coding as little-endian i64, then data.
std::uint32_t blockCrc(const Block& block);
// Of other rows: their columns in order; integers as little-endian i64, reals as f64, texts and
// blobs as their bytes behind their length as i64, NULL as nothing.
class RowCrc {
 public:
  RowCrc& integer(std::int64_t value);
  RowCrc& real(double value);
  RowCrc& text(std::string_view value);
  std::uint32_t value() const noexcept { return crc_; }

 private:
  std::uint32_t crc_ = 0;
};

}  // namespace palpate
