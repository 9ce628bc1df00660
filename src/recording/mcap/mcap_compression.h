// The compressions of a chunk: LZ4 frames and Zstandard. Private to this module.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "palpate/recording/mcap_recording.h"

namespace palpate {

// The value of a chunk's field `compression`: "", "lz4", "zstd".
const char* mcapNameInFile(McapCompression compression) noexcept;

// `level` is that of Zstandard. Throws Error (out of memory).
std::string mcapCompressed(std::string_view raw, McapCompression compression, int level);

// Puts the bytes that were compressed into `raw`. Returns what is wrong, or an empty text: an
// unknown compression, damaged bytes, or another number of bytes than `size`. Memory grows with
// what is really there, not with `size`.
std::string mcapDecompress(std::string_view packed,
                           std::string_view compression,
                           std::size_t size,
                           std::string& raw);

}  // namespace palpate
