// Names of recordings from a template: "{date}_{object}_{run}" becomes
// "2014-11-27_foam_ball_003.palpate".
//
//   {date}      2014-11-27, local time of the machine
//   {time}      10-31-05, local time of the machine
//   {operator}  as typed
//   {object}    as typed
//   {run}       the next free number in the folder, at least three digits
//
// Whatever people type, the name is one valid file name: a name can't leave its folder, be hidden,
// be an option, or bend a terminal's line. Blanks become "_", as in class folders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace palpate {

struct RecordingNameFields {
  std::int64_t timeUs = 0;  // [us since 1970]
  std::string operatorName;
  std::string object;
};

// `text` as a part of a file name: path separators, blanks, control characters, what isn't UTF-8
// and what shells or other systems take amiss become "_"; at most 60 bytes, no leading or trailing
// "." "-" "_".
std::string fileNamePart(std::string_view text);

// The name, ending in .palpate, at most 200 bytes long. An empty field leaves no doubled "_".
// Throws std::invalid_argument for a placeholder that isn't known, or stands twice.
std::string recordingFileName(std::string_view nameTemplate,
                              const RecordingNameFields& fields,
                              int run);

// The next path in `folder` that nothing has: {run} is one more than the largest number of
// recordings that differ in it (and in {time}) only; without {run} a taken name gets "-2", "-3", ..
// Makes nothing: also good for a preview. Throws std::invalid_argument as above, FileError (no such
// folder).
std::filesystem::path nextRecordingPath(const std::filesystem::path& folder,
                                        std::string_view nameTemplate,
                                        const RecordingNameFields& fields);

}  // namespace palpate
