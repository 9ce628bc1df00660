// Search in a list of recordings: "foam object:ball date:2014-11". Words, all of which must be
// found somewhere in what the list says of a recording, whatever the case of their letters;
// "several words" in quotes are one; KEY:WORD looks in one place only. Keys: name, path, operator,
// object, run, notes, label, date, form, state. A word with any other key is searched for as it
// stands.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/recording/recording_details.h>

namespace palpate {

inline constexpr std::array<std::string_view, 10> kSearchKeys{
    "name", "path", "operator", "object", "run", "notes", "label", "date", "form", "state"};

// The positions of the keys.
enum class SearchKey : std::size_t {
  kName,
  kPath,
  kOperator,
  kObject,
  kRun,
  kNotes,
  kLabel,
  kDate,
  kForm,
  kState
};

// The case folding of UTF-8 text that the caller has (the window: Qt's). Text and words must be
// folded by the same function, which leaves ASCII in small letters.
using CaseFolding = std::function<std::string(std::string_view)>;

// What is searched in, one folded text per key, made once per recording.
using SearchableText = std::array<std::string, kSearchKeys.size()>;
// `path` counts from `folder` on; `date` is "2014-11-27 10:31" of the start, in the time of this
// place.
SearchableText searchableText(const RecordingDetails& details,
                              const std::filesystem::path& folder,
                              const CaseFolding& folded);

class RecordingSearch {
 public:
  RecordingSearch() = default;  // matches everything
  RecordingSearch(std::string_view text, const CaseFolding& folded);
  bool empty() const noexcept { return words_.empty(); }
  bool matches(const SearchableText& text) const;
  // The words in front of a colon that are no key ("objct" of "objct:ball"), each once.
  const std::vector<std::string>& unknownKeys() const noexcept { return unknownKeys_; }

 private:
  struct Word {
    std::string text;  // folded
    std::optional<std::size_t> key;
  };
  std::vector<Word> words_;
  std::vector<std::string> unknownKeys_;
};

}  // namespace palpate
