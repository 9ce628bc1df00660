// Decodes bzip2 data in order, in the caller's thread. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "recording/dsa/byte_source.h"

namespace palpate {

// What ends a message of damaged data when a part of it may be intact.
constexpr const char* kDsaRecoverHint =
    "; 'palpate recover' may save the frames of its intact blocks";

// bzip2 data, one stream or several in a row, decoded piece by piece.
class Bzip2Decoder {
 public:
  // `first` are bytes already taken from `source`, which must outlive the decoder.
  Bzip2Decoder(ByteSource& source, std::vector<char> first);
  ~Bzip2Decoder();
  Bzip2Decoder(const Bzip2Decoder&) = delete;
  Bzip2Decoder& operator=(const Bzip2Decoder&) = delete;

  // Fills `out`; fewer bytes only at the end. Throws Error naming the byte of the file: data that
  // ends early, wrong data or checksum, bytes behind the last stream. FileError from the source.
  // What was decoded of a wrong block before its checksum was reached has been handed out by then.
  std::size_t read(std::span<char> out);
  std::uint64_t bytesTaken() const noexcept;  // of the source

 private:
  struct Stream;
  bool refill();
  void open();

  ByteSource& source_;
  std::vector<char> input_;
  std::unique_ptr<Stream> stream_;
  std::uint64_t streamBegin_ = 0;  // [bytes] of the source
  std::uint64_t inputEnd_ = 0;     // [bytes] of the source behind input_
  int numStreams_ = 0;             // that ended well
  bool sourceEnded_ = false;
};

}  // namespace palpate
