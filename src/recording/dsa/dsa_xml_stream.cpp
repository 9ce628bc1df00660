#include "recording/dsa/dsa_xml_stream.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include <bzlib.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

constexpr std::size_t kInputBytes = 64u << 10;

constexpr std::size_t kFirstBytes = 64u << 10;  // read to tell the form
// Small chunks keep both threads busy within the one block of a small file.
constexpr std::size_t kChunkBytes = 8u << 10;
constexpr std::size_t kQueueChunks = 64;

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

// Without O_NONBLOCK a named pipe would wait for a writer for ever.
FileSource::FileSource(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_.get() < 0) throw FileError(path_, "can't be opened: " + reason(errno));
  struct stat status {};
  const int failed = ::fstat(descriptor_.get(), &status);
  const int error = errno;
  if (failed == 0 && S_ISREG(status.st_mode)) {
    numBytes_ = static_cast<std::uint64_t>(status.st_size);
    return;
  }
  if (failed != 0) throw FileError(path_, "can't be read: " + reason(error));
  throw FileError(
      path_, S_ISDIR(status.st_mode) ? "is a folder, not a recording" : "is not a regular file");
}

std::size_t FileSource::read(std::span<char> out) {
  std::size_t size = 0;
  while (size < out.size()) {
    const ssize_t got = ::read(descriptor_.get(), out.data() + size, out.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(path_, "can't be read: " + reason(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  return size;
}

std::size_t MemorySource::read(std::span<char> out) {
  const std::size_t size = std::min(out.size(), bytes_.size() - position_);
  if (size > 0) std::memcpy(out.data(), bytes_.data() + position_, size);
  position_ += size;
  return size;
}

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

struct Bzip2Decoder::Stream {
  ~Stream() {
    if (open) BZ2_bzDecompressEnd(&z);
  }
  bz_stream z{};
  bool open = false;
};

Bzip2Decoder::Bzip2Decoder(ByteSource& source, std::vector<char> first)
    : source_(source),
      input_(std::move(first)),
      stream_(std::make_unique<Stream>()),
      inputEnd_(input_.size()) {
  stream_->z.next_in = input_.data();
  stream_->z.avail_in = static_cast<unsigned>(input_.size());
}

Bzip2Decoder::~Bzip2Decoder() = default;

std::uint64_t Bzip2Decoder::bytesTaken() const noexcept { return inputEnd_ - stream_->z.avail_in; }

// False: the source has no more bytes.
bool Bzip2Decoder::refill() {
  if (sourceEnded_) return false;
  input_.resize(kInputBytes);
  const std::size_t size = source_.read(input_);
  sourceEnded_ = size == 0;
  inputEnd_ += size;
  stream_->z.next_in = input_.data();
  stream_->z.avail_in = static_cast<unsigned>(size);
  return size > 0;
}

void Bzip2Decoder::open() {
  if (BZ2_bzDecompressInit(&stream_->z, 0, 0) != BZ_OK) throw std::bad_alloc();
  stream_->open = true;
  streamBegin_ = bytesTaken();
}

std::size_t Bzip2Decoder::read(std::span<char> out) {
  bz_stream& z = stream_->z;
  z.next_out = out.data();
  z.avail_out = static_cast<unsigned>(out.size());
  while (z.avail_out > 0) {
    if (!stream_->open) {
      if (z.avail_in == 0 && !refill()) break;
      open();
    }
    const int result = BZ2_bzDecompress(&z);
    const auto place = [&] { return " byte " + std::to_string(bytesTaken()) + " of the file"; };
    if (result == BZ_STREAM_END) {
      BZ2_bzDecompressEnd(&z);
      stream_->open = false;
      ++numStreams_;
    } else if (result == BZ_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result == BZ_DATA_ERROR_MAGIC && numStreams_ > 0) {
      throw Error("bytes that are no bzip2 data follow the recording, from byte " +
                  std::to_string(streamBegin_) + " of the file");
    } else if (result != BZ_OK) {
      throw Error("its bzip2 data is damaged near" + place() +
                  "; palpate recover may save the frames of its other blocks");
    } else if (z.avail_out > 0 && z.avail_in == 0 && !refill()) {
      throw Error("its bzip2 data ends early, at" + place() +
                  ": the file is cut; palpate recover may save the frames of its whole blocks");
    }
  }
  return out.size() - z.avail_out;
}

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

DsaEncoding requireDsaEncoding(std::string_view first, const std::filesystem::path& path) {
  if (first.empty()) throw FormatError(path, "is empty");
  const DsaEncoding form = dsaEncodingOf(first);
  if (form == DsaEncoding::kOther)
    throw FormatError(path,
                      "is not a .dsa recording (neither bzip2 nor XML; it starts with " +
                          shownStart(first) + ")");
  return form;
}

DsaXmlStream::DsaXmlStream(ByteSource& source, std::filesystem::path path)
    : source_(source), path_(std::move(path)), queue_(kQueueChunks) {
  first_.resize(kFirstBytes);
  first_.resize(source_.read(first_));
  if (requireDsaEncoding({first_.data(), first_.size()}, path_) == DsaEncoding::kXml) return;
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
  if (!compressed()) {
    if (std::exchange(firstTaken_, true)) {
      first_.resize(kFirstBytes);
      first_.resize(source_.read(first_));
    }
    bytesTaken_ += first_.size();
    return {first_.data(), first_.size()};
  }
  chunk_ = thread_.joinable() ? queue_.pop().value_or(Chunk{}) : decodeChunk();
  if (!std::exchange(firstTaken_, true) && chunk_.size == kChunkBytes) startThread();
  bytesTaken_ = chunk_.bytesTaken;
  if (chunk_.failure) {
    try {
      std::rethrow_exception(chunk_.failure);
    } catch (const FileError&) {
      throw;
    } catch (const Error& error) {
      throw FormatError(path_, error.what());
    }
  }
  return {chunk_.bytes.get(), chunk_.size};
}

double DsaXmlStream::fraction() const noexcept {
  const std::uint64_t all = std::max<std::uint64_t>(source_.numBytes(), 1);
  return std::min(1.0, static_cast<double>(bytesTaken_) / static_cast<double>(all));
}

}  // namespace palpate
