#include "recording/dsa/dsa_xml_stream.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/file_name.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/bzip2_blocks.h"

namespace palpate {
namespace {

constexpr std::size_t kFirstBytes = 64u << 10;  // read to tell the form
// Small chunks keep both threads busy within the one block of a small file.
constexpr std::size_t kChunkBytes = 8u << 10;
constexpr std::size_t kQueueChunks = 64;
// More threads would wait for the one that parses; each takes about 6 MB of memory.
constexpr std::size_t kMaxThreads = 8;
constexpr std::uint64_t kChunksPerCall = 32;  // of `meanwhile`

std::size_t threadsFor(std::size_t wanted) {
  const std::size_t threads =
      wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
  return std::min(threads, kMaxThreads);
}

// Whether bzip2 data that begins with `first` has several blocks, as far as can be told.
bool hasSeveralBlocks(std::span<const char> first, std::uint64_t numBytes) {
  if (numBytes > first.size()) return true;
  const std::span<const std::byte> bytes = std::as_bytes(first);
  std::size_t blocks = 0;
  for (auto mark = nextBzip2Mark(bytes, 0); mark; mark = nextBzip2Mark(bytes, mark->bit + 1))
    if (mark->block && ++blocks > 1) return true;
  return false;
}

// The first bytes as a person can read them: "\x89PNG".
std::string shownStart(std::string_view first) {
  constexpr std::size_t kShown = 8;
  std::string out = "\"";
  for (const char c : first.substr(0, kShown)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= ' ' && code < 0x7F) {
      out += c;
    } else {
      out += "\\x";
      appendHexDigits(out, code, 2);
    }
  }
  return out + (first.size() > kShown ? "..\"" : "\"");
}

}  // namespace

DsaEncoding dsaEncodingOf(std::string_view first) noexcept {
  constexpr std::string_view kBzip2 = "BZh";
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (first.size() <= kBzip2.size() && kBzip2.starts_with(first))
    return DsaEncoding::kBzip2;  // cut short
  if (first.starts_with(kBzip2) && first[3] >= '1' && first[3] <= '9') return DsaEncoding::kBzip2;
  if (first.starts_with(kByteOrderMark)) first.remove_prefix(kByteOrderMark.size());
  const std::size_t begin = first.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && first[begin] == '<' ? DsaEncoding::kXml
                                                                : DsaEncoding::kOther;
}

namespace {
// A table can't be opened, but imported.
std::string tableHint(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 6> kTables = {
      ".csv", ".tsv", ".txt", ".jsonl", ".npy", ".npz"};
  if (std::ranges::find(kTables, std::string_view(lowerEndingOf(path))) == kTables.end()) return {};
  return "; a table becomes a recording by File > Import (palpate import)";
}
}  // namespace

DsaEncoding requireDsaEncoding(std::string_view first, const std::filesystem::path& path) {
  if (first.empty()) throw FormatError(path, "is empty");
  const DsaEncoding form = dsaEncodingOf(first);
  if (form == DsaEncoding::kOther)
    throw FormatError(path,
                      "is not a .dsa recording (neither bzip2 nor XML; it starts with " +
                          shownStart(first) + ")" + tableHint(path));
  return form;
}

DsaXmlStream::DsaXmlStream(ByteSource& source,
                           std::filesystem::path path,
                           std::size_t threads,
                           std::function<void()> meanwhile)
    : source_(source),
      path_(std::move(path)),
      threads_(threadsFor(threads)),
      meanwhile_(std::move(meanwhile)),
      queue_(kQueueChunks) {
  first_.resize(kFirstBytes);
  first_.resize(source_.read(first_));
  if (requireDsaEncoding({first_.data(), first_.size()}, path_) == DsaEncoding::kXml) return;
  if (threads_ > 1 && hasSeveralBlocks(first_, source_.numBytes())) {
    try {
      parallel_ = std::make_unique<ParallelBzip2Decoder>(source_, first_, threads_);
      return;
    } catch (const std::system_error&) {
      // No thread to be had: the caller decodes by itself.
    }
  }
  decoder_ = std::make_unique<Bzip2Decoder>(source_, std::move(first_));
}

DsaXmlStream::~DsaXmlStream() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

DsaXmlStream::Chunk DsaXmlStream::decodeChunk() {
  Chunk chunk;
  try {
    chunk.bytes = std::make_unique_for_overwrite<char[]>(kChunkBytes);
    chunk.size = decoder_->read({chunk.bytes.get(), kChunkBytes});
  } catch (...) {
    chunk.size = 0;
    chunk.failure = std::current_exception();
  }
  chunk.bytesTaken = decoder_->bytesTaken();
  return chunk;
}

// The caller decodes the first chunk by itself and only then hands the decoder over: nothing could
// be done meanwhile, and it would wait for two wake-ups, a fifth of the time of a small file.
void DsaXmlStream::startThread() {
  try {
    thread_ = std::thread([this] { decodeAll(); });
  } catch (const std::system_error&) {
    // No thread to be had: next() goes on decoding by itself.
  }
}

void DsaXmlStream::decodeAll() {
  for (bool more = true; more;) {
    Chunk chunk = decodeChunk();
    more = chunk.size > 0;
    if (!queue_.push(std::move(chunk))) return;
  }
  queue_.close();
}

std::string_view DsaXmlStream::next() {
  if (!compressed()) return nextOfText();
  try {
    return parallel_ ? nextOfBlocks() : nextInOrder();
  } catch (const FileError&) {
    throw;
  } catch (const FormatError&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw FormatError(path_, error.what());
  }
}

std::string_view DsaXmlStream::nextOfText() {
  if (std::exchange(firstTaken_, true)) {
    first_.resize(kFirstBytes);
    first_.resize(source_.read(first_));
  }
  bytesTaken_ += first_.size();
  return {first_.data(), first_.size()};
}

std::string_view DsaXmlStream::nextInOrder() {
  return taken(thread_.joinable() ? queue_.pop().value_or(Chunk{}) : decodeChunk());
}

std::string_view DsaXmlStream::taken(Chunk chunk) {
  chunk_ = std::move(chunk);
  if (!std::exchange(firstTaken_, true) && chunk_.size == kChunkBytes && threads_ > 1)
    startThread();
  bytesTaken_ = std::max(bytesTaken_, chunk_.bytesTaken);
  if (chunk_.failure) std::rethrow_exception(chunk_.failure);
  return {chunk_.bytes.get(), chunk_.size};
}

std::string_view DsaXmlStream::nextOfBlocks() {
  const std::optional<std::string_view> chunk = parallel_->next(kChunkBytes);
  bytesTaken_ = parallel_->bytesTaken();
  return chunk ? *chunk : taken(startAgain());
}

// The blocks are irregular: what is wrong, and where, is found by decoding in order. Skips the
// chunks that were handed out already, and returns the next one.
DsaXmlStream::Chunk DsaXmlStream::startAgain() {
  const std::unique_ptr<ParallelBzip2Decoder> parallel = std::move(parallel_);
  parallel->stop();
  source_.rewind();
  decoder_ = std::make_unique<Bzip2Decoder>(source_, std::vector<char>());
  for (std::uint64_t chunks = 0;; ++chunks) {
    if (meanwhile_ && chunks % kChunksPerCall == 0) meanwhile_();
    Chunk chunk = decodeChunk();
    const bool isNext = chunks * kChunkBytes >= parallel->bytesHandedOut();
    const bool ended = chunk.failure || chunk.size == 0;
    if (isNext && ended) return chunk;
    if (chunk.failure) std::rethrow_exception(chunk.failure);
    if (ended || !parallel->sameAsHandedOut({chunk.bytes.get(), chunk.size}))
      throw Error("it was changed while it was read");
    if (isNext) return chunk;
  }
}

double DsaXmlStream::fraction() const noexcept {
  const std::uint64_t all = std::max<std::uint64_t>(source_.numBytes(), 1);
  return std::min(1.0, static_cast<double>(bytesTaken_) / static_cast<double>(all));
}

}  // namespace palpate
