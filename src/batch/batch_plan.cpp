#include "palpate/batch/batch_plan.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <system_error>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/parallel.h"
#include "palpate/core/time.h"
#include "palpate/library/recording_folder.h"
#include "palpate/recording/recording.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxNameBytes = 255;

std::string joinedFolders(const fs::path& folder) {
  std::string text;
  for (const fs::path& part : folder) text += (text.empty() ? "" : "_") + part.string();
  return text;
}

// `text` with its fields replaced. An empty field takes the "_" or "-" behind it along. Throws
// std::invalid_argument for an unknown field and a brace without its partner.
std::string filledText(const std::string& text, const BatchNameFields& fields, bool isFolder) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find_first_of("{}", at), text.size());
    filled += text.substr(at, open - at);
    if (open == text.size()) break;
    const std::size_t close = text.find_first_of("{}", open + 1);
    if (text[open] == '}' || close == std::string::npos || text[close] == '{')
      throw std::invalid_argument("template '" + shortened(text) +
                                  "': a brace without its partner");
    const std::string field = text.substr(open + 1, close - open - 1);
    std::string value;
    if (field == "name")
      value = fields.name;
    else if (field == "folder")
      value = isFolder ? fields.folder.string() : joinedFolders(fields.folder);
    else if (field == "ending")
      value = fields.ending;
    else if (field == "date")
      value = localText(fields.timeUs, "%Y-%m-%d");
    else if (field == "time")
      value = localText(fields.timeUs, "%H-%M-%S");
    else
      throw std::invalid_argument("template '" + shortened(text) + "': {" + shortened(field) +
                                  "} isn't known; use {name}, {folder}, {ending}, {date}, {time}");
    filled += value;
    at = close + 1;
    if (value.empty() && at < text.size() && (text[at] == '_' || text[at] == '-')) ++at;
  }
  return filled;
}

fs::path realPath(const fs::path& path) {
  std::error_code failure;
  const fs::path real = fs::weakly_canonical(fs::absolute(path), failure);
  return failure ? fs::absolute(path).lexically_normal() : real;
}

bool isWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

void findSources(const std::vector<fs::path>& paths, BatchPlan& plan, const Progress& progress) {
  std::set<fs::path> known;
  const auto add = [&](const fs::path& source, const fs::path& root) {
    if (known.insert(realPath(source)).second)
      plan.items.push_back({.source = source, .root = root});
  };
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
      add(path, {});
      continue;
    }
    if (isWithin(realPath(plan.folder), realPath(path)))
      throw FileError(plan.folder, "is in the folder being read; name one outside it");
    const RecordingFolder found = recordingsBelow(path, progress);
    for (const fs::path& file : found.files) add(file, path);
    for (const std::string& problem : found.problems) plan.problems.push_back(problem);
    if (found.files.empty() && found.problems.empty())
      plan.problems.push_back(noRecordingText(path));
  }
}

void nameTarget(BatchItem& item, const BatchTemplate& names) {
  BatchNameFields fields = nameFieldsOf(item);
  try {
    if (names.needsTime()) {
      const Profile profile = openRecording(item.source, {}, 1);
      if (profile.numFrames() == 0)
        throw FileError(item.source, "has no frames, so {date} and {time} aren't known");
      fields.timeUs = profile.frameTimeUs(0);
    }
    item.target = names.pathFor(fields);
  } catch (const std::exception& error) {
    item.problem = error.what();
  }
}

void requireDifferent(BatchPlan& plan, SameResults sameResults) {
  std::set<fs::path> sources;
  for (const BatchItem& item : plan.items) sources.insert(realPath(item.source));
  std::map<fs::path, fs::path> made;
  std::map<fs::path, fs::path> folders;  // asked once each
  for (BatchItem& item : plan.items) {
    if (item.target.empty()) continue;
    fs::path& folder = folders[item.target.parent_path()];
    if (folder.empty()) folder = realPath(item.target.parent_path());
    const fs::path real = folder / item.target.filename();
    const auto [other, isNew] = made.emplace(real, item.source);
    if (!isNew && sameResults == SameResults::kSecondFails) {
      item.problem = item.source.string() + ": '" + item.target.string() +
                     "' is already made from '" + other->second.string() +
                     "', a recording of the same name and another format";
      item.target.clear();
      continue;
    }
    if (!isNew)
      throw FileError(item.target,
                      "would be made from both '" + other->second.string() + "' and '" +
                          item.source.string() +
                          "'; make the names differ with {folder}, {ending}, {date} or {time}");
    if (sources.contains(real) || sources.contains(realPath(item.target)))
      throw FileError(item.target, "would overwrite a recording that is being read");
  }
}

}  // namespace

BatchNameFields nameFieldsOf(const BatchItem& item) {
  BatchNameFields fields;
  fields.name = item.source.stem().string();
  fields.ending = item.source.extension().string();
  if (!fields.ending.empty()) fields.ending.erase(0, 1);
  if (!item.root.empty())
    fields.folder = item.source.parent_path().lexically_relative(item.root).lexically_normal();
  if (fields.folder == ".") fields.folder.clear();
  return fields;
}

BatchTemplate::BatchTemplate(const std::string& text) {
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
    throw std::invalid_argument("template '" + shortened(text) +
                                "': control characters aren't allowed in names");
  filledText(text, {}, false);  // throws
  const fs::path path(text);
  name_ = path.filename().string();
  if (name_.empty() || fs::path(name_).extension().string().size() < 2 ||
      ending().find_first_of("{}") != std::string::npos)
    throw std::invalid_argument("template '" + shortened(text) +
                                "': it must end in a name with an ending, such as out/{name}.csv");
  bool fixed = true;
  for (const fs::path& part : path.parent_path()) {
    fixed = fixed && part.string().find('{') == std::string::npos;
    if (fixed)
      folder_ /= part;
    else
      folders_.push_back(part.string());
  }
  if (folder_.empty()) folder_ = ".";
  keepsFolders_ = text.find("{folder}") == std::string::npos;
}

BatchTemplate::BatchTemplate(const fs::path& folder, const std::string& below)
    : BatchTemplate(below) {
  const fs::path path(below);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
    throw std::invalid_argument("template '" + shortened(below) +
                                "': it must be below the folder of the results");
  folder_ = folder_ == "." ? folder : folder / folder_;
}

bool BatchTemplate::needsTime() const noexcept {
  const auto has = [](const std::string& text) {
    return text.find("{date}") != std::string::npos || text.find("{time}") != std::string::npos;
  };
  return has(name_) || std::any_of(folders_.begin(), folders_.end(), has);
}

fs::path BatchTemplate::pathFor(const BatchNameFields& fields) const {
  fs::path path = folder_;
  const auto addFolders = [&](const fs::path& folders) {
    for (const fs::path& part : folders) {
      if (part == "..") throw Error("'" + shortened(folders.string()) + "' leaves its folder");
      if (!part.empty()) path /= part;
    }
  };
  for (const std::string& folder : folders_) addFolders(filledText(folder, fields, true));
  if (keepsFolders_) addFolders(fields.folder);
  const std::string name = filledText(name_, fields, false);
  const std::string stem = fs::path(name).stem().string();
  if (name.starts_with('.') || stem.empty())
    throw Error("'" + shortened(name) + "' isn't a name for a result: nothing before its ending");
  if (name.size() > kMaxNameBytes)
    throw Error("'" + shortened(name) + "' is longer than the 255 bytes of a name");
  return path / name;
}

BatchPlan planBatch(const std::vector<fs::path>& paths,
                    const BatchTemplate& names,
                    const Progress& progress,
                    SameResults sameResults) {
  BatchPlan plan;
  plan.folder = names.folder();
  findSources(paths, plan, progress);
  // Only reading the time takes long.
  forEachInParallel(
      plan.items.size(),
      [&](std::size_t i) { nameTarget(plan.items[i], names); },
      progress,
      names.needsTime() ? 0 : 1);
  requireDifferent(plan, sameResults);
  return plan;
}

}  // namespace palpate
