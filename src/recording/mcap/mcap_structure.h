// What an MCAP file consists of, without the content of its chunks; and the messages of a chunk.
// All lengths are checked against the file and bounded. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/file_descriptor.h"
#include "palpate/core/progress.h"

namespace palpate {

// A file that is read at any place. Safe from several threads.
class McapFile {
 public:
  // Throws FileError; FormatError where the file doesn't begin as MCAP.
  explicit McapFile(std::filesystem::path path);
  const std::filesystem::path& path() const noexcept { return path_; }
  std::uint64_t size() const noexcept { return size_; }
  // Reads exactly `size` bytes. Throws FileError; FormatError when the file has fewer.
  void read(std::uint64_t offset, std::size_t size, std::string& out) const;

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
};

// A chunk, or messages that stand outside of chunks.
struct McapPiece {
  std::uint64_t offset = 0;  // of its (compressed) records in the file
  std::uint64_t packedSize = 0;
  std::uint64_t rawSize = 0;
  std::uint32_t crc = 0;    // of the records; 0: not known
  std::string compression;  // as in the file
  // Numbers of channels by the message indexes behind the chunk; empty: none are there.
  std::vector<std::uint16_t> indexed;
};

struct McapSchema {
  std::string name;
  std::string encoding;
};
struct McapChannel {
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;
  std::map<std::string, std::string> metadata;
};

// Bounds of the texts that are kept of a file (metadata, schemas, channels, the hand's files), with
// what each of them takes in memory beside its characters. A recording of Palpate's has some 100
// KB.
class McapTextBudget {
 public:
  // Returns whether a text of so many bytes may be kept.
  bool take(std::size_t bytes) {
    constexpr std::size_t kLargest = 16u << 20;
    constexpr std::size_t kOfEach = 128;  // a node of a map, two strings
    taken_ += bytes + kOfEach;
    return taken_ <= kLargest;
  }

 private:
  std::uint64_t taken_ = 0;
};

// Schemas and channels by their numbers.
struct McapChannels {
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  McapTextBudget budget;
  // Takes a record Schema or Channel. Returns what is wrong, or an empty text.
  std::string add(std::uint8_t opcode, std::string_view content);
};

struct McapStructure {
  // Of kAboutRecord and kMetaRecord, by these names.
  std::map<std::string, std::map<std::string, std::string>> metadata;
  std::map<std::string, std::string> attachments;  // of hand.json, hand.urdf
  McapChannels channels;                           // of those outside of chunks and in the summary
  std::vector<McapPiece> pieces;
  // All records are there, but a checksum of the whole is wrong.
  bool checksumWrong = false;
  // One line: where the file is cut off or damaged. What stands before is in this structure.
  std::string damage;
};

// `checksums`: also reads the file through and checks those of its data section, summary and
// attachments. Throws FileError, FormatError (not MCAP), Cancelled; of a damaged file it returns
// what could be read.
McapStructure readMcapStructure(const McapFile& file,
                                bool checksums,
                                const Progress& progress = {});

// The records of a piece. Throws FormatError, which names the chunk by its number `index` and
// place.
std::string readMcapPiece(const McapFile& file, const McapPiece& piece, std::size_t index);

// What an error says, without the name of the file that it begins with.
std::string mcapFaultOf(const std::filesystem::path& path, const std::exception& error);
// "2 damaged chunks, whose messages are lost (the first: ..)".
std::string mcapDamagedChunksText(std::size_t count,
                                  const std::string& firstFault,
                                  const char* lost);

// Pieces that take more than this when they are unpacked are read one at a time.
inline constexpr std::uint64_t kSmallMcapPiecesBytes = 16u << 20;

// Calls visit(opcode, content) for each record. Returns false where they are damaged.
bool forEachMcapRecord(std::string_view records,
                       const std::function<void(std::uint8_t, std::string_view)>& visit);

// A record Message, a view.
struct McapMessage {
  std::uint16_t channel = 0;
  std::uint64_t logNs = 0;
  std::string_view data;
};
// Returns false where the content is too short.
bool readMcapMessage(std::string_view content, McapMessage& message);

}  // namespace palpate
