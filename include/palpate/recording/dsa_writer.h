// Writes a .dsa recording, frame coding byte-identical to the prior program's (docs/dsa_format.md).
#pragma once

#include <filesystem>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// Writes a temporary file, syncs it, renames it: PATH is whole or untouched. Stamps are stored in
// whole milliseconds. Throws FileError, Cancelled.
void writeDsa(const Profile& profile,
              const std::filesystem::path& path,
              Overwrite overwrite = Overwrite::kRefuse,
              const Progress& progress = {});

}  // namespace palpate
