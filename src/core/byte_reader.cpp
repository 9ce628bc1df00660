#include "palpate/core/byte_reader.h"

#include <bit>

namespace palpate {

float ByteReader::f32() noexcept { return std::bit_cast<float>(u32()); }
double ByteReader::f64() noexcept { return std::bit_cast<double>(u64()); }

std::span<const std::byte> ByteReader::take(std::size_t count) noexcept {
  if (failed_ || count > remaining()) {
    failed_ = true;
    return {};
  }
  const auto bytes = bytes_.subspan(position_, count);
  position_ += count;
  return bytes;
}

}  // namespace palpate
