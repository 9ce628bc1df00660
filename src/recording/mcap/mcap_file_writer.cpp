#include "recording/mcap/mcap_file_writer.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "recording/mcap/mcap_compression.h"
#include "recording/mcap/mcap_format.h"

namespace palpate {
namespace {

using mcap_format::putString;

McapWriteOptions validated(const McapWriteOptions& options) {
  options.validate();
  return options;
}

std::string mcapTextMap(const McapFileWriter::Texts& values) {
  std::string entries;
  for (const auto& [key, value] : values) {
    putString(entries, key);
    putString(entries, value);
  }
  std::string map;
  putString(map, entries);
  return map;
}

std::string mcapRecord(std::uint8_t opcode, std::string_view content) {
  std::string record(1, static_cast<char>(opcode));
  mcap_format::put(record, std::uint64_t{content.size()});
  record += content;
  return record;
}

}  // namespace

void McapWriteOptions::validate() const {
  if (level < 1 || level > 19) throw std::invalid_argument("McapWriteOptions: level must be 1..19");
  if (chunkBytes < (1u << 10) || chunkBytes > (64u << 20))
    throw std::invalid_argument("McapWriteOptions: chunkBytes must be 1 KiB..64 MiB");
}

McapFileWriter::McapFileWriter(Write write,
                               std::string_view profile,
                               std::string_view library,
                               const McapWriteOptions& options)
    : write_(std::move(write)),
      options_(validated(options)),
      work_(otherThreads(options.threads), 2 * otherThreads(options.threads)) {
  put(mcap_format::kMagic);
  std::string header;
  putString(header, profile);
  putString(header, library);
  putRecord(mcap_format::kHeader, header);
}

void McapFileWriter::put(std::string_view bytes) {
  write_(bytes);
  crc_ = mcap_format::addToCrc(crc_, bytes);
  position_ += bytes.size();
}

void McapFileWriter::putRecord(std::uint8_t opcode, std::string_view content) {
  put(mcapRecord(opcode, content));
}

void McapFileWriter::addMetadata(const std::string& name, const Texts& values) {
  flush();
  std::string content;
  putString(content, name);
  content += mcapTextMap(values);
  std::string index;
  mcap_format::put(index, position_);
  mcap_format::put(index, std::uint64_t{mcap_format::kRecordHead + content.size()});
  putString(index, name);
  putRecord(mcap_format::kMetadata, content);
  metadataIndexes_.push_back(std::move(index));
}

void McapFileWriter::addAttachment(const std::string& name,
                                   const std::string& mediaType,
                                   std::uint64_t timeNs,
                                   std::string_view data) {
  flush();
  std::string content;
  mcap_format::put(content, timeNs);
  mcap_format::put(content, std::uint64_t{0});
  putString(content, name);
  putString(content, mediaType);
  mcap_format::put(content, std::uint64_t{data.size()});
  content += data;
  mcap_format::put(content, mcap_format::addToCrc(0, content));
  std::string index;
  mcap_format::put(index, position_);
  mcap_format::put(index, std::uint64_t{mcap_format::kRecordHead + content.size()});
  mcap_format::put(index, timeNs);
  mcap_format::put(index, std::uint64_t{0});
  mcap_format::put(index, std::uint64_t{data.size()});
  putString(index, name);
  putString(index, mediaType);
  putRecord(mcap_format::kAttachment, content);
  attachmentIndexes_.push_back(std::move(index));
}

std::uint16_t McapFileWriter::addSchema(std::string_view name,
                                        std::string_view encoding,
                                        std::string_view data) {
  flush();
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  std::string content;
  mcap_format::put(content, id);
  putString(content, name);
  putString(content, encoding);
  putString(content, data);
  putRecord(mcap_format::kSchema, content);
  schemas_.push_back(std::move(content));
  return id;
}

std::uint16_t McapFileWriter::addChannel(std::uint16_t schema,
                                         std::string_view topic,
                                         std::string_view encoding,
                                         const Texts& metadata) {
  flush();
  const auto id = static_cast<std::uint16_t>(channels_.size());
  std::string content;
  mcap_format::put(content, id);
  mcap_format::put(content, schema);
  putString(content, topic);
  putString(content, encoding);
  content += mcapTextMap(metadata);
  putRecord(mcap_format::kChannel, content);
  channels_.push_back(std::move(content));
  messages_.push_back(0);
  return id;
}

std::string& McapFileWriter::beginMessage(std::uint16_t channel, std::uint64_t timeNs) {
  if (!chunk_) {
    chunk_ = std::make_shared<Chunk>();
    chunk_->raw.reserve(options_.chunkBytes + options_.chunkBytes / 8);
    chunk_->startNs = chunk_->endNs = timeNs;
  }
  Chunk& chunk = *chunk_;
  chunk.startNs = std::min(chunk.startNs, timeNs);
  chunk.endNs = std::max(chunk.endNs, timeNs);
  chunk.index.resize(channels_.size());
  messageAt_ = chunk.raw.size();
  chunk.index.at(channel).emplace_back(timeNs, messageAt_);
  std::string& raw = chunk.raw;
  raw += static_cast<char>(mcap_format::kMessage);
  mcap_format::put(raw, std::uint64_t{0});  // the length, in endMessage()
  mcap_format::put(raw, channel);
  mcap_format::put(raw, static_cast<std::uint32_t>(messages_[channel]++));
  mcap_format::put(raw, timeNs);
  mcap_format::put(raw, timeNs);
  return raw;
}

void McapFileWriter::endMessage() {
  std::string& raw = chunk_->raw;
  const std::uint64_t length = raw.size() - messageAt_ - mcap_format::kRecordHead;
  std::memcpy(raw.data() + messageAt_ + 1, &length, sizeof length);
}

void McapFileWriter::endGroup() {
  if (chunk_ && chunk_->raw.size() >= options_.chunkBytes) endChunk();
}

void McapFileWriter::compress(Chunk& chunk) const {
  chunk.crc = mcap_format::addToCrc(0, chunk.raw);
  if (options_.compression == McapCompression::kNone) return;
  chunk.packed = mcapCompressed(chunk.raw, options_.compression, options_.level);
}

void McapFileWriter::endChunk() {
  if (!chunk_) return;
  const std::shared_ptr<Chunk> chunk = std::move(chunk_);
  work_.add([this, chunk] { compress(*chunk); }, [this, chunk] { write(*chunk); });
}

void McapFileWriter::write(const Chunk& chunk) {
  const bool plain = options_.compression == McapCompression::kNone;
  const std::string& packed = plain ? chunk.raw : chunk.packed;
  std::string head;
  mcap_format::put(head, chunk.startNs);
  mcap_format::put(head, chunk.endNs);
  mcap_format::put(head, std::uint64_t{chunk.raw.size()});
  mcap_format::put(head, chunk.crc);
  putString(head, mcapNameInFile(options_.compression));
  mcap_format::put(head, std::uint64_t{packed.size()});
  std::string record(1, static_cast<char>(mcap_format::kChunk));
  mcap_format::put(record, std::uint64_t{head.size() + packed.size()});
  record += head;
  record += packed;
  const std::uint64_t chunkAt = position_;
  const std::uint64_t chunkLength = record.size();
  std::string offsets;
  for (std::size_t channel = 0; channel < chunk.index.size(); ++channel) {
    const std::vector<IndexEntry>& entries = chunk.index[channel];
    if (entries.empty()) continue;
    mcap_format::put(offsets, static_cast<std::uint16_t>(channel));
    mcap_format::put(offsets, position_ + record.size());
    std::string content;
    mcap_format::put(content, static_cast<std::uint16_t>(channel));
    mcap_format::put(content, static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [timeNs, offset] : entries) {
      mcap_format::put(content, timeNs);
      mcap_format::put(content, offset);
    }
    record += mcapRecord(mcap_format::kMessageIndex, content);
  }
  // At once, so that a file that is cut off here ends with whole chunks where the system can.
  put(record);
  std::string index;
  mcap_format::put(index, chunk.startNs);
  mcap_format::put(index, chunk.endNs);
  mcap_format::put(index, chunkAt);
  mcap_format::put(index, chunkLength);
  putString(index, offsets);
  mcap_format::put(index, std::uint64_t{record.size() - chunkLength});
  putString(index, mcapNameInFile(options_.compression));
  mcap_format::put(index, std::uint64_t{packed.size()});
  mcap_format::put(index, std::uint64_t{chunk.raw.size()});
  if (chunkIndexes_.empty()) startNs_ = chunk.startNs;
  startNs_ = std::min(startNs_, chunk.startNs);
  endNs_ = std::max(endNs_, chunk.endNs);
  chunkIndexes_.push_back(std::move(index));
}

void McapFileWriter::flush() {
  endChunk();
  work_.finishAll();
}

void McapFileWriter::finish() {
  flush();
  std::string end;
  mcap_format::put(end, crc_);
  putRecord(mcap_format::kDataEnd, end);

  std::string statistics;
  mcap_format::put(statistics,
                   std::accumulate(messages_.begin(), messages_.end(), std::uint64_t{0}));
  mcap_format::put(statistics, static_cast<std::uint16_t>(schemas_.size()));
  mcap_format::put(statistics, static_cast<std::uint32_t>(channels_.size()));
  mcap_format::put(statistics, static_cast<std::uint32_t>(attachmentIndexes_.size()));
  mcap_format::put(statistics, static_cast<std::uint32_t>(metadataIndexes_.size()));
  mcap_format::put(statistics, static_cast<std::uint32_t>(chunkIndexes_.size()));
  mcap_format::put(statistics, startNs_);
  mcap_format::put(statistics, endNs_);
  std::string counts;
  for (std::size_t channel = 0; channel < messages_.size(); ++channel) {
    mcap_format::put(counts, static_cast<std::uint16_t>(channel));
    mcap_format::put(counts, messages_[channel]);
  }
  putString(statistics, counts);

  const std::uint64_t summaryAt = position_;
  std::string summary;
  std::string offsets;
  const auto addGroup = [&](std::uint8_t opcode, const std::vector<std::string>& contents) {
    if (contents.empty()) return;
    const std::size_t begin = summary.size();
    for (const std::string& content : contents) summary += mcapRecord(opcode, content);
    std::string offset(1, static_cast<char>(opcode));
    mcap_format::put(offset, summaryAt + begin);
    mcap_format::put(offset, std::uint64_t{summary.size() - begin});
    offsets += mcapRecord(mcap_format::kSummaryOffset, offset);
  };
  addGroup(mcap_format::kSchema, schemas_);
  addGroup(mcap_format::kChannel, channels_);
  addGroup(mcap_format::kStatistics, {statistics});
  addGroup(mcap_format::kChunkIndex, chunkIndexes_);
  addGroup(mcap_format::kAttachmentIndex, attachmentIndexes_);
  addGroup(mcap_format::kMetadataIndex, metadataIndexes_);
  const std::uint64_t offsetsAt = summaryAt + summary.size();
  summary += offsets;
  // The checksum covers the footer up to itself.
  summary += static_cast<char>(mcap_format::kFooter);
  mcap_format::put(summary, std::uint64_t{8 + 8 + 4});
  mcap_format::put(summary, summaryAt);
  mcap_format::put(summary, offsetsAt);
  mcap_format::put(summary, mcap_format::addToCrc(0, summary));
  put(summary);
  put(mcap_format::kMagic);
}

}  // namespace palpate
