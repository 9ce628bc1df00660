// Reads bytes of a file in order, as they are or compressed by deflate (RFC 1951) or in zlib's form
// (RFC 1950). Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "imports/random_reader.h"

namespace palpate {

class SequentialReader {
 public:
  virtual ~SequentialReader() = default;
  // Fills `bytes` with the next ones. Throws FileError, FormatError (damaged, cut off).
  virtual void read(std::span<std::byte> bytes) = 0;
  // Leaves out the next ones.
  virtual void skip(std::uint64_t count);
};

enum class Deflate { kRaw, kZlib };

class InflatedBytes final : public SequentialReader {
 public:
  // `file` must outlive this object and has these packed bytes; `name` is for messages.
  InflatedBytes(const RandomReader& file,
                std::uint64_t offset,
                std::uint64_t packedBytes,
                Deflate form,
                std::string name);
  ~InflatedBytes() override;
  InflatedBytes(const InflatedBytes&) = delete;
  InflatedBytes& operator=(const InflatedBytes&) = delete;

  void read(std::span<std::byte> bytes) override;
  // After the last byte: the data ends here (padding may follow), and zlib's checksum is right.
  void finish();

 private:
  struct Stream;
  // Returns whether the compressed data ended.
  bool inflateTo(std::span<std::byte> bytes, std::size_t& filled);
  [[noreturn]] void throwDamaged(const char* what) const;

  const RandomReader& file_;
  std::uint64_t offset_;
  std::uint64_t packedLeft_;
  std::string name_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace palpate
