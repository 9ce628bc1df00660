// File names that come from outside: a recording asked for by remote control lies in the folder of
// recordings, under a name that is a plain file name, or there is none.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <palpate/capture/recording_name.h>

namespace palpate {

// Why `name` can't be the name (or the template) of a recording, one line; empty: it can. Refused:
// a path ("/", "..", a hidden name), a leading "-", what isn't UTF-8 or holds control characters,
// over 200 bytes, another ending than .palpate that is a form of recording, a placeholder that
// isn't known.
std::string problemOfRemoteName(std::string_view name);

// The path in `folder`: of `name`, with .palpate behind it where that is missing, exactly as it was
// given; where it holds placeholders ({date}, {run}, ..) the next that is free. The folder itself
// is never left. Throws std::invalid_argument (problemOfRemoteName), FileError (no such folder).
std::filesystem::path remoteRecordingPath(const std::filesystem::path& folder,
                                          std::string_view name,
                                          const RecordingNameFields& fields);

}  // namespace palpate
