// Reads a .dsa recording: bzip2-compressed (or plain) XML of the prior program, streaming; the
// blocks of the file are decompressed on several threads. Format: docs/notes/dsa_format.md.
//
// Strict: a file that is damaged anywhere gives one exception and no profile. What costs nothing is
// a warning in the profile's info: declared counts that are wrong, unknown elements, odd masks,
// missing optional elements, stamps that had to be moved to increase strictly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

struct DsaReadOptions {
  // Bounds against bombs. A file may expand beyond `freeBytes` only as long as it stays below
  // `maxRatio` bytes of XML per byte of file (real recordings: 14; an empty hand for a day: about
  // 60).
  std::uint64_t freeBytes = 32u << 20;  // [bytes]
  double maxRatio = 300.0;
  // The same for the profile in memory, where an empty frame of a large matrix is what a bomb is
  // made of (real recordings: below 10 bytes per byte of file; an empty hand for a day: about 40;
  // plain XML: below 1).
  std::uint64_t freeMemoryBytes = 64u << 20;  // [bytes]
  double maxMemoryRatio = 64.0;
  double maxMemoryRatioPlain = 4.0;  // of plain XML
  std::size_t maxMatrices = 64;
  std::size_t maxPlaces = 65536;  // of all matrices together
  // Threads that decompress, besides the caller's, which parses (at most 8 are used). 0: as many as
  // the machine runs at once. 1: the caller's thread does everything; for callers that read several
  // files at once.
  std::size_t threads = 0;
};

// Reads a recording. Throws FileError (can't be opened or read), FormatError (not a .dsa, damaged;
// with the place in the decompressed text), Cancelled.
Profile readDsa(const std::filesystem::path& path,
                const Progress& progress = {},
                const DsaReadOptions& options = {});

// The same for a recording that is in memory; `name` stands for the path in messages.
Profile readDsaBytes(std::span<const std::byte> bytes,
                     const std::filesystem::path& name,
                     const DsaReadOptions& options = {});

// How much of a .dsa can be read.
struct DsaVerifyReport {
  enum class State { kSound, kDamaged, kUnreadable };
  State state = State::kUnreadable;
  std::size_t frames = 0;  // complete frames that can be read (all, when sound)
  std::size_t angles = 0;
  std::size_t temperatures = 0;
  std::string message;  // empty when sound; else what is wrong, and where
};

// Checks every byte of a recording. Never throws for a bad file; throws Cancelled.
DsaVerifyReport verifyDsa(const std::filesystem::path& path,
                          const Progress& progress = {},
                          const DsaReadOptions& options = {});

}  // namespace palpate
