#include "palpate/capture/recording_name.h"

#include <algorithm>
#include <cstdio>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxPart = 60;
// Leaves room for "_002.palpate-journal" within the 255 bytes of a name.
constexpr std::size_t kMaxStem = 170;  // before run and time are inserted
constexpr char kRunMark = '\x01';  // placeholders for them; no text can contain these characters
constexpr char kTimeMark = '\x02';

// Shortens to at most `most` bytes and removes characters that a name may not begin or end with.
std::string nameOfAtMost(std::string_view text, std::size_t most) {
  constexpr std::string_view kLoose = ".-_";
  return std::string(trimmed(beginningOf(trimmed(text, kLoose), most), kLoose));
}

std::string harmless(std::string_view text) {
  // escapedLine() makes it valid UTF-8 without control characters; the backslashes are replaced
  // below.
  std::string name = escapedLine(text);
  for (char& c : name)
    if (std::string_view(" /\\:*?\"<>|{}$`'&;!~%#").find(c) != std::string_view::npos) c = '_';
  return name;
}

std::string valueOf(std::string_view placeholder, const RecordingNameFields& fields) {
  if (placeholder == "date") return localText(fields.timeUs, "%Y-%m-%d");
  if (placeholder == "time") return {kTimeMark};
  if (placeholder == "operator") return fileNamePart(fields.operatorName);
  if (placeholder == "object") return fileNamePart(fields.object);
  if (placeholder == "run") {
    const std::string text = fileNamePart(fields.run);
    return text.empty() ? std::string{kRunMark} : text + "_" + kRunMark;
  }
  throw std::invalid_argument("RecordingName: {" + escapedLine(placeholder) +
                              "} isn't known; use {date}, {time}, {operator}, {object}, {run}");
}

// The name without its ending, with marks in place of time and run.
std::string markedStem(std::string_view nameTemplate, const RecordingNameFields& fields) {
  constexpr std::string_view kEnding = ".palpate";
  if (nameTemplate.ends_with(kEnding)) nameTemplate.remove_suffix(kEnding.size());
  std::string stem;
  std::vector<std::string_view> used;
  while (!nameTemplate.empty()) {
    const std::size_t open = std::min(nameTemplate.find('{'), nameTemplate.size());
    stem += harmless(nameTemplate.substr(0, open));
    nameTemplate.remove_prefix(open);
    if (nameTemplate.empty()) break;
    const std::size_t close = nameTemplate.find('}');
    if (close == std::string_view::npos)
      throw std::invalid_argument("RecordingName: a '{' without its '}'");
    const std::string_view placeholder = nameTemplate.substr(1, close - 1);
    stem += valueOf(placeholder, fields);
    if (std::find(used.begin(), used.end(), placeholder) != used.end())
      throw std::invalid_argument("RecordingName: {" + std::string(placeholder) +
                                  "} is given twice");
    used.push_back(placeholder);
    nameTemplate.remove_prefix(close + 1);
  }
  // Removes the doubled "_" around an empty field.
  stem.erase(
      std::unique(stem.begin(), stem.end(), [](char a, char b) { return a == '_' && b == '_'; }),
      stem.end());
  stem = nameOfAtMost(stem, kMaxStem);
  return stem.empty() ? "recording" : stem;
}

std::string runText(int run) {
  char text[16];
  std::snprintf(text, sizeof text, "%03d", run);
  return text;
}

std::string filled(const std::string& marked, const RecordingNameFields& fields, int run) {
  std::string name;
  for (const char c : marked) {
    if (c == kTimeMark)
      name += localText(fields.timeUs, "%H-%M-%S");
    else if (c == kRunMark)
      name += runText(run);
    else
      name += c;
  }
  return name + ".palpate";
}

// Matches recordings (also their parts, journals and MCAP files) that differ in run and time only.
std::regex patternOf(const std::string& marked) {
  std::string pattern;
  for (const char c : marked) {
    if (c == kTimeMark)
      pattern += "[0-9]{2}-[0-9]{2}-[0-9]{2}";
    else if (c == kRunMark)
      pattern += "([0-9]{1,9})";
    else if (std::string_view(".[]()*+?^$|\\").find(c) != std::string_view::npos)
      pattern += std::string("\\") + c;
    else
      pattern += c;
  }
  return std::regex(pattern + "(?:_[0-9]{3,})?\\.(?:palpate|mcap).*");
}

int largestRun(const fs::path& folder, const std::string& marked) {
  std::error_code failure;
  fs::directory_iterator entries(folder, failure);
  const std::regex pattern = patternOf(marked);
  std::int64_t largest = 0;
  for (; !failure && entries != fs::directory_iterator(); entries.increment(failure)) {
    const std::string name = entries->path().filename().string();
    std::smatch match;
    if (std::regex_match(name, match, pattern) && match.size() > 1)
      largest = std::max(largest, parseInteger(match[1].str()).value_or(0));
  }
  if (failure) throw FileError(folder, "can't be listed: " + failure.message());
  return static_cast<int>(largest);
}

bool taken(const fs::path& path) {
  std::error_code ignored;
  fs::path journal = path;
  journal += "-journal";
  // The file that may be written beside it (RecordingOptions::mcap).
  fs::path mcap = path;
  mcap.replace_extension(".mcap");
  return fs::exists(fs::symlink_status(path, ignored)) ||
         fs::exists(fs::symlink_status(journal, ignored)) ||
         fs::exists(fs::symlink_status(mcap, ignored));
}

}  // namespace

std::string fileNamePart(std::string_view text) { return nameOfAtMost(harmless(text), kMaxPart); }

std::string recordingFileName(std::string_view nameTemplate,
                              const RecordingNameFields& fields,
                              int run) {
  return filled(markedStem(nameTemplate, fields), fields, run);
}

fs::path nextRecordingPath(const fs::path& folder,
                           std::string_view nameTemplate,
                           const RecordingNameFields& fields) {
  const std::string marked = markedStem(nameTemplate, fields);
  const bool numbered = marked.find(kRunMark) != std::string::npos;
  int run = largestRun(folder, marked) + 1;
  fs::path path = folder / filled(marked, fields, run);
  for (int next = 2; taken(path); ++next) {
    path = folder / filled(numbered ? marked : marked + "-" + std::to_string(next), fields, ++run);
  }
  return path;
}

}  // namespace palpate
