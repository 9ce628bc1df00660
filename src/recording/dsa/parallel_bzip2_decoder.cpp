#include "recording/dsa/parallel_bzip2_decoder.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include <bzlib.h>

#include "recording/dsa/bzip2_memory.h"

namespace palpate {
namespace {

// The consumer begins with a block's text before the block is complete.
constexpr std::size_t kPieceBytes = 64u << 10;
// A block holds 900 kB before its first run-length code, which stretches the text of recordings by
// a few per cent. Blocks of more text than this are left to Bzip2Decoder, which does not keep them.
constexpr std::size_t kMaxPieces = 32;
// Blocks ahead of the threads: one is being handed out, one lies ready.
constexpr std::size_t kBlocksAhead = 2;

struct LibraryStream {
  LibraryStream() {
    useKeptMemory(z);
    if (BZ2_bzDecompressInit(&z, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~LibraryStream() { BZ2_bzDecompressEnd(&z); }
  LibraryStream(const LibraryStream&) = delete;
  LibraryStream& operator=(const LibraryStream&) = delete;
  bz_stream z{};
};

}  // namespace

ParallelBzip2Decoder::ParallelBzip2Decoder(ByteSource& source,
                                           std::vector<char> first,
                                           std::size_t threads)
    : reader_(source, std::move(first)), maxBlocks_(threads + kBlocksAhead) {
  threads_.reserve(threads);
  try {
    while (threads_.size() < std::max<std::size_t>(threads, 1))
      threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;
  }
}

ParallelBzip2Decoder::~ParallelBzip2Decoder() { stop(); }

void ParallelBzip2Decoder::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  hasSpace_.notify_all();
  threads_.clear();
}

void ParallelBzip2Decoder::work() {
  while (const std::shared_ptr<Block> block = takeBlock()) {
    try {
      decode(*block);
    } catch (const std::bad_alloc&) {
      setState(*block, State::kIrregular);
    }
  }
}

// Reads the next block and puts it at the end of blocks_. Returns nothing when there is none.
std::shared_ptr<ParallelBzip2Decoder::Block> ParallelBzip2Decoder::takeBlock() {
  const std::lock_guard reading(readingMutex_);
  {
    std::unique_lock lock(mutex_);
    hasSpace_.wait(lock, [&] { return stopped_ || blocks_.size() < maxBlocks_; });
    if (stopped_) return nullptr;
  }
  if (readerEnded_) return nullptr;
  auto block = std::make_shared<Block>();
  State state = State::kIrregular;
  try {
    const auto next = reader_.next(block->source);
    if (next == Bzip2BlockReader::Next::kBlock) state = State::kDecoding;
    if (next == Bzip2BlockReader::Next::kEnd) state = State::kEnd;
  } catch (const std::exception&) {
    // The decoder that starts again meets the same failure, and says so.
  }
  block->state = state;
  readerEnded_ = state != State::kDecoding;
  const std::lock_guard lock(mutex_);
  blocks_.push_back(block);
  if (!readerEnded_) return block;
  changed_.notify_one();
  return nullptr;
}

void ParallelBzip2Decoder::decode(Block& block) {
  LibraryStream stream;
  bz_stream& z = stream.z;
  std::vector<char>& in = block.source.stream;
  z.next_in = in.data();
  z.avail_in = static_cast<unsigned>(in.size());
  for (std::size_t numPieces = 0; numPieces < kMaxPieces; ++numPieces) {
    Piece piece{std::make_unique_for_overwrite<char[]>(kPieceBytes), 0};
    z.next_out = piece.bytes.get();
    z.avail_out = static_cast<unsigned>(kPieceBytes);
    const int result = BZ2_bzDecompress(&z);
    piece.size = kPieceBytes - z.avail_out;
    if (z.avail_out > 0 || result != BZ_OK) {
      // libbz2 has checked the block's checksum, and that the mark follows, unless the input ended
      // within the block: then there is no text of it.
      const bool endsAtMark = block.source.endsStream ? result == BZ_STREAM_END : result == BZ_OK;
      const bool right = endsAtMark && z.avail_in == 0 && (numPieces > 0 || piece.size > 0);
      if (right && piece.size > 0 && !addPiece(block, std::move(piece))) return;
      return setState(block, right ? State::kDone : State::kIrregular);
    }
    // The text is handed out before its checksum is known, as Bzip2Decoder does; but only if its
    // code ended before the next mark, so that both decoders give the same text.
    if (numPieces == 0 && in.size() - z.avail_in > block.source.numBytes) break;
    if (!addPiece(block, std::move(piece))) return;
  }
  setState(block, State::kIrregular);
}

// Returns false when the decoder is stopped.
bool ParallelBzip2Decoder::addPiece(Block& block, Piece piece) {
  const std::lock_guard lock(mutex_);
  block.pieces.push_back(std::move(piece));
  if (!blocks_.empty() && blocks_.front().get() == &block) changed_.notify_one();
  return !stopped_;
}

void ParallelBzip2Decoder::setState(Block& block, State state) {
  const std::lock_guard lock(mutex_);
  block.state = state;
  changed_.notify_one();
}

// Waits until text_ is not empty (kDecoding), or for the end of all text or of regular text.
ParallelBzip2Decoder::State ParallelBzip2Decoder::awaitText() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] {
      return !blocks_.empty() && (nextPiece_ < blocks_.front()->pieces.size() ||
                                  blocks_.front()->state != State::kDecoding);
    });
    const Block& block = *blocks_.front();
    if (nextPiece_ < block.pieces.size()) {
      const Piece& piece = block.pieces[nextPiece_++];
      text_ = {piece.bytes.get(), piece.size};
      return State::kDecoding;
    }
    if (block.state != State::kIrregular) bytesTaken_ = block.source.bytesTaken;
    if (block.state != State::kDone) return block.state;
    finished_.push_back({taken_, block.source.checksum});
    blocks_.pop_front();
    nextPiece_ = 0;
    hasSpace_.notify_one();
  }
}

std::optional<std::string_view> ParallelBzip2Decoder::next(std::size_t chunkBytes) {
  chunk_.clear();
  while (chunk_.size() < chunkBytes) {
    if (text_.empty()) {
      const State state = awaitText();
      if (state == State::kIrregular) return std::nullopt;
      if (state == State::kEnd) break;
    }
    const std::string_view part = text_.substr(0, chunkBytes - chunk_.size());
    text_.remove_prefix(part.size());
    taken_ += part.size();
    if (part.size() == chunkBytes) {  // the usual case, without a copy
      handedOut_ += part.size();
      return part;
    }
    chunk_.insert(chunk_.end(), part.begin(), part.end());
  }
  handedOut_ += chunk_.size();
  return std::string_view(chunk_.data(), chunk_.size());
}

bool ParallelBzip2Decoder::sameAsHandedOut(std::string_view piece) {
  while (!piece.empty() && compared_ < taken_) {
    if (comparedBlocks_ < finished_.size()) {
      const FinishedBlock& block = finished_[comparedBlocks_];
      const std::string_view part = piece.substr(0, block.textEnd - compared_);
      comparison_.add(part);
      piece.remove_prefix(part.size());
      compared_ += part.size();
      if (compared_ < block.textEnd) continue;
      if (comparison_.value() != block.checksum) return false;
      comparison_ = {};
      ++comparedBlocks_;
      continue;
    }
    // Text of the block that was not completed: it is still there.
    const std::uint64_t begin = finished_.empty() ? 0 : finished_.back().textEnd;
    const auto offset = static_cast<std::size_t>(compared_ - begin);
    const Piece& kept = blocks_.front()->pieces[offset / kPieceBytes];
    const std::size_t inPiece = offset % kPieceBytes;
    const std::string_view part =
        piece.substr(0, std::min<std::uint64_t>(kept.size - inPiece, taken_ - compared_));
    if (std::memcmp(part.data(), kept.bytes.get() + inPiece, part.size()) != 0) return false;
    piece.remove_prefix(part.size());
    compared_ += part.size();
  }
  return true;
}

}  // namespace palpate
