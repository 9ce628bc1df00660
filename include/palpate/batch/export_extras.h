// What a conversion writes beside the frames of a recording: where the result comes from, and the
// series of signals and slip. The command `palpate convert`, batches and the window make the same.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/recording/mcap_recording.h>
#include <palpate/recording/recording.h>

namespace palpate {

struct ExportChoices {
  bool withSignals = true;  // of .h5, .mat and .mcap: the characteristic signals
  bool withSlip = true;     // of .h5, .mat and .mcap: the slip
  bool unitsRow = false;    // of .csv: a second row with the units
  // Of .mcap; empty: as McapWriteOptions has them.
  std::optional<McapCompression> compression = {};
  std::optional<McapImages> images = {};
  bool operator==(const ExportChoices&) const = default;
};

// The recording that exports are made of. What they say of the file is read when it is first
// needed, and once: a source that is cut into many files is hashed once. Not thread-safe.
class ExportSource {
 public:
  // `meta`: where it is read already.
  ExportSource(std::filesystem::path file,  // NOLINT: a path is one
               std::optional<RecordingMeta> meta = {})
      : file_(std::move(file)), meta_(std::move(meta)) {}
  const std::filesystem::path& file() const noexcept { return file_; }
  // As readRecordingMeta() and sha256OfFile(), which throw.
  const RecordingMeta& meta() const;
  const std::string& sha256() const;

 private:
  std::filesystem::path file_;
  mutable std::optional<RecordingMeta> meta_;
  mutable std::optional<std::string> sha256_;
};

// Throws std::invalid_argument when a file with the ending of `out` can't be made with these
// choices and filters, FileError for an ending that is not known.
void requirePossible(const ExportChoices& choices,
                     const Recipe& filters,
                     const std::filesystem::path& out);

// What is saved beside `profile`, which was read from `in`, filtered by `filters` (empty: not
// filtered) and is to be saved as `out`: what was said of the recording, and for .h5, .mat and
// .mcap the series and where all of it comes from (its file is read for its hash). Throws as
// requirePossible(), FileError, FormatError.
SaveExtras exportExtras(const ExportChoices& choices,
                        const ExportSource& in,
                        const std::filesystem::path& out,
                        const Profile& profile,
                        const Recipe& filters);

}  // namespace palpate
