// The XML text of a .dsa recording, chunk by chunk, whether the file is bzip2 or plain XML. bzip2
// data is decoded in a second thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include "palpate/core/bounded_queue.h"

#include "recording/dsa/byte_source.h"
#include "recording/dsa/bzip2_decoder.h"

namespace palpate {

// What a file is, by its first bytes.
enum class DsaEncoding { kBzip2, kXml, kOther };
DsaEncoding dsaEncodingOf(std::string_view first) noexcept;
// Throws FormatError saying what the file starts with, unless it may be a .dsa.
DsaEncoding requireDsaEncoding(std::string_view first, const std::filesystem::path& path);

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
