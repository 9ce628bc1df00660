// What a batch makes: the recordings it reads, and the name of each result, from a template.
//
// The template is a path: "out/{name}.csv". Its folders and its name may contain
//
//   {name}    the recording's name without its ending
//   {folder}  the folders between the given folder and the recording; in the name itself joined
//             by "_"; empty for a recording that was given by itself
//   {ending}  the recording's ending without its dot: "dsa"
//   {date}    2014-11-27, when the recording begins, local time of the machine
//   {time}    10-31-05, the same
//
// A template without {folder} keeps the folders: a/b/x.dsa becomes out/a/b/x.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/core/progress.h>

namespace palpate {

struct BatchNameFields {
  std::string name = {};
  std::filesystem::path folder = {};  // relative
  std::string ending = {};            // without its dot
  std::int64_t timeUs = 0;            // [us since 1970]
};

class BatchTemplate {
 public:
  // Throws std::invalid_argument for an unknown field, a brace without its partner, a name that is
  // missing or has no ending, or a control character.
  explicit BatchTemplate(const std::string& text);
  // The template `below`, a relative path, in a folder that is taken as it is, also with braces.
  // Throws in addition for a path that is absolute or contains "..".
  BatchTemplate(const std::filesystem::path& folder, const std::string& below);

  // The folders in front of the first field; "." when there are none.
  const std::filesystem::path& folder() const noexcept { return folder_; }
  // Of the results, with its dot.
  std::string ending() const { return std::filesystem::path(name_).extension().string(); }
  // Whether the time at which a recording begins has to be read.
  bool needsTime() const noexcept;
  // Throws Error when the name is not allowed: empty, hidden, longer than 255 bytes.
  std::filesystem::path pathFor(const BatchNameFields& fields) const;

 private:
  std::vector<std::string> folders_;  // with fields, below folder_
  std::string name_;
  std::filesystem::path folder_;
  bool keepsFolders_ = false;  // no {folder} in it
};

struct BatchItem {
  std::filesystem::path source;
  // The given folder in which it was found; empty for a recording that was given by itself.
  std::filesystem::path root = {};
  std::filesystem::path target = {};
  // Why it has no target, in one line; else empty.
  std::string problem = {};
  // Results of an earlier run that this one may replace (BatchOptions::resume).
  std::vector<std::filesystem::path> earlier = {};
};
// The fields of a recording's name but its time.
BatchNameFields nameFieldsOf(const BatchItem& item);

struct BatchPlan {
  // In the order of the given paths, those of a folder sorted by path; each source once.
  std::vector<BatchItem> items;
  // One line for each folder that is unreadable or has no recordings.
  std::vector<std::string> problems;
  // Holds all results and the journal.
  std::filesystem::path folder;
};

// What becomes of recordings that would have the same result: the batch is refused, or all but the
// first fail.
enum class SameResults { kRefuse, kSecondFails };

// Finds the recordings (recordingsBelow()) and names the results; writes nothing. Throws Error when
// two recordings would have the same result (kRefuse), a result would be a source, or the results
// lie in a folder that is read; Cancelled.
BatchPlan planBatch(const std::vector<std::filesystem::path>& paths,
                    const BatchTemplate& names,
                    const Progress& progress = {},
                    SameResults sameResults = SameResults::kRefuse);

}  // namespace palpate
