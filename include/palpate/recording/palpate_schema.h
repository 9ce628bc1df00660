// The native recording `*.palpate`: one SQLite 3 file (docs/notes/palpate_format.md). What writer,
// reader and recovery agree on: names, codings, checksums, the bytes of a block.
//
// A block holds consecutive items of one stream: frames, or samples of one series. Its data is, per
// item and little-endian:
//   u32 host time offset from the block's t0_us [us] | i64 device time [ms or us] | values
// A device time of INT64_MIN stands for none. The values of a frame are run-length coded
// (model/frame_coding.h). The values of a sample are f32 where all of them are exact in it, f64
// otherwise.
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
// The user_version of a file that has blocks with device times in microseconds.
constexpr std::int32_t kPalpateVersionWithDeviceUs = 2;
// The user_version of a file with series besides those of the hand (table `series`), with taxels
// whose touch is decided when they are read (key `touch_rules` of the table `meta`), or with taxels
// that aren't square (`pitch_y_mm`).
constexpr std::int32_t kPalpateVersionWithSeries = 3;
// The most bytes of data in a block of several items. Its row then never overflows its 4096-byte
// page of SQLite, so that recovery finds it in the raw bytes of the page.
constexpr std::size_t kMaxBlockBytes = 4000;

// Bounds of what is read, so that a hostile file costs little time and memory.
constexpr std::size_t kMaxMatrices = 64;
constexpr std::size_t kMaxPlaces = 65'536;             // of all matrices together
constexpr std::size_t kMaxSampleValues = kMaxColumns;  // of a series
constexpr std::size_t kMaxStreams = 1 + kMaxSeries;

// What a block holds items of; the number stands in the file. 0 is the frames, others are series.
enum class Stream : std::uint8_t { kTactile = 0, kAngles = 1, kTemperatures = 2 };
constexpr Stream streamOfSeries(std::size_t series) noexcept {
  return static_cast<Stream>(series + 1);
}
constexpr std::size_t seriesOfStream(Stream stream) noexcept {
  return static_cast<std::size_t>(stream) - 1;
}

// How the values of a block are coded; the number stands in the file.
enum class BlockCoding : std::uint8_t {
  kCountsRuns = 0,  // u16 units run << 12 | value
  kFloatRuns = 1,   // pairs (u8 run, f32 value)
  kPlainF32 = 2,
  kPlainF64 = 3,
  // A bit per value that says whether the taxel counts as active, then as kFloatRuns
  // (frame_coding.h, kFiltered).
  kFilteredRuns = 4,
};
// Added to the number of a coding: the device times of the block are in microseconds, not in
// milliseconds.
constexpr std::uint8_t kDeviceUsCoding = 8;
constexpr bool hasDeviceUs(BlockCoding coding) noexcept {
  return (static_cast<std::uint8_t>(coding) & kDeviceUsCoding) != 0;
}
constexpr BlockCoding withDeviceUs(BlockCoding coding) noexcept {
  return static_cast<BlockCoding>(static_cast<std::uint8_t>(coding) | kDeviceUsCoding);
}
// How the values are coded, whatever the unit of the device times is.
constexpr BlockCoding valueCoding(BlockCoding coding) noexcept {
  return static_cast<BlockCoding>(static_cast<std::uint8_t>(coding) & ~kDeviceUsCoding);
}

// One row of the table `block`.
struct Block {
  Stream stream = Stream::kTactile;
  std::int64_t first = 0;  // index of the first item in its stream
  std::int64_t n = 0;      // number of items
  std::int64_t t0Us = 0;   // host time of the first item [us since 1970]
  std::int64_t t1Us = 0;   // host time of the last item [us since 1970]
  BlockCoding coding = BlockCoding::kCountsRuns;
  std::vector<std::byte> data;
};

// The checksum of a block: zlib's CRC-32 over stream, first, n, t0_us, t1_us and coding, each as a
// little-endian i64, then over the data.
std::uint32_t blockCrc(const Block& block);
// The checksum of any other row: zlib's CRC-32 over its columns in their order. Integers count as
// little-endian i64, reals as f64, texts and blobs as their length (i64) and then their bytes; a
// NULL counts as no bytes.
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
