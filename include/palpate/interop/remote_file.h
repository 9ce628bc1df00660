// Checks file names received by remote control: a recording is only made in the folder of
// recordings, under a plain file name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <palpate/capture/recording_name.h>

namespace palpate {

// Reason why `name` can't be the name (or the template) of a recording, one line; empty when it
// can. Refused are: a path ("/", "..", a hidden name), a leading "-", invalid UTF-8, control
// characters, more than 200 bytes, the ending of another form of recording than .palpate, and
// unknown placeholders.
std::string problemOfRemoteName(std::string_view name);

// The path in `folder` for exactly this name, with .palpate appended if missing; with placeholders
// ({date}, {run}, ..) the next unused path. Never outside the folder. Throws std::invalid_argument
// (problemOfRemoteName), FileError (no such folder).
std::filesystem::path remoteRecordingPath(const std::filesystem::path& folder,
                                          std::string_view name,
                                          const RecordingNameFields& fields);

}  // namespace palpate
