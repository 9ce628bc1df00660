// Opens and checks recordings of all formats; commands and windows use these functions only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/exported_series.h>
#include <palpate/recording/mcap_recording.h>
#include <palpate/recording/recording_event.h>

namespace palpate {

// Reads a recording; its format is recognised by its first bytes, never by its name (a .dsa is
// bzip2 or XML). HDF5 files that Palpate has written (hdf5_recording.h) and MCAP files
// (mcap_recording.h) are recordings, too. `threads`: of a .dsa, as DsaReadOptions::threads. Throws
// FileError, FormatError, Cancelled; what() is one line that says what to do.
Profile openRecording(const std::filesystem::path& path,
                      const Progress& progress = {},
                      std::size_t threads = 0);
// As openRecording(), with only these topics of an MCAP file of another program; none: all. Throws
// FileError where other files are given topics.
Profile openTopics(const std::filesystem::path& path,
                   const std::vector<std::string>& topics,
                   const Progress& progress = {},
                   std::size_t threads = 0);

// What readers say of data of the file that a profile doesn't have, with its count: the warning
// that begins with kLostWarning, without that; empty: nothing. Commands end with exit code 3 then.
inline constexpr std::string_view kLostWarning = "lost: ";
std::string lostText(const Profile& profile);

// Whether a file is a native recording; if not, it is taken for a .dsa. The first bytes tell; where
// they are neither SQLite's nor those of a .dsa (damaged), the ending of the name does. Throws
// FileError.
bool isNativeRecording(const std::filesystem::path& path);
// Whether a file is taken for HDF5: by its first bytes; where they are those of no recording
// (damaged), by the ending .h5 or .hdf5 of its name. Throws FileError.
bool isHdf5Recording(const std::filesystem::path& path);
// Whether a file is taken for MCAP: in the same way, by the ending .mcap. Throws FileError.
bool isMcapRecording(const std::filesystem::path& path);

// A recording as far as it can be read, whole or damaged.
struct ReadableRecording {
  Profile profile;                               // without what was lost to damage
  std::vector<RecordingEvent> events = {};       // in order of time
  std::vector<RecordingEvent> notInFile = {};    // of events: what was found to be lost
  std::string damage = {};                       // one line: what is missing; empty if nothing is
  std::size_t damagedEvents = 0;                 // that can't be read, or are more than are read
  std::map<std::string, std::string> meta = {};  // as readRecordingMeta(), as far as it can be read
};
// Opens a recording and reads it through: what verifyRecording() counts as readable, damaged or
// not. `threads` as for openRecording(). Throws FileError, FormatError (nothing can be read),
// Cancelled.
ReadableRecording readableRecording(const std::filesystem::path& path,
                                    const Progress& progress = {},
                                    std::size_t threads = 0);
// As readableRecording(), with topics as openTopics().
ReadableRecording readableTopics(const std::filesystem::path& path,
                                 const std::vector<std::string>& topics,
                                 const Progress& progress = {},
                                 std::size_t threads = 0);

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

// The forms a recording can be saved in.
enum class RecordingFormat { kDsa, kPalpate, kCsv, kNpz, kJsonLines, kHdf5, kMat, kMcap };
struct RecordingForm {
  RecordingFormat format;
  const char* ending;   // with its dot: ".palpate"
  const char* purpose;  // for lists: "Palpate recording"
};
// All forms with the endings that stand for them.
std::span<const RecordingForm> recordingForms() noexcept;
// The format of a name by its ending, in small or capital letters. Throws FileError
// naming them all.
RecordingFormat formatOf(const std::filesystem::path& path);

// What was noted or happened in a recording: the events of a .palpate, .h5 or .mcap, the sidecar
// NAME.dsa.notes.json of a .dsa (none: no events). Throws FileError, FormatError.
EventsReport readEvents(const std::filesystem::path& path);

// What was said of a recording as a whole when it was made: by the device about itself, by the
// operator about the run. These are the keys and values of the table `meta` of a native recording
// (docs/palpate_format.md), which an .h5 and an .mcap keep: "serial", "firmware", "settings"
// (JSON), "operator", ..; a .dsa has none. Throws FileError, FormatError.
std::map<std::string, std::string> readRecordingMeta(const std::filesystem::path& path);

// Throws FileError when both name the same file (by a link, too): nothing is written onto its
// source.
void requireOther(const std::filesystem::path& in, const std::filesystem::path& out);

// What the form of a saved recording could not hold as it was.
struct SaveReport {
  std::size_t movedStamps = 0;  // of a .dsa: see DsaWriteReport
};
// What is saved beside a profile and its events, in the forms that have a place for it.
struct SaveExtras {
  // As readRecordingMeta(): into a .palpate, an .h5 and an .mcap. What the profile says by itself
  // (hand, serial number, ..) is added.
  std::map<std::string, std::string> meta = {};
  // Into an .h5, a .mat and an .mcap; its series are read to their end.
  ExportExtras exported = {};
  McapWriteOptions mcap = {};  // of an .mcap
  bool unitsRow = false;       // of a .csv: see writeCsv()
};
// Saves a profile in the form of PATH's ending: whole or not at all. Events go into a .palpate, an
// .h5, an .mcap and a .mat, into the sidecar of a .dsa, into `meta` of an .npz; a .csv or .jsonl
// has no place for them. Throws FileError, Cancelled.
SaveReport saveRecording(const Profile& profile,
                         std::span<const RecordingEvent> events,
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
// made when there is nothing to save. `topics` as of openTopics(). Throws FileError, FormatError
// (no recording at all), Cancelled.
RecoverReport recoverRecording(const std::filesystem::path& in,
                               const std::filesystem::path& out,
                               Overwrite overwrite = Overwrite::kRefuse,
                               const Progress& progress = {},
                               const std::vector<std::string>& topics = {});

}  // namespace palpate
