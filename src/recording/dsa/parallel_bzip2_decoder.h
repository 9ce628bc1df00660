// Decodes bzip2 data on several threads. The blocks are found by their marks, each is decoded by
// libbz2 in a stream of its own, and the text is handed out in order. Private to this module.
//
// A block counts only if it begins where the block before it has ended, if it ends exactly at the
// next mark, and if its checksum is right; so bits within a block that happen to look like a mark
// do no harm. Whatever is not as it should be (damage, the end of a cut file, bytes behind the
// last stream, a wrong checksum of a stream) is not judged here: Bzip2Decoder reads the file again
// and says what is wrong, with the same words and positions as ever.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "palpate/recording/bzip2_blocks.h"

#include "recording/dsa/byte_source.h"
#include "recording/dsa/bzip2_block_reader.h"

namespace palpate {

class ParallelBzip2Decoder {
 public:
  // Starts `threads` threads (at least one; fewer when no more are to be had). `first` are bytes
  // already taken from `source`, which must outlive the decoder and must not be used by others
  // until the decoder is stopped. Throws std::system_error when not even one thread can be started.
  ParallelBzip2Decoder(ByteSource& source, std::vector<char> first, std::size_t threads);
  ~ParallelBzip2Decoder();
  ParallelBzip2Decoder(const ParallelBzip2Decoder&) = delete;
  ParallelBzip2Decoder& operator=(const ParallelBzip2Decoder&) = delete;

  // The next chunk of `chunkBytes` bytes, valid until the next call; fewer only at the end, empty
  // behind it. Nothing when the data is irregular from here on. Always the same chunkBytes.
  std::optional<std::string_view> next(std::size_t chunkBytes);
  std::uint64_t bytesTaken() const noexcept { return bytesTaken_; }  // of the source

  // Ends the threads. To be called before the functions below.
  void stop();
  std::uint64_t bytesHandedOut() const noexcept { return handedOut_; }
  // For the decoder that starts again from the beginning: compares its text with the text that was
  // handed out, piece after piece. Returns false when they differ: the source has changed.
  bool sameAsHandedOut(std::string_view piece);

 private:
  struct Piece {
    std::unique_ptr<char[]> bytes;
    std::size_t size = 0;
  };
  enum class State { kDecoding, kDone, kIrregular, kEnd };
  struct Block {
    Bzip2BlockReader::Block source;
    std::vector<Piece> pieces;
    State state = State::kDecoding;
  };
  // A block whose text was handed out completely.
  struct FinishedBlock {
    std::uint64_t textEnd = 0;
    std::uint32_t checksum = 0;
  };
  void work();
  std::shared_ptr<Block> takeBlock();
  void decode(Block& block);
  bool addPiece(Block& block, Piece piece);
  void setState(Block& block, State state);
  State awaitText();

  std::mutex readingMutex_;  // taken before mutex_
  Bzip2BlockReader reader_;
  bool readerEnded_ = false;
  const std::size_t maxBlocks_;

  std::mutex mutex_;                           // guards the members up to the empty line
  std::condition_variable changed_;            // for the consumer
  std::condition_variable hasSpace_;           // for the threads
  std::deque<std::shared_ptr<Block>> blocks_;  // in order; the first is being handed out
  bool stopped_ = false;

  // Of the consumer.
  std::size_t nextPiece_ = 0;    // of the first block
  std::string_view text_;        // what is left of the piece before
  std::vector<char> chunk_;      // of parts of several pieces
  std::uint64_t handedOut_ = 0;  // [bytes]
  std::uint64_t taken_ = 0;      // [bytes] of text, also of a chunk that was not completed
  std::uint64_t bytesTaken_ = 0;
  std::vector<FinishedBlock> finished_;

  // Of sameAsHandedOut().
  std::uint64_t compared_ = 0;  // [bytes]
  std::size_t comparedBlocks_ = 0;
  Bzip2Checksum comparison_;

  std::vector<std::jthread> threads_;
};

}  // namespace palpate
