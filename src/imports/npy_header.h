// The header of a .npy array (numpy.lib.format, versions 1.0 to 3.0): magic, version, length, and a
// Python literal {'descr': '<f4', 'fortran_order': False, 'shape': (100, 14, 6), }.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palpate {

// The type of the numbers of an array.
enum class NumberKind : std::uint8_t { kBool, kSigned, kUnsigned, kFloat, kDate, kOther };

struct NpyHeader {
  NumberKind kind = NumberKind::kOther;
  std::string type;           // as NumPy writes it: "<f4"
  std::size_t itemBytes = 0;  // of one number; 0 for other kinds
  bool bigEndian = false;
  std::int64_t dateUnitNs = 0;  // of kDate: nanoseconds of one unit
  bool fortranOrder = false;
  std::vector<std::uint64_t> shape;
  std::uint64_t dataOffset = 0;  // [bytes] from the start of the array file

  // Bytes of all numbers; nothing when the product is too large for 64 bits.
  std::optional<std::uint64_t> numBytes() const noexcept;
  std::string typeName() const;  // "uint16"
};

// The most bytes that a header may have; those of arrays of numbers have about 100.
constexpr std::size_t kMaxNpyHeaderBytes = 1u << 20;

// How many bytes of the beginning of the array parseNpyHeader() needs; nothing: not a .npy array.
// `bytes` are the first 12 of the array (or all, if it has fewer).
std::optional<std::size_t> npyHeaderBytes(std::span<const std::byte> bytes);

// Throws palpate::Error that says what is wrong.
NpyHeader parseNpyHeader(std::span<const std::byte> bytes);

}  // namespace palpate
