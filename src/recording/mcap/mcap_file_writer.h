// Writes the records of an MCAP file: messages in compressed chunks with their indexes, and the
// summary. Knows nothing of recordings. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/core/ordered_work.h"
#include "palpate/recording/mcap_recording.h"

namespace palpate {

// Not thread-safe; compresses on threads of its own.
class McapFileWriter {
 public:
  // Writes the next bytes of the file; what it throws goes through.
  using Write = std::function<void(std::string_view bytes)>;
  using Texts = std::map<std::string, std::string>;

  // Texts must be UTF-8.
  McapFileWriter(Write write,
                 std::string_view profile,
                 std::string_view library,
                 const McapWriteOptions& options);

  void addMetadata(const std::string& name, const Texts& values);
  void addAttachment(const std::string& name,
                     const std::string& mediaType,
                     std::uint64_t timeNs,
                     std::string_view data);
  // Return the number of the new schema or channel. Channels stand outside of chunks.
  std::uint16_t addSchema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t addChannel(std::uint16_t schema,
                           std::string_view topic,
                           std::string_view encoding,
                           const Texts& metadata);

  // A message is begun, appended to the string that is returned, and ended.
  std::string& beginMessage(std::uint16_t channel, std::uint64_t timeNs);
  void endMessage();
  // After messages that must lie in one chunk: ends the chunk when it is large enough.
  void endGroup();
  std::size_t waitingBytes() const noexcept { return chunk_ ? chunk_->raw.size() : 0; }
  // Ends the chunk and writes all.
  void flush();
  // Writes all, the summary and the end of the file.
  void finish();

 private:
  using IndexEntry = std::pair<std::uint64_t, std::uint64_t>;  // log time [ns], offset
  struct Chunk {
    std::string raw;
    std::string packed;  // the same string is not kept twice: without compression it is empty
    std::uint32_t crc = 0;
    std::uint64_t startNs = 0;
    std::uint64_t endNs = 0;
    std::vector<std::vector<IndexEntry>> index;  // by channel
  };

  void put(std::string_view bytes);
  void putRecord(std::uint8_t opcode, std::string_view content);
  void endChunk();
  void compress(Chunk& chunk) const;
  void write(const Chunk& chunk);

  const Write write_;
  const McapWriteOptions options_;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;
  std::shared_ptr<Chunk> chunk_;  // the one that is filled
  std::size_t messageAt_ = 0;     // begin of the message's record in it

  // For the summary: contents of its records.
  std::vector<std::string> schemas_;
  std::vector<std::string> channels_;
  std::vector<std::string> chunkIndexes_;
  std::vector<std::string> attachmentIndexes_;
  std::vector<std::string> metadataIndexes_;
  std::vector<std::uint64_t> messages_;  // by channel
  std::uint64_t startNs_ = 0;
  std::uint64_t endNs_ = 0;
  OrderedWork work_;  // last: it ends before what it uses
};

}  // namespace palpate
