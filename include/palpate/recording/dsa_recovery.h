// What can be saved of a damaged .dsa recording: all complete frames, angles and temperatures of
// every intact bzip2 block, also behind the damage; of plain XML, all that are well-formed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>
#include <palpate/recording/dsa_reader.h>

namespace palpate {

struct DsaRecovery {
  // The samples that were saved; nothing when there are none. info().warnings says what is missing.
  std::optional<Profile> profile;
  std::size_t frames = 0;  // saved, with the values that were written
  std::size_t angles = 0;
  std::size_t temperatures = 0;
  std::size_t cutSamples = 0;  // at the edge of something damaged: their rest is lost
  std::size_t badSamples = 0;  // complete, but wrong
  std::size_t blocks = 0;      // bzip2 blocks found; 0 in plain XML
  std::size_t intactBlocks = 0;
  // The layout was lost: that of the SDH-2 is assumed, to which every saved frame fits.
  bool layoutAssumed = false;
  // One event "gap" for each span of lost frames, known by the numbers of the frames and by joint
  // angles where there are no frames. In order of time.
  std::vector<Event> losses;
  // What the losses say, in one line; empty when there are none.
  std::string lossText;
};

// Largest file that is searched: it is held in memory. [bytes]
inline constexpr std::uint64_t kMaxRecoveryBytes = 96u << 20;

// Throws FileError (can't be read, larger than kMaxRecoveryBytes), FormatError (neither bzip2 nor
// XML), Cancelled. The file is not touched.
DsaRecovery recoverDsaProfile(const std::filesystem::path& path,
                              const Progress& progress = {},
                              const DsaReadOptions& options = {});
// The same for bytes that are in memory; `name` stands for the path in messages.
DsaRecovery recoverDsaProfileBytes(std::span<const std::byte> bytes,
                                   const std::filesystem::path& name,
                                   const Progress& progress = {},
                                   const DsaReadOptions& options = {});

}  // namespace palpate
