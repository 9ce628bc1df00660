// Little-endian bytes of an answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace palpate {

class WireWriter {
 public:
  WireWriter& u8(unsigned value) { return little(value, 1); }
  WireWriter& u16(unsigned value) { return little(value, 2); }
  WireWriter& u32(std::uint32_t value) { return little(value, 4); }
  WireWriter& f32(double value) {
    const auto single = static_cast<float>(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &single, sizeof bits);
    return u32(bits);
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
    for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<std::byte>(value >> (8 * i)));
    return *this;
  }

  std::vector<std::byte> bytes_;
};

}  // namespace palpate
