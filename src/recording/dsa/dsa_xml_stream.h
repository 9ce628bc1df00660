// From the bytes of a .dsa recording to its XML text, chunk by chunk, whether the file is bzip2 or
// plain XML. bzip2 data is decoded in a second thread. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include "palpate/core/bounded_queue.h"
#include "palpate/core/file_descriptor.h"

namespace palpate {

// Where the bytes of a recording come from: a file, or memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  // Fills `out` from the current position; fewer bytes only at the end, 0 = nothing left.
  // Throws FileError.
  virtual std::size_t read(std::span<char> out) = 0;
  virtual std::uint64_t numBytes() const noexcept = 0;
};

// A regular file. Throws FileError: missing, no permission, a folder, not a file.
class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path);
  std::size_t read(std::span<char> out) override;
  std::uint64_t numBytes() const noexcept override { return numBytes_; }

 private:
  std::filesystem::path path_;
  FileDescriptor descriptor_;
  std::uint64_t numBytes_ = 0;
};

// Bytes that outlive the source.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}
  std::size_t read(std::span<char> out) override;
  std::uint64_t numBytes() const noexcept override { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
};

// What a file is, by its first bytes.
enum class DsaEncoding { kBzip2, kXml, kOther };
DsaEncoding dsaEncodingOf(std::string_view first) noexcept;
// Throws FormatError saying what the file starts with, unless it may be a .dsa.
DsaEncoding requireDsaEncoding(std::string_view first, const std::filesystem::path& path);

class Bzip2Decoder;

class DsaXmlStream {
 public:
  // Tells the form by the first bytes. Throws FormatError (naming `path`) when they are neither
  // bzip2 nor XML, FileError from `source`, which must outlive the object.
  DsaXmlStream(ByteSource& source, std::filesystem::path path);
  ~DsaXmlStream();
  DsaXmlStream(const DsaXmlStream&) = delete;
  DsaXmlStream& operator=(const DsaXmlStream&) = delete;

  // The next chunk, valid until the next call; empty at the end. Throws FormatError, FileError.
  std::string_view next();
  bool compressed() const noexcept { return decoder_ != nullptr; }
  // Share of the file that was taken, 0..1.
  double fraction() const noexcept;

 private:
  struct Chunk {
    std::unique_ptr<char[]> bytes;
    std::size_t size = 0;
    std::uint64_t bytesTaken = 0;
    std::exception_ptr failure;
  };
  Chunk decodeChunk();
  void startThread();
  void decodeAll();

  ByteSource& source_;
  std::filesystem::path path_;
  std::vector<char> first_;  // plain XML: the bytes that told the form, then every chunk
  std::unique_ptr<Bzip2Decoder> decoder_;
  Chunk chunk_;
  std::uint64_t bytesTaken_ = 0;
  bool firstTaken_ = false;
  BoundedQueue<Chunk> queue_;
  std::thread thread_;
};

}  // namespace palpate
