#include "recording/dsa/bzip2_decoder.h"

#include <new>
#include <string>
#include <utility>

#include <bzlib.h>

#include "palpate/core/error.h"

#include "recording/dsa/bzip2_memory.h"

namespace palpate {
namespace {

constexpr std::size_t kInputBytes = 64u << 10;

}  // namespace

struct Bzip2Decoder::Stream {
  Stream() { useKeptMemory(z); }
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
      throw Error("bytes that are not bzip2 data follow the recording, from byte " +
                  std::to_string(streamBegin_) + " of the file");
    } else if (result != BZ_OK) {
      throw Error("its bzip2 data is damaged near" + place() + kDsaRecoverHint);
    } else if (z.avail_out > 0 && z.avail_in == 0 && !refill()) {
      // A block comes out when all of it is there.
      const bool wholeBlocks = numStreams_ > 0 || z.total_out_lo32 > 0 || z.total_out_hi32 > 0;
      throw Error("its bzip2 data ends early, at" + place() +
                  (wholeBlocks
                       ? std::string(": the file is cut") + kDsaRecoverHint
                       : ": the file is cut within its first block, nothing of it can be read"));
    }
  }
  return out.size() - z.avail_out;
}

}  // namespace palpate
