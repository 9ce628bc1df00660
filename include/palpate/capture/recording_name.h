// Names of recordings from a template: "{date}_{object}_{run}" becomes
// "2014-11-27_foam_ball_003.palpate".
//
//   {date}      2014-11-27, local time of the machine
//   {time}      10-31-05, local time of the machine
//   {operator}  as typed
//   {object}    as typed
//   {run}       the next free number in the folder, at least three digits; behind the text of the
//               run if there is one: "left_002"
//
// Whatever the user types, the result is one valid file name: it can't leave its folder, be hidden,
// be taken for an option, or change the output of a terminal. Blanks become "_", as in class
// folders.
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
  // Which run, as typed; may be empty. {run} is then this text and the next free number of it.
  std::string run = {};
};

// `text` as a part of a file name: path separators, blanks, control characters, invalid UTF-8 and
// characters with a meaning in shells or other systems become "_"; at most 60 bytes, no leading or
// trailing "." "-" "_".
std::string fileNamePart(std::string_view text);

// The name, ending in .palpate, at most 200 bytes long. An empty field leaves no doubled "_".
// Throws std::invalid_argument for a placeholder that is unknown or occurs twice.
std::string recordingFileName(std::string_view nameTemplate,
                              const RecordingNameFields& fields,
                              int run);

// The next unused path in `folder`. {run} is one more than the largest number among recordings
// whose names differ only in it (and in {time}); without {run} a used name gets "-2", "-3", ..
// A name is used when NAME.mcap is there, too. Creates nothing, so it is suitable for a preview,
// too. Throws std::invalid_argument as above, FileError (no such folder).
std::filesystem::path nextRecordingPath(const std::filesystem::path& folder,
                                        std::string_view nameTemplate,
                                        const RecordingNameFields& fields);

}  // namespace palpate
