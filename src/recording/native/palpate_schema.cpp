#include "palpate/recording/palpate_schema.h"

#include <array>
#include <bit>
#include <cstring>

#include <zlib.h>

namespace palpate {
namespace {

std::array<unsigned char, 8> palpateSchemaLittle(std::uint64_t value) {
  std::array<unsigned char, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<unsigned char>(value >> 8 * i);
  return bytes;
}

std::uint32_t crcOf(std::uint32_t crc, const void* bytes, std::size_t size) {
  if (size == 0) return crc;  // zlib would start over for a null pointer
  return static_cast<std::uint32_t>(crc32_z(crc, static_cast<const unsigned char*>(bytes), size));
}

}  // namespace

RowCrc& RowCrc::integer(std::int64_t value) {
  const auto bytes = palpateSchemaLittle(static_cast<std::uint64_t>(value));
  crc_ = crcOf(crc_, bytes.data(), bytes.size());
  return *this;
}

RowCrc& RowCrc::real(double value) {
  const auto bytes = palpateSchemaLittle(std::bit_cast<std::uint64_t>(value));
  crc_ = crcOf(crc_, bytes.data(), bytes.size());
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

}  // namespace palpate
