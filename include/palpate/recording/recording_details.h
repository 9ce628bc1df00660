// What a list of recordings says of each: when, how long, of what, by whom. Of a native recording
// that is read without its frames, whatever its length; a .dsa says nothing before it has been read
// through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/series.h>

namespace palpate {

// A series beside those of the hand.
struct SeriesDetails {
  std::string name;
  std::int64_t samples = 0;
  double rateHz = 0.0;  // mean; 0: fewer than two samples
  std::vector<Column> columns;
  // "wrench: fx [N], fy [N], 100 Hz".
  std::string text() const;
  bool operator==(const SeriesDetails&) const = default;
};

struct RecordingDetails {
  enum class State {
    kFinished,
    kRecording,   // a process is writing it: its present state
    kUnfinished,  // its writer ended before it was finished; it can be recovered
    kDamaged,     // message says how
    kUnreadable,  // no permission, an input/output error, ..: message
  };

  std::filesystem::path path;
  std::string form;                // "palpate", "dsa"; empty: unreadable
  State state = State::kFinished;  // as far as it is known without reading the frames
  std::string message;             // one line; empty: nothing is wrong
  std::uintmax_t sizeBytes = 0;
  std::int64_t changedUs = 0;           // last change of the file [us since 1970]
  std::optional<std::int64_t> startUs;  // first frame [us since 1970]; none: no frame, or not known
  std::optional<std::int64_t> durationUs;  // first to last frame [us]
  std::optional<std::int64_t> numFrames;
  // As given when it was recorded; a .dsa has none of them.
  std::string operatorName;
  std::string object;
  std::string run;
  std::string notes;  // those, and every event "note", a line each
  // The texts of the events "label" and "segment", each once, in order of time.
  std::vector<std::string> labels;
  std::vector<SeriesDetails> series;  // beside those of the hand
  bool operator==(const RecordingDetails&) const = default;
};

// "finished", "recording", "unfinished", "damaged", "unreadable".
const char* nameOf(RecordingDetails::State state);
// The state of such a name; none for any other text.
std::optional<RecordingDetails::State> detailsStateFrom(const std::string& name);

// What a list says of one recording. Never throws for a bad file: `state` and `message` say what
// is wrong with it; `threads` as for openRecording(). Throws Cancelled.
RecordingDetails readDetails(const std::filesystem::path& path,
                             const Progress& progress = {},
                             std::size_t threads = 0);

}  // namespace palpate
