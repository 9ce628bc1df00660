// Cuts bzip2 data into its blocks, without decoding them. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "palpate/recording/bzip2_blocks.h"

#include "recording/dsa/byte_source.h"

namespace palpate {

// The blocks of a source in order, as long as everything is regular. Not thread-safe.
class Bzip2BlockReader {
 public:
  struct Block {
    std::vector<char> stream;  // with this block only, see bzip2StreamOf()
    std::size_t numBytes = 0;  // of `stream` up to the block's last bit
    bool endsStream = false;   // otherwise another block follows
    std::uint32_t checksum = 0;
    std::uint64_t bytesTaken = 0;  // of the source, up to the block's end, or to the end of all
  };
  enum class Next { kBlock, kEnd, kIrregular };

  // `first` are bytes already taken from `source`, which must outlive the reader.
  Bzip2BlockReader(ByteSource& source, std::vector<char> first);
  // Throws FileError. After anything but kBlock it must not be called again.
  Next next(Block& block);

 private:
  std::span<const std::byte> window() const noexcept;
  bool extend();
  bool has(std::uint64_t numBits);
  void dropTakenBytes();
  bool beginStream();
  bool endStream();
  bool findEnd(Bzip2Mark& end);

  ByteSource& source_;
  std::vector<char> window_;       // bytes of the source from windowBegin_ on
  std::uint64_t windowBegin_ = 0;  // [bytes] of the source
  std::uint64_t bit_ = 0;          // where to go on, from the begin of window_
  bool inStream_ = false;
  char level_ = '9';
  std::uint32_t checksum_ = 0;  // over the checksums of the stream's blocks so far
};

}  // namespace palpate
