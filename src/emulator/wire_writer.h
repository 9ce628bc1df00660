// Writes the little-endian bytes of an answer of the emulated controllers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/core/byte_order.h"

namespace palpate {

class WireWriter {
 public:
  WireWriter& u8(unsigned value) { return little(value, 1); }
  WireWriter& u16(unsigned value) { return little(value, 2); }
  WireWriter& u32(std::uint32_t value) { return little(value, 4); }
  WireWriter& f32(double value) {
    return u32(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }
  WireWriter& bytes(std::span<const std::byte> more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    return *this;
  }
  WireWriter& text(std::string_view more) { return bytes(std::as_bytes(std::span(more))); }

  std::size_t size() const noexcept { return bytes_.size(); }
  std::vector<std::byte>& data() noexcept { return bytes_; }

 private:
  WireWriter& little(std::uint32_t value, int count) {
    appendLittleEndian(bytes_, value, count);
    return *this;
  }

  std::vector<std::byte> bytes_;
};

}  // namespace palpate
