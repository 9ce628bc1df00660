// Opens, checks and saves recordings of all formats; commands and windows use these functions only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_data.h>
#include <palpate/recording/recording_format.h>

namespace palpate {

struct ReadOptions {
  // As DsaReadOptions::threads, of a .dsa and an .mcap.
  std::size_t threads = 0;
  // Of an MCAP file of another program: only these topics; none: all. Other files have no topics:
  // FileError.
  std::vector<std::string> topics = {};
};

// Reads a recording as a whole, by one opening; its format is recognised by its first bytes, never
// by its name (a .dsa is bzip2 or XML), where they are those of no recording (damaged) by its
// ending. The samples of a .palpate, an .h5 and an .mcap are read when they are asked for. Events
// that can't be read don't keep a recording closed: see Recording::requireEvents(). Throws
// FileError, FormatError, Cancelled; what() is one line that says what to do.
Recording readRecording(const std::filesystem::path& path,
                        const ReadOptions& options = {},
                        const Progress& progress = {});
// Its samples.
Profile openRecording(const std::filesystem::path& path,
                      const Progress& progress = {},
                      std::size_t threads = 0);

// What readers say of data of the file that a profile doesn't have, with its count: the warning
// that begins with kLostWarning, without that; empty: nothing. Commands end with exit code 3 then.
inline constexpr std::string_view kLostWarning = "lost: ";
std::string lostText(const Profile& profile);

// Reads a recording through, as far as it can be read, damaged or not: what verifyRecording()
// counts as readable. Damage::text says what is missing, events that can't be read included. Throws
// as readRecording(), where nothing can be read.
Recording readableRecording(const std::filesystem::path& path,
                            const ReadOptions& options = {},
                            const Progress& progress = {});

struct VerifyReport {
  enum class State { kSound, kDamaged, kUnreadable };
  State state = State::kUnreadable;
  std::string message;  // one line: counts when sound, else what is wrong and how much can be read
};
// Checks every byte of a recording; `threads` as for openRecording(). Never throws for a bad file;
// throws Cancelled.
VerifyReport verifyRecording(const std::filesystem::path& path,
                             const Progress& progress = {},
                             std::size_t threads = 0);

// What was noted or happened in a recording: the events of a .palpate, .h5 or .mcap, the sidecar
// NAME.dsa.notes.json of a .dsa (none: no events). Throws FileError, FormatError.
EventsReport readEvents(const std::filesystem::path& path);

// Recording::meta without the rest. Throws FileError, FormatError.
RecordingMeta readRecordingMeta(const std::filesystem::path& path);

// Throws FileError when both name the same file (by a link, too): nothing is written onto its
// source.
void requireOther(const std::filesystem::path& in, const std::filesystem::path& out);

// Saves a profile in the format of PATH's ending: whole or not at all. Events go into a .palpate,
// an .h5, an .mcap and a .mat, into the sidecar of a .dsa, into `meta` of an .npz; a .csv or .jsonl
// has no place for them. Throws FileError, Cancelled.
SaveReport saveRecording(const Profile& profile,
                         std::span<const Event> events,
                         const std::filesystem::path& path,
                         Overwrite overwrite = Overwrite::kRefuse,
                         const Progress& progress = {},
                         const SaveExtras& extras = {});

struct RecoverReport {
  enum class State { kWhole, kPart, kNothing };
  State state = State::kNothing;
  std::string message;  // one line: what was saved, what is lost
};
// Saves what can be saved of a damaged or unfinished recording; IN is never touched, OUT is not
// made when there is nothing to save. Throws FileError, FormatError (no recording at all),
// Cancelled.
RecoverReport recoverRecording(const std::filesystem::path& in,
                               const std::filesystem::path& out,
                               Overwrite overwrite = Overwrite::kRefuse,
                               const Progress& progress = {},
                               const ReadOptions& options = {});

}  // namespace palpate
