// From the bytes of a .dsa recording to its XML text, chunk by chunk, whether the file is bzip2 or
// plain XML. bzip2 data of several blocks is decoded on several threads, a single block in a second
// one. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include "palpate/core/bounded_queue.h"

#include "recording/dsa/byte_source.h"
#include "recording/dsa/bzip2_decoder.h"
#include "recording/dsa/parallel_bzip2_decoder.h"

namespace palpate {

// What a file is, by its first bytes.
enum class DsaEncoding { kBzip2, kXml, kOther };
DsaEncoding dsaEncodingOf(std::string_view first) noexcept;
// Throws FormatError saying what the file starts with, unless it may be a .dsa.
DsaEncoding requireDsaEncoding(std::string_view first, const std::filesystem::path& path);

class DsaXmlStream {
 public:
  // Tells the form by the first bytes. Throws FormatError (naming `path`) when they are neither
  // bzip2 nor XML, FileError from `source`, which must outlive the object. bzip2 data is decoded by
  // up to `threads` threads besides the caller's (0: as many as the machine runs at once; 1: by the
  // caller's alone). Where the data turns out to be irregular, it is read again from the beginning;
  // `meanwhile` is then called from time to time and may throw.
  DsaXmlStream(ByteSource& source,
               std::filesystem::path path,
               std::size_t threads,
               std::function<void()> meanwhile);
  ~DsaXmlStream();
  DsaXmlStream(const DsaXmlStream&) = delete;
  DsaXmlStream& operator=(const DsaXmlStream&) = delete;

  // The next chunk, valid until the next call; empty at the end. Throws FormatError, FileError.
  std::string_view next();
  bool compressed() const noexcept { return decoder_ || parallel_; }
  // Share of the file that was taken, 0..1.
  double fraction() const noexcept;

 private:
  struct Chunk {
    std::unique_ptr<char[]> bytes;
    std::size_t size = 0;
    std::uint64_t bytesTaken = 0;
    std::exception_ptr failure;
  };
  std::string_view nextOfBlocks();
  std::string_view nextInOrder();
  std::string_view nextOfText();
  std::string_view taken(Chunk chunk);
  Chunk startAgain();
  Chunk decodeChunk();
  void startThread();
  void decodeAll();

  ByteSource& source_;
  std::filesystem::path path_;
  std::size_t threads_;
  std::function<void()> meanwhile_;
  std::vector<char> first_;  // plain XML: the bytes that told the form, then every chunk
  std::unique_ptr<ParallelBzip2Decoder> parallel_;  // as long as the blocks are regular
  std::unique_ptr<Bzip2Decoder> decoder_;
  Chunk chunk_;
  std::uint64_t bytesTaken_ = 0;
  bool firstTaken_ = false;
  BoundedQueue<Chunk> queue_;
  std::thread thread_;
};

}  // namespace palpate
