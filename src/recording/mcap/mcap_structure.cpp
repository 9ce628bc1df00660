#include "recording/mcap/mcap_structure.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "recording/mcap/mcap_compression.h"
#include "recording/mcap/mcap_format.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// Bounds of what is read, so that a hostile file costs little time and memory.
// The largest chunk that Palpate writes (McapWriteOptions), and a message that passes its end. Such
// a chunk and its samples take three times as much memory.
constexpr std::uint64_t kLargestMcapChunkBytes = 65u << 20;
constexpr std::uint64_t kLargestMcapRecordBytes = 16u << 20;  // of other records that are read
// What the chunks unpack to may be the larger of these. Deflate, with which the other formats
// compress, can't do more than 1032; frames of a hand compress to a twentieth.
constexpr std::uint64_t kMcapUnpackedBytes = 512u << 20;
constexpr std::uint64_t kMcapUnpackedPerByte = 1032;
constexpr std::uint64_t kLoosePieceBytes = 1u << 20;  // messages outside of chunks
constexpr std::size_t kMcapPieceOfFile = 1u << 20;    // read at once for a checksum

// A cursor over the content of a record.
class McapContentReader {
 public:
  explicit McapContentReader(std::string_view bytes) : bytes_(bytes) {}
  bool ok() const { return ok_; }
  std::string_view rest() const { return bytes_; }
  template <typename Number>
  Number number() {
    Number value{};
    const std::string_view bytes = take(sizeof(Number));
    if (ok_) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::string_view take(std::uint64_t count) {
    if (!ok_ || count > bytes_.size()) {
      ok_ = false;
      return {};
    }
    const std::string_view taken = bytes_.substr(0, static_cast<std::size_t>(count));
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  // Puts pairs of key and value into `values`. Returns false where the budget does not suffice.
  bool texts(std::map<std::string, std::string>& values, McapTextBudget& budget) {
    McapContentReader entries(text());
    while (entries.ok() && !entries.rest().empty()) {
      const std::string_view key = entries.text();
      const std::string_view value = entries.text();
      if (!budget.take(key.size() + value.size())) return false;
      values[std::string(key)] = value;
    }
    ok_ = ok_ && entries.ok();
    return true;
  }

 private:
  std::string_view bytes_;
  bool ok_ = true;
};

std::string mcapAt(std::uint64_t offset) { return " at byte " + std::to_string(offset); }

// Steps through the records of a file.
class McapWalk {
 public:
  McapWalk(const McapFile& file, bool checksums, const Progress& progress)
      : file_(file), checksums_(checksums), progress_(progress) {}

  McapStructure walked() {
    position_ = mcap_format::kMagic.size();
    if (checksums_) addToCrc(0, position_);
    while (result_.damage.empty() && !ended_) step();
    if (result_.damage.empty()) checkEnd();
    if (result_.damage.empty() && wrongChecksum_) {
      damage("is damaged: the checksum of its " + std::string(wrongChecksum_) + " is wrong");
      result_.checksumWrong = true;
    }
    endLoosePiece();
    return std::move(result_);
  }

 private:
  void damage(const std::string& text) {
    if (result_.damage.empty()) result_.damage = text;
  }

  void addToCrc(std::uint64_t from, std::uint64_t end) {
    while (from < end) {
      const auto size =
          static_cast<std::size_t>(std::min<std::uint64_t>(end - from, kMcapPieceOfFile));
      file_.read(from, size, buffer_);
      crc_ = mcap_format::addToCrc(crc_, buffer_);
      from += size;
    }
  }

  void step() {
    if (progress_ && steps_++ % 64 == 0 &&
        !progress_(static_cast<double>(position_) / static_cast<double>(file_.size() + 1)))
      throw Cancelled();
    if (file_.size() - position_ < mcap_format::kRecordHead)
      return damage("is cut off" + mcapAt(file_.size()) + ", or is being written");
    file_.read(position_, mcap_format::kRecordHead, head_);
    McapContentReader head(head_);
    const auto opcode = head.number<std::uint8_t>();
    const auto length = head.number<std::uint64_t>();
    const std::uint64_t contentAt = position_ + mcap_format::kRecordHead;
    if (opcode == 0) return damage("is damaged: no record begins" + mcapAt(position_));
    if (length > file_.size() - contentAt)
      return damage("is cut off or damaged: the record" + mcapAt(position_) +
                    " is longer than the file");
    take(opcode, contentAt, length);
    if (!result_.damage.empty()) return;
    // The checksum of the data section ends before DataEnd.
    if (checksums_ && opcode != mcap_format::kDataEnd) addToCrc(position_, contentAt + length);
    position_ = contentAt + length;
  }

  bool readContent(std::uint64_t at, std::uint64_t length) {
    if (length > kLargestMcapRecordBytes) {
      damage("has a record that is too large" + mcapAt(at));
      return false;
    }
    file_.read(at, static_cast<std::size_t>(length), content_);
    return true;
  }

  void take(std::uint8_t opcode, std::uint64_t at, std::uint64_t length) {
    switch (opcode) {
      case mcap_format::kHeader:
      case mcap_format::kSchema:
      case mcap_format::kChannel:
      case mcap_format::kMetadata:
      case mcap_format::kDataEnd:
      case mcap_format::kFooter:
        if (readContent(at, length)) takeContent(opcode, at);
        return;
      case mcap_format::kAttachment:
        return takeAttachment(at, length);
      case mcap_format::kMessage:
        return takeLoose(at, length);
      case mcap_format::kChunk:
        return takeChunk(at, length);
      case mcap_format::kMessageIndex:
        return takeIndex(at, length);
      default:  // of the summary, or of a later version
        return;
    }
  }

  void takeContent(std::uint8_t opcode, std::uint64_t at) {
    McapContentReader content(content_);
    if (opcode == mcap_format::kSchema || opcode == mcap_format::kChannel) {
      const std::string fault = result_.channels.add(opcode, content_);
      if (!fault.empty()) damage(fault + mcapAt(at));
    } else if (opcode == mcap_format::kMetadata) {
      const std::string name(content.text());
      // Another program's is not read.
      if (name != mcap_format::kAboutRecord && name != mcap_format::kMetaRecord) return;
      if (!content.texts(result_.metadata[name], result_.channels.budget))
        return damage("has too much metadata" + mcapAt(at));
      if (!content.ok()) return damage("has damaged metadata" + mcapAt(at));
    } else if (opcode == mcap_format::kDataEnd) {
      const auto crc = content.number<std::uint32_t>();
      if (!content.ok()) return damage("is damaged: the end of the data" + mcapAt(at));
      if (checksums_ && crc != 0 && crc != crc_) wrongChecksum_ = "data section";
      summaryAt_ = at + content_.size();
      crc_ = 0;
    } else if (opcode == mcap_format::kFooter) {
      const auto summary = content.number<std::uint64_t>();
      content.number<std::uint64_t>();
      const auto crc = content.number<std::uint32_t>();
      if (!content.ok()) return damage("is damaged: its footer");
      ended_ = true;
      // The checksum covers the footer but for itself.
      if (checksums_ && summary == summaryAt_ && summary != 0 && crc != 0) {
        addToCrc(position_, at + 16);
        if (crc != crc_ && !wrongChecksum_) wrongChecksum_ = "summary";
      }
    }
  }

  void takeAttachment(std::uint64_t at, std::uint64_t length) {
    constexpr std::uint64_t kMaxHead = 64u << 10;
    file_.read(at, static_cast<std::size_t>(std::min(length, kMaxHead)), content_);
    McapContentReader head(content_);
    head.number<std::uint64_t>();
    head.number<std::uint64_t>();
    const std::string name(head.text());
    if (!head.ok()) return;  // a long name: none that is wanted
    if (name != mcap_format::kHandJson && name != mcap_format::kHandUrdf) return;
    if (!readContent(at, length)) return;
    McapContentReader content(content_);
    content.take(16);
    content.text();
    content.text();
    const std::string_view data = content.take(content.number<std::uint64_t>());
    const auto crc = content.number<std::uint32_t>();
    if (!content.ok()) return damage("has a damaged attachment" + mcapAt(at));
    const std::string_view before(content_.data(), content_.size() - content.rest().size() - 4);
    if (checksums_ && crc != 0 && crc != mcap_format::addToCrc(0, before))
      return damage("has a damaged attachment" + mcapAt(at) + ": its checksum is wrong");
    if (!result_.channels.budget.take(data.size()))
      return damage("has an attachment that is too large" + mcapAt(at));
    result_.attachments[name] = data;
  }

  void takeLoose(std::uint64_t at, std::uint64_t length) {
    if (length > kLargestMcapChunkBytes)
      return damage("has a message that is too large" + mcapAt(at));
    const std::uint64_t begin = at - mcap_format::kRecordHead;
    const std::uint64_t size = length + mcap_format::kRecordHead;
    if (loose_ && loose_->offset + loose_->packedSize == begin &&
        loose_->packedSize < kLoosePieceBytes) {
      loose_->packedSize += size;
    } else {
      endLoosePiece();
      loose_ = std::make_unique<McapPiece>();
      loose_->offset = begin;
      loose_->packedSize = size;
    }
    loose_->rawSize = loose_->packedSize;
  }
  void endLoosePiece() {
    if (loose_) result_.pieces.push_back(std::move(*loose_));
    loose_.reset();
  }

  void takeChunk(std::uint64_t at, std::uint64_t length) {
    endLoosePiece();
    constexpr std::uint64_t kMaxHead = 256;
    file_.read(at, static_cast<std::size_t>(std::min(length, kMaxHead)), content_);
    McapContentReader head(content_);
    McapPiece piece;
    head.number<std::uint64_t>();
    head.number<std::uint64_t>();
    piece.rawSize = head.number<std::uint64_t>();
    piece.crc = head.number<std::uint32_t>();
    piece.compression = head.text();
    piece.packedSize = head.number<std::uint64_t>();
    piece.offset = at + content_.size() - head.rest().size();
    if (!head.ok() || piece.packedSize > at + length - piece.offset)
      return damage("is damaged: the chunk" + mcapAt(at) + " has false lengths");
    if (std::max(piece.packedSize, piece.rawSize) > kLargestMcapChunkBytes)
      return damage("has a chunk of " +
                    std::to_string(std::max(piece.packedSize, piece.rawSize) >> 20) + " MB" +
                    mcapAt(at) + "; at most " + std::to_string(kLargestMcapChunkBytes >> 20) +
                    " MB are read");
    unpacked_ += piece.rawSize;
    if (unpacked_ > kMcapUnpackedBytes && unpacked_ / kMcapUnpackedPerByte > file_.size())
      return damage("has chunks that unpack to more than " + std::to_string(kMcapUnpackedPerByte) +
                    " times the size of the file" + mcapAt(at));
    if (result_.pieces.size() == INT32_MAX) return damage("has too many chunks");
    result_.pieces.push_back(std::move(piece));
  }

  void takeIndex(std::uint64_t at, std::uint64_t length) {
    if (length < 6 || result_.pieces.empty()) return;
    file_.read(at, 6, content_);
    McapContentReader content(content_);
    const auto channel = content.number<std::uint16_t>();
    const auto size = content.number<std::uint32_t>();
    std::vector<std::uint16_t>& indexed = result_.pieces.back().indexed;
    if (size > 0 && indexed.size() <= UINT16_MAX) indexed.push_back(channel);
  }

  void checkEnd() {
    const std::uint64_t left = file_.size() - position_;
    if (left < mcap_format::kMagic.size()) return damage("is cut off" + mcapAt(file_.size()));
    file_.read(position_, mcap_format::kMagic.size(), content_);
    if (content_ != mcap_format::kMagic || left > mcap_format::kMagic.size())
      damage("is damaged: it doesn't end as MCAP");
  }

  const McapFile& file_;
  const bool checksums_;
  const Progress& progress_;
  McapStructure result_;
  std::uint64_t position_ = 0;
  std::uint64_t summaryAt_ = 0;
  std::uint64_t unpacked_ = 0;  // bytes of all chunks
  std::size_t steps_ = 0;
  std::uint32_t crc_ = 0;
  const char* wrongChecksum_ = nullptr;  // of which part
  bool ended_ = false;
  std::string head_;
  std::string content_;
  std::string buffer_;
  std::unique_ptr<McapPiece> loose_;
};

}  // namespace

McapFile::McapFile(fs::path path)
    : path_(std::move(path)), file_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_.get() < 0)
    throw FileError(path_, "can't be opened: " + std::generic_category().message(errno));
  struct stat facts {};
  if (::fstat(file_.get(), &facts) != 0 || !S_ISREG(facts.st_mode))
    throw FileError(path_, "is not a file");
  size_ = static_cast<std::uint64_t>(facts.st_size);
  std::string start;
  if (size_ >= mcap_format::kMagic.size()) read(0, mcap_format::kMagic.size(), start);
  if (start != mcap_format::kMagic) throw FormatError(path_, "isn't an MCAP file of version 0");
}

void McapFile::read(std::uint64_t offset, std::size_t size, std::string& out) const {
  if (offset > size_ || size > size_ - offset)
    throw FormatError(path_, "is cut off or damaged", offset);
  out.resize(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t now =
        ::pread(file_.get(), out.data() + done, size - done, static_cast<off_t>(offset + done));
    if (now < 0 && errno == EINTR) continue;
    if (now < 0) throw FileError(path_, "can't be read: " + std::generic_category().message(errno));
    if (now == 0) throw FormatError(path_, "was cut off while it was read", offset + done);
    done += static_cast<std::size_t>(now);
  }
}

std::string McapChannels::add(std::uint8_t opcode, std::string_view content) {
  constexpr const char* kTooManyTexts = "has too many texts in its schemas and channels";
  McapContentReader reader(content);
  const auto id = reader.number<std::uint16_t>();
  if (opcode == mcap_format::kSchema) {
    McapSchema schema;
    schema.name = reader.text();
    schema.encoding = reader.text();
    if (!reader.ok()) return "has a damaged schema";
    if (!schemas.contains(id) && !budget.take(schema.name.size() + schema.encoding.size()))
      return kTooManyTexts;
    if (id != 0) schemas.emplace(id, std::move(schema));
    return "";
  }
  McapChannel channel;
  channel.schema = reader.number<std::uint16_t>();
  channel.topic = reader.text();
  channel.encoding = reader.text();
  // The summary has each again, which is not kept.
  McapTextBudget ofRepeated;
  McapTextBudget& used = channels.contains(id) ? ofRepeated : budget;
  if (!used.take(channel.topic.size() + channel.encoding.size()) ||
      !reader.texts(channel.metadata, used))
    return kTooManyTexts;
  if (!reader.ok()) return "has a damaged channel";
  channels.emplace(id, std::move(channel));
  return "";
}

McapStructure readMcapStructure(const McapFile& file, bool checksums, const Progress& progress) {
  return McapWalk(file, checksums, progress).walked();
}

std::string readMcapPiece(const McapFile& file, const McapPiece& piece, std::size_t index) {
  std::string packed;
  file.read(piece.offset, static_cast<std::size_t>(piece.packedSize), packed);
  const auto fail = [&](const std::string& fault) {
    throw FormatError(file.path(), "chunk " + std::to_string(index) + " " + fault, piece.offset);
  };
  std::string raw;
  if (piece.compression.empty() && packed.size() == piece.rawSize) {
    raw = std::move(packed);
  } else {
    const std::string fault =
        mcapDecompress(packed, piece.compression, static_cast<std::size_t>(piece.rawSize), raw);
    if (!fault.empty()) fail(fault);
  }
  if (piece.crc != 0 && piece.crc != mcap_format::addToCrc(0, raw))
    fail("is damaged: its checksum is wrong; 'palpate recover' saves the others");
  return raw;
}

std::string mcapFaultOf(const fs::path& path, const std::exception& error) {
  const std::string text = error.what();
  const std::string name = escapedLine(path.string()) + ": ";
  return text.starts_with(name) ? text.substr(name.size()) : text;
}

std::string mcapDamagedChunksText(std::size_t count,
                                  const std::string& firstFault,
                                  const char* lost) {
  return counted(count, "damaged chunk") + ", whose " + lost +
         " are lost (the first: " + firstFault + ")";
}

bool forEachMcapRecord(std::string_view records,
                       const std::function<void(std::uint8_t, std::string_view)>& visit) {
  McapContentReader reader(records);
  while (!reader.rest().empty()) {
    const auto opcode = reader.number<std::uint8_t>();
    const std::string_view content = reader.take(reader.number<std::uint64_t>());
    if (!reader.ok()) return false;
    visit(opcode, content);
  }
  return true;
}

bool readMcapMessage(std::string_view content, McapMessage& message) {
  McapContentReader reader(content);
  message.channel = reader.number<std::uint16_t>();
  reader.number<std::uint32_t>();
  message.logNs = reader.number<std::uint64_t>();
  reader.number<std::uint64_t>();
  message.data = reader.rest();
  return reader.ok();
}

}  // namespace palpate
