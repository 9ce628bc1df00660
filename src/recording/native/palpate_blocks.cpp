// Blocks and checksums of a native recording: palpate_blocks.h and palpate_schema.h.
#include "palpate/recording/palpate_blocks.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <zlib.h>

#include "palpate/core/byte_order.h"
#include "palpate/core/byte_reader.h"
#include "palpate/core/time.h"
#include "palpate/model/frame_coding.h"
#include "palpate/recording/palpate_schema.h"

namespace palpate {
namespace {

std::uint32_t crcOf(std::uint32_t crc, const void* bytes, std::size_t size) {
  if (size == 0) return crc;  // zlib would start over for a null pointer
  return static_cast<std::uint32_t>(crc32_z(crc, static_cast<const unsigned char*>(bytes), size));
}

std::uint32_t crcOfNumber(std::uint32_t crc, std::uint64_t value) {
  std::string bytes;  // short enough for no allocation
  appendLittleEndian(bytes, value, 8);
  return crcOf(crc, bytes.data(), bytes.size());
}

constexpr std::int64_t kNoDeviceTime = std::numeric_limits<std::int64_t>::min();
constexpr std::size_t kItemHeadBytes = 4 + 8;
constexpr std::int64_t kLargestOffsetUs = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kLongestItem = kItemHeadBytes + 8 * kMaxPlaces;
constexpr std::int64_t kMaxItems = kMaxBlockBytes / kItemHeadBytes;
constexpr std::int64_t kLatestUs = std::int64_t{1} << 60;  // the year 38505

bool exactAsFloat(double value) { return static_cast<double>(static_cast<float>(value)) == value; }

// Values of series beside those of the hand may be missing (NaN).
bool allFinite(std::span<const std::byte> bytes,
               BlockCoding coding,
               std::size_t numValues,
               bool mayMiss) {
  if (coding == BlockCoding::kFilteredRuns)
    return allFinite(
        bytes.subspan(activeBytes(numValues)), BlockCoding::kFloatRuns, numValues, mayMiss);
  ByteReader in(bytes);
  bool finite = true;
  while (finite && in.remaining() > 0) {
    if (coding == BlockCoding::kFloatRuns) in.u8();
    const double value =
        coding == BlockCoding::kPlainF64 ? in.f64() : static_cast<double>(in.f32());
    finite = std::isfinite(value) || (mayMiss && std::isnan(value));
  }
  return finite && in.ok();
}

FrameCoding frameCoding(BlockCoding coding) {
  if (coding == BlockCoding::kFilteredRuns) return FrameCoding::kFiltered;
  return coding == BlockCoding::kCountsRuns ? FrameCoding::kCounts : FrameCoding::kFloats;
}

}  // namespace

RowCrc& RowCrc::integer(std::int64_t value) {
  crc_ = crcOfNumber(crc_, static_cast<std::uint64_t>(value));
  return *this;
}

RowCrc& RowCrc::real(double value) {
  crc_ = crcOfNumber(crc_, std::bit_cast<std::uint64_t>(value));
  return *this;
}

RowCrc& RowCrc::text(std::string_view value) {
  integer(static_cast<std::int64_t>(value.size()));
  crc_ = crcOf(crc_, value.data(), value.size());
  return *this;
}

std::uint32_t blockCrc(const Block& block) {
  const std::uint32_t head = RowCrc()
                                 .integer(static_cast<std::int64_t>(block.stream))
                                 .integer(block.first)
                                 .integer(block.n)
                                 .integer(block.t0Us)
                                 .integer(block.t1Us)
                                 .integer(static_cast<std::int64_t>(block.coding))
                                 .value();
  return crcOf(head, block.data.data(), block.data.size());
}

BlockPacker::BlockPacker(Stream stream, Sink sink) : stream_(stream), sink_(std::move(sink)) {}

void BlockPacker::addFrame(std::int64_t hostUs,
                           std::optional<std::int64_t> deviceUs,
                           std::span<const float> values) {
  const FrameCoding coding = codingFor(values);
  item_.clear();
  encodeFrame(values, coding, item_);
  // Values that don't repeat are shorter as they are than as runs of one.
  if (coding == FrameCoding::kFloats && item_.size() > 4 * values.size()) {
    item_.clear();
    for (float value : values) appendLittleEndian(item_, std::bit_cast<std::uint32_t>(value), 4);
    add(hostUs, deviceUs, BlockCoding::kPlainF32);
  } else {
    add(hostUs,
        deviceUs,
        coding == FrameCoding::kCounts ? BlockCoding::kCountsRuns : BlockCoding::kFloatRuns);
  }
}

void BlockPacker::addFrame(const TactileFrame& frame) {
  if (!frame.readings.empty() || frame.filtered.empty())
    return addFrame(frame.hostUs, frame.deviceUs, frame.stored());
  item_.clear();
  encodeFrame(frame, FrameCoding::kFiltered, item_);
  add(frame.hostUs, frame.deviceUs, BlockCoding::kFilteredRuns);
}

void BlockPacker::addSample(std::int64_t hostUs,
                            std::span<const double> values,
                            std::optional<std::int64_t> deviceUs) {
  bool single = true;
  for (double value : values) single = single && (std::isnan(value) || exactAsFloat(value));
  item_.clear();
  for (double value : values) {
    if (single)
      appendLittleEndian(item_, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    else
      appendLittleEndian(item_, std::bit_cast<std::uint64_t>(value), 8);
  }
  add(hostUs, deviceUs, single ? BlockCoding::kPlainF32 : BlockCoding::kPlainF64);
}

void BlockPacker::add(std::int64_t hostUs,
                      std::optional<std::int64_t> deviceUs,
                      BlockCoding coding) {
  deviceUs_ = deviceUs_ || (deviceUs && *deviceUs % kUsPerMs != 0);
  if (deviceUs_) coding = withDeviceUs(coding);
  const std::int64_t device =
      deviceUs ? (deviceUs_ ? *deviceUs : *deviceUs / kUsPerMs) : kNoDeviceTime;
  const bool fits = block_.data.size() + kItemHeadBytes + item_.size() <= kMaxBlockBytes;
  if (block_.n > 0 && (!fits || coding != block_.coding || hostUs - block_.t0Us > kLargestOffsetUs))
    flush();
  if (block_.n == 0) {
    block_.stream = stream_;
    block_.first = numItems_;
    block_.t0Us = hostUs;
    block_.coding = coding;
  }
  appendLittleEndian(block_.data, static_cast<std::uint64_t>(hostUs - block_.t0Us), 4);
  appendLittleEndian(block_.data, static_cast<std::uint64_t>(device), 8);
  block_.data.insert(block_.data.end(), item_.begin(), item_.end());
  block_.t1Us = hostUs;
  ++block_.n;
  ++numItems_;
}

void BlockPacker::flush() {
  if (block_.n == 0) return;
  sink_(block_);
  block_.n = 0;
  block_.data.clear();
}

bool plausible(const Block& block) noexcept {
  return static_cast<std::size_t>(block.stream) < kMaxStreams &&
         static_cast<int>(valueCoding(block.coding)) <= 4 && block.first >= 0 &&
         block.first <= std::numeric_limits<std::int64_t>::max() - kMaxItems && block.n >= 1 &&
         block.n <= kMaxItems && block.t0Us >= -kLatestUs && block.t1Us <= kLatestUs &&
         block.t1Us >= block.t0Us &&
         static_cast<std::size_t>(block.n) * kItemHeadBytes < block.data.size() &&
         block.data.size() <= (block.n == 1 ? kLongestItem : kMaxBlockBytes);
}

std::size_t sampleWidth(const Block& block) noexcept {
  if (!plausible(block)) return 0;
  const std::size_t perItem = block.data.size() / static_cast<std::size_t>(block.n);
  const std::size_t each = valueCoding(block.coding) == BlockCoding::kPlainF64 ? 8 : 4;
  const std::size_t width = (perItem - kItemHeadBytes) / each;
  return width <= kMaxSampleValues ? width : 0;
}

bool indexBlock(const Block& block, std::size_t numValues, BlockIndex& index) {
  index.hostUs.clear();
  index.deviceUs.clear();
  index.begin.clear();
  if (!plausible(block)) return false;
  const std::span<const std::byte> bytes(block.data);
  const BlockCoding coding = valueCoding(block.coding);
  const bool inUs = hasDeviceUs(block.coding);
  const auto count = static_cast<std::size_t>(block.n);
  index.hostUs.reserve(count);
  index.deviceUs.reserve(count);
  index.begin.reserve(count);
  std::size_t at = 0;
  for (std::int64_t i = 0; i < block.n; ++i) {
    ByteReader head(bytes.subspan(at));
    const std::int64_t hostUs = block.t0Us + static_cast<std::int64_t>(head.u32());
    const std::int64_t device = head.i64();
    if (!head.ok()) return false;
    if (!index.hostUs.empty() && hostUs <= index.hostUs.back()) return false;
    at += kItemHeadBytes;
    index.hostUs.push_back(hostUs);
    index.deviceUs.push_back(device == kNoDeviceTime ? std::nullopt
                             : inUs                  ? std::optional(device)
                                                     : checkedUs(device));
    index.begin.push_back(static_cast<std::uint32_t>(at));
    std::size_t size = 0;
    switch (coding) {
      case BlockCoding::kCountsRuns:
      case BlockCoding::kFloatRuns:
      case BlockCoding::kFilteredRuns:
        if (block.stream != Stream::kTactile) return false;
        size = codedFrameBytes(bytes.subspan(at), frameCoding(coding), numValues);
        if (size == 0) return false;
        break;
      case BlockCoding::kPlainF32:
        size = 4 * numValues;
        break;
      case BlockCoding::kPlainF64:
        size = 8 * numValues;
        break;
    }
    if (size > bytes.size() - at) return false;
    if (coding != BlockCoding::kCountsRuns &&
        !allFinite(
            bytes.subspan(at, size), coding, numValues, block.stream > Stream::kTemperatures))
      return false;
    at += size;
  }
  return at == bytes.size() && index.hostUs.front() == block.t0Us &&
         index.hostUs.back() == block.t1Us;
}

void readFrameValues(const Block& block, std::uint32_t begin, TactileFrame& out) {
  const auto bytes = std::span(block.data).subspan(begin);
  const BlockCoding coding = valueCoding(block.coding);
  if (coding != BlockCoding::kPlainF32 && coding != BlockCoding::kPlainF64) {
    if (out.readings.empty())
      decodeFrame(bytes, frameCoding(coding), out);
    else
      decodeFrame(bytes, frameCoding(coding), std::span(out.readings));
    return;
  }
  out.filtered.clear();
  ByteReader in(bytes);
  const bool wide = coding == BlockCoding::kPlainF64;
  for (float& value : out.stored()) value = wide ? static_cast<float>(in.f64()) : in.f32();
}

void readSampleValues(const Block& block, std::uint32_t begin, std::span<double> values) {
  ByteReader in(std::span(block.data).subspan(begin));
  const bool wide = valueCoding(block.coding) == BlockCoding::kPlainF64;
  for (double& value : values) value = wide ? in.f64() : static_cast<double>(in.f32());
}

}  // namespace palpate
