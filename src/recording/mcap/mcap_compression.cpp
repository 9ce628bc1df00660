#include "recording/mcap/mcap_compression.h"

#include <algorithm>
#include <memory>

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "recording/mcap/mcap_format.h"

namespace palpate {
namespace {

// Memory for the result grows by steps, which are in proportion to what is to be decompressed: a
// false size costs little.
constexpr std::size_t kMinMcapStep = 64u << 10;
constexpr std::size_t kMaxMcapStep = 4u << 20;
constexpr std::size_t kMcapStepPerByte = 32;

std::string mcapLz4(std::string_view raw) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.blockSizeID = LZ4F_max256KB;
  preferences.frameInfo.blockMode = LZ4F_blockLinked;
  preferences.frameInfo.contentSize = raw.size();
  std::string packed(LZ4F_compressFrameBound(raw.size(), &preferences), '\0');
  const std::size_t size =
      LZ4F_compressFrame(packed.data(), packed.size(), raw.data(), raw.size(), &preferences);
  if (LZ4F_isError(size)) throw Error(std::string("LZ4: ") + LZ4F_getErrorName(size));
  packed.resize(size);
  return packed;
}

std::string mcapZstd(std::string_view raw, int level) {
  std::string packed(ZSTD_compressBound(raw.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), level);
  if (ZSTD_isError(size)) throw Error(std::string("Zstandard: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

// Calls decompress(out, outSize, in, inSize) until all is taken: it sets both sizes to what it used
// and returns a fault or an empty text.
template <typename Step>
std::string mcapDecompressBy(Step decompress,
                             std::string_view packed,
                             std::size_t size,
                             std::string& raw) {
  raw.clear();
  raw.reserve(size + 1);  // takes no memory before it is written to
  const std::size_t step = std::clamp(kMcapStepPerByte * packed.size(), kMinMcapStep, kMaxMcapStep);
  std::size_t used = 0;
  std::size_t made = 0;
  while (true) {
    // One byte more than declared: what is too long is seen.
    raw.resize(std::min(size + 1, made + step));
    std::size_t in = packed.size() - used;
    std::size_t out = raw.size() - made;
    std::string fault = decompress(raw.data() + made, out, packed.data() + used, in);
    if (!fault.empty()) return fault;
    used += in;
    made += out;
    if (made > size) return "has more bytes than it says";
    if (in == 0 && out == 0) break;
    if (used == packed.size() && made < raw.size()) break;
  }
  raw.resize(made);
  return made == size && used == packed.size() ? "" : "is cut off";
}

std::string mcapFromLz4(std::string_view packed, std::size_t size, std::string& raw) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(
      made, LZ4F_freeDecompressionContext);
  return mcapDecompressBy(
      [&](char* out, std::size_t& outSize, const char* in, std::size_t& inSize) -> std::string {
        const std::size_t result =
            LZ4F_decompress(context.get(), out, &outSize, in, &inSize, nullptr);
        return LZ4F_isError(result) ? std::string("is damaged: ") + LZ4F_getErrorName(result) : "";
      },
      packed,
      size,
      raw);
}

std::string mcapFromZstd(std::string_view packed, std::size_t size, std::string& raw) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(),
                                                                        ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  return mcapDecompressBy(
      [&](char* out, std::size_t& outSize, const char* in, std::size_t& inSize) -> std::string {
        ZSTD_outBuffer to{out, outSize, 0};
        ZSTD_inBuffer from{in, inSize, 0};
        const std::size_t result = ZSTD_decompressStream(context.get(), &to, &from);
        outSize = to.pos;
        inSize = from.pos;
        return ZSTD_isError(result) ? std::string("is damaged: ") + ZSTD_getErrorName(result) : "";
      },
      packed,
      size,
      raw);
}

}  // namespace

namespace mcap_format {

std::uint32_t addToCrc(std::uint32_t crc, std::string_view bytes) noexcept {
  if (bytes.empty()) return crc;  // zlib would start its checksum over
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace mcap_format

const char* nameOf(McapCompression compression) noexcept {
  switch (compression) {
    case McapCompression::kNone:
      return "none";
    case McapCompression::kLz4:
      return "lz4";
    case McapCompression::kZstd:
      return "zstd";
  }
  return "";
}

const char* mcapNameInFile(McapCompression compression) noexcept {
  return compression == McapCompression::kNone ? "" : nameOf(compression);
}

std::string mcapCompressed(std::string_view raw, McapCompression compression, int level) {
  switch (compression) {
    case McapCompression::kLz4:
      return mcapLz4(raw);
    case McapCompression::kZstd:
      return mcapZstd(raw, level);
    case McapCompression::kNone:
      break;
  }
  return std::string(raw);
}

std::string mcapDecompress(std::string_view packed,
                           std::string_view compression,
                           std::size_t size,
                           std::string& raw) {
  if (compression.empty()) {
    raw = packed;
    return raw.size() == size ? "" : "has a different size than it says";
  }
  if (compression == "lz4") return mcapFromLz4(packed, size, raw);
  if (compression == "zstd") return mcapFromZstd(packed, size, raw);
  return "has an unknown compression, " + inQuotes(compression) +
         "; write it with zstd, lz4 or without";
}

}  // namespace palpate
