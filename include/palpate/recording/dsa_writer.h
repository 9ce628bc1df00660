// Writes a .dsa recording, frame coding byte-identical to the prior program's
// (docs/notes/dsa_format.md).
#pragma once

#include <cstddef>
#include <filesystem>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// What the form could not hold as it was.
struct DsaWriteReport {
  // Samples with a later time stamp than recorded, so that stamps grow.
  std::size_t movedStamps = 0;
};

// The format belongs to the DSACON32-M: a hand with another controller, unit or full scale is
// refused.
//
// Writes a temporary file, syncs it, renames it: PATH is whole or untouched. Stamps are stored in
// whole milliseconds, rounded down; of samples of one stream within a millisecond each gets the
// next one, since the stamps of the form strictly grow. `generated_by` and `hw_revision` are whole
// numbers, as the prior program reads them: what the profile doesn't say as one is written as that
// program writes it (105, 1). Throws FileError, Cancelled.
DsaWriteReport writeDsa(const Profile& profile,
                        const std::filesystem::path& path,
                        Overwrite overwrite = Overwrite::kRefuse,
                        const Progress& progress = {});

}  // namespace palpate
