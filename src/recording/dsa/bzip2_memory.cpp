#include "recording/dsa/bzip2_memory.h"

#include <cstddef>
#include <cstdlib>
#include <utility>

namespace palpate {
namespace {

// Stands in front of each piece, and keeps what follows aligned.
struct alignas(std::max_align_t) PieceHeader {
  std::size_t size = 0;
};
constexpr std::size_t kSmallestKept = 1u << 20;

struct KeptPiece {
  ~KeptPiece() { std::free(header); }
  PieceHeader* header = nullptr;
};
thread_local KeptPiece keptPiece;

void* allocatePiece(void*, int count, int itemSize) {
  const std::size_t size = static_cast<std::size_t>(count) * static_cast<std::size_t>(itemSize);
  PieceHeader* header = nullptr;
  if (keptPiece.header && size >= kSmallestKept && keptPiece.header->size >= size) {
    header = std::exchange(keptPiece.header, nullptr);
  } else {
    header = static_cast<PieceHeader*>(std::malloc(sizeof(PieceHeader) + size));
    if (!header) return nullptr;
    header->size = size;
  }
  return header + 1;
}

void releasePiece(void*, void* piece) {
  if (!piece) return;
  PieceHeader* header = static_cast<PieceHeader*>(piece) - 1;
  if (header->size >= kSmallestKept && (!keptPiece.header || keptPiece.header->size < header->size))
    std::swap(header, keptPiece.header);
  std::free(header);
}

}  // namespace

void useKeptMemory(bz_stream& stream) noexcept {
  stream.bzalloc = &allocatePiece;
  stream.bzfree = &releasePiece;
}

}  // namespace palpate
