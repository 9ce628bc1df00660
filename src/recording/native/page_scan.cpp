#include "recording/native/page_scan.h"

#include <array>
#include <optional>

#include "palpate/recording/palpate_blocks.h"

namespace palpate {
namespace {

// SQLite's record format (sqlite.org/fileformat2.html section 2.1): a header of varints (its own
// size, then a serial type per column), then the columns. A block row has nine: id (NULL, the
// rowid), six integers, crc32, data.
constexpr std::size_t kColumns = 9;
constexpr std::size_t kSmallestHeader = 1 + kColumns;
constexpr std::size_t kLargestHeader = kSmallestHeader + 2;  // the blob's type takes up to 3 bytes

class Cursor {
 public:
  Cursor(std::span<const std::byte> bytes, std::size_t at) : bytes_(bytes), at_(at) {}
  std::size_t at() const { return at_; }
  std::optional<std::uint64_t> varint() {
    std::uint64_t value = 0;
    for (int i = 0; i < 9; ++i) {
      if (at_ >= bytes_.size()) return std::nullopt;
      const auto byte = std::to_integer<std::uint64_t>(bytes_[at_++]);
      if (i == 8) return value << 8 | byte;
      value = value << 7 | (byte & 0x7F);
      if (byte < 0x80) return value;
    }
    return std::nullopt;
  }
  // A big-endian two's complement integer of a serial type 1..6, 8, 9.
  std::optional<std::int64_t> integer(std::uint64_t type) {
    constexpr std::array<std::size_t, 7> kSizes{0, 1, 2, 3, 4, 6, 8};
    if (type == 8 || type == 9) return static_cast<std::int64_t>(type - 8);
    if (type < 1 || type > 6) return std::nullopt;
    const std::size_t size = kSizes[type];
    if (size > bytes_.size() - at_) return std::nullopt;
    std::uint64_t value = (std::to_integer<unsigned>(bytes_[at_]) & 0x80) != 0 ? ~0ULL : 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | std::to_integer<std::uint64_t>(bytes_[at_ + i]);
    at_ += size;
    return static_cast<std::int64_t>(value);
  }
  std::span<const std::byte> take(std::size_t count) {
    if (count > bytes_.size() - at_) return {};
    const auto taken = bytes_.subspan(at_, count);
    at_ += count;
    return taken;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_;
};

std::optional<Block> blockAt(std::span<const std::byte> page, std::size_t at) {
  const auto headerSize = std::to_integer<std::size_t>(page[at]);
  if (headerSize < kSmallestHeader || headerSize > kLargestHeader ||
      headerSize > page.size() - at || page[at + 1] != std::byte{0})
    return std::nullopt;
  Cursor types(page, at + 2);
  std::array<std::uint64_t, kColumns> type{};
  for (std::size_t column = 1; column < kColumns; ++column) {
    const auto value = types.varint();
    if (!value) return std::nullopt;
    type[column] = *value;
  }
  const std::uint64_t blobType = type[kColumns - 1];
  if (types.at() != at + headerSize || blobType < 12 || blobType % 2 != 0) return std::nullopt;
  Cursor body(page, at + headerSize);
  std::array<std::int64_t, kColumns> value{};
  for (std::size_t column = 1; column + 1 < kColumns; ++column) {
    const auto integer = body.integer(type[column]);
    if (!integer) return std::nullopt;
    value[column] = *integer;
  }
  const std::size_t size = (blobType - 12) / 2;
  const auto data = body.take(size);
  if (data.size() != size || value[1] < 0 || value[1] > 2 || value[6] < 0 || value[6] > 3)
    return std::nullopt;
  Block block{static_cast<Stream>(value[1]),
              value[2],
              value[3],
              value[4],
              value[5],
              static_cast<BlockCoding>(value[6]),
              {data.begin(), data.end()}};
  if (!plausible(block) || value[7] != static_cast<std::int64_t>(blockCrc(block)))
    return std::nullopt;
  return block;
}

}  // namespace

void scanPage(std::span<const std::byte> page, const std::function<void(Block)>& found) {
  for (std::size_t at = 0; at + kSmallestHeader < page.size(); ++at)
    if (auto block = blockAt(page, at)) found(std::move(*block));
}

}  // namespace palpate
