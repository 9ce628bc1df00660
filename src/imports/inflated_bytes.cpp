#include "imports/inflated_bytes.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>
#include <vector>

#include <zlib.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

constexpr std::size_t kSkippedAtOnce = 1u << 16;

}  // namespace

void SequentialReader::skip(std::uint64_t count) {
  std::vector<std::byte> piece(
      static_cast<std::size_t>(std::min<std::uint64_t>(count, kSkippedAtOnce)));
  while (count > 0) {
    const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(count, piece.size()));
    read(std::span(piece).first(now));
    count -= now;
  }
}

struct InflatedBytes::Stream {
  explicit Stream(Deflate form) {
    if (inflateInit2(&stream, form == Deflate::kRaw ? -MAX_WBITS : MAX_WBITS) != Z_OK)
      throw std::bad_alloc();
  }
  ~Stream() { inflateEnd(&stream); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  z_stream stream{};
  std::array<std::byte, 1u << 16> packed{};
};

InflatedBytes::InflatedBytes(const RandomReader& file,
                             std::uint64_t offset,
                             std::uint64_t packedBytes,
                             Deflate form,
                             std::string name)
    : file_(file),
      offset_(offset),
      packedLeft_(packedBytes),
      name_(std::move(name)),
      stream_(std::make_unique<Stream>(form)) {}

InflatedBytes::~InflatedBytes() = default;

void InflatedBytes::throwDamaged(const char* what) const {
  throw FormatError(file_.path(), "is damaged: " + inQuotes(name_) + " " + what);
}

bool InflatedBytes::inflateTo(std::span<std::byte> bytes, std::size_t& filled) {
  z_stream& stream = stream_->stream;
  filled = 0;
  while (filled < bytes.size()) {
    if (stream.avail_in == 0 && packedLeft_ > 0) {
      const std::size_t count =
          static_cast<std::size_t>(std::min<std::uint64_t>(stream_->packed.size(), packedLeft_));
      file_.read(offset_, std::span(stream_->packed).first(count));
      offset_ += count;
      packedLeft_ -= count;
      stream.next_in = reinterpret_cast<Bytef*>(stream_->packed.data());
      stream.avail_in = static_cast<uInt>(count);
    }
    constexpr std::size_t kMaxAtOnce = 1u << 30;
    const auto room = static_cast<uInt>(std::min(bytes.size() - filled, kMaxAtOnce));
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + filled);
    stream.avail_out = room;
    const int outcome = inflate(&stream, Z_NO_FLUSH);
    filled += room - stream.avail_out;
    if (outcome == Z_STREAM_END) return true;
    // Without new bytes the stream may still have some to give.
    if (outcome == Z_BUF_ERROR && stream.avail_in == 0 && packedLeft_ == 0)
      throwDamaged("ends too early");
    if (outcome != Z_OK && outcome != Z_BUF_ERROR) throwDamaged("can't be decompressed");
  }
  return false;
}

void InflatedBytes::read(std::span<std::byte> bytes) {
  std::size_t filled = 0;
  if (inflateTo(bytes, filled) && filled < bytes.size()) throwDamaged("ends too early");
}

void InflatedBytes::finish() {
  constexpr std::size_t kPadding = 8;
  std::array<std::byte, kPadding> more{};
  std::size_t filled = 0;
  if (!inflateTo(more, filled)) throwDamaged("holds more than it declares");
}

}  // namespace palpate
