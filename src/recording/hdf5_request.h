// What is asked of the program palpate_hdf5 and what it answers, over a socket. It alone reads HDF5
// files: libhdf5 crashes, hangs and takes any amount of memory on files that anybody can make.
// Numbers are little-endian, as in core/byte_order.h. Private to this module.
//
// A request:  size u32 [bytes behind it] | Hdf5Request u8 | name | what belongs to the request
// An answer:  size u32 [bytes behind it] | Hdf5Answer u8 | value or text
// A text:     size u32 [bytes] | bytes
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "palpate/core/byte_order.h"
#include "palpate/core/byte_reader.h"

namespace palpate {

// The names are those of data sets, groups, or of objects with attributes; "" is the file.
enum class Hdf5Request : std::uint8_t {
  kOpen,        // -> nothing. The first request
  kArrayNames,  // -> u32 count, texts: all data sets that are in this file
  kHas,         // -> u8: whether there is an object of this name
  kFacts,       // -> the members of Hdf5Facts in their order; a shape is u8 rank, u64 each
  kRead,  // first u64, count u64 [places on an axis], Hdf5Number u8, Hdf5Axis u8 -> the numbers, in
          // C order
  kTexts,             // first u64, count u64, longest u64 [bytes] -> u32 number, texts: one or more
  kTextAttribute,     // attribute, longest u64 [bytes] -> u8 whether there is one, text
  kIntegerAttribute,  // attribute -> u8 whether there is one, i64
  kNumberAttribute,   // attribute -> u8 whether there is one, f64
  kAxisNames,         // -> u32 count, texts: by the labels of the axes, or by their scales; none: 0
};
// kFault: a text that follows the name of the object in a message.
enum class Hdf5Answer : std::uint8_t { kValue, kFault };

// The most bytes of numbers in an answer; a block of frames has 16 MB.
constexpr std::size_t kMaxHdf5ReadBytes = 32u << 20;
constexpr std::size_t kMaxHdf5AnswerBytes = kMaxHdf5ReadBytes + (8u << 20);
constexpr std::size_t kMaxHdf5RequestBytes = 64u << 10;
// How the program ends when its memory doesn't suffice.
constexpr int kHdf5MemoryExitCode = 12;
// The limit of the program's address space. Its argument is that of the processor time of one
// request [ms].
constexpr std::size_t kHdf5MemoryBytes = 256u << 20;

inline void appendText(std::string& out, std::string_view text) {
  appendLittleEndian(out, text.size(), 4);
  out += text;
}
// Empty where the bytes end before it does.
inline std::string textFrom(ByteReader& in) {
  const auto bytes = in.take(in.u32());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace palpate
