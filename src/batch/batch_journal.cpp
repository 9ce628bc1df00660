#include "batch/batch_journal.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/output_file.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr const char* kJournalName = ".palpate_batch";

std::string systemText(int error) { return std::generic_category().message(error); }

std::vector<WrittenFile> writtenFilesOf(const Json& json, const char* key) {
  std::vector<WrittenFile> files;
  if (!json.contains(key)) return files;
  for (std::size_t i = 0; i < json.at(key).size(); ++i) {
    const Json one = json.at(key).at(i);
    files.push_back({one.at("path").asString(),
                     {one.at("size").asInteger(), one.at("changed_ns").asInteger()}});
  }
  return files;
}

Json writtenFilesJson(const std::vector<WrittenFile>& files) {
  return jsonList(files, [](const WrittenFile& file) {
    return Json::object()
        .set("path", file.path)
        .set("size", file.stamp.size)
        .set("changed_ns", file.stamp.changedNs);
  });
}

std::optional<JournalEntry> entryOf(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    JournalEntry entry;
    entry.target = json.at("target").asString();
    entry.source = json.at("source").asString();
    entry.options = json.at("options").asString();
    entry.sourceStamp = {json.at("source_size").asInteger(),
                         json.at("source_changed_ns").asInteger()};
    if (json.contains("target_size"))
      entry.targetStamp = {json.at("target_size").asInteger(),
                           json.at("target_changed_ns").asInteger()};
    entry.results = writtenFilesOf(json, "results");
    entry.replaceable = writtenFilesOf(json, "replaceable");
    return entry;
  } catch (const Error&) {
    return std::nullopt;  // a line that was not written to its end
  }
}

std::string lineOf(const JournalEntry& entry) {
  Json json = Json::object();
  json.set("target", entry.target).set("source", entry.source).set("options", entry.options);
  json.set("source_size", entry.sourceStamp.size);
  json.set("source_changed_ns", entry.sourceStamp.changedNs);
  if (entry.targetStamp) {
    json.set("target_size", entry.targetStamp->size);
    json.set("target_changed_ns", entry.targetStamp->changedNs);
  }
  if (!entry.results.empty()) json.set("results", writtenFilesJson(entry.results));
  if (!entry.replaceable.empty()) json.set("replaceable", writtenFilesJson(entry.replaceable));
  return json.text(-1) + "\n";
}

}  // namespace

std::optional<FileStamp> stampOf(const fs::path& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return std::nullopt;
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  return FileStamp{facts.st_size, facts.st_mtim.tv_sec * kNsPerS + facts.st_mtim.tv_nsec};
}

BatchJournal::BatchJournal(const fs::path& folder) : folder_(folder), path_(folder / kJournalName) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw FileError(folder, "can't be created: " + failure.message());
  if (!fs::is_directory(folder, failure)) throw FileError(folder, "is not a folder");
  constexpr mode_t kMode = 0666;
  file_ = FileDescriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kMode));
  if (file_.get() < 0) throw FileError(folder, "can't be written into: " + systemText(errno));
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK)
      throw FileError(folder, "another batch is writing into this folder; wait until it has ended");
    throw FileError(path_, "can't be locked: " + systemText(errno));
  }
  read();
}

void BatchJournal::read() {
  std::string text;
  char piece[1 << 14];
  off_t at = 0;
  for (ssize_t count = 0; (count = ::pread(file_.get(), piece, sizeof piece, at)) != 0;) {
    if (count < 0) {
      if (errno == EINTR) continue;
      throw FileError(path_, "can't be read: " + systemText(errno));
    }
    text.append(piece, static_cast<std::size_t>(count));
    at += count;
  }
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    if (auto entry = entryOf(text.substr(begin, end - begin)))
      entries_[entry->target] = std::move(*entry);
  // A line that was not written to its end must not take the next one along.
  if (begin < text.size() && ::write(file_.get(), "\n", 1) != 1)
    throw FileError(path_, "can't be written: " + systemText(errno));
}

std::string BatchJournal::relative(const fs::path& target) const {
  return target.lexically_relative(folder_).string();
}

const JournalEntry* BatchJournal::find(const fs::path& target) const {
  const auto found = entries_.find(relative(target));
  return found == entries_.end() ? nullptr : &found->second;
}

JournalEntry BatchJournal::entryFor(const fs::path& target,
                                    const fs::path& source,
                                    const std::string& options) const {
  std::error_code ignored;
  const fs::path real = fs::canonical(source, ignored);
  return {.target = relative(target),
          .source = (ignored ? fs::absolute(source) : real).string(),
          .options = options,
          .sourceStamp = stampOf(source).value_or(FileStamp())};
}

void BatchJournal::add(const JournalEntry& entry) {
  const std::string line = lineOf(entry);
  const std::lock_guard lock(mutex_);
  const ssize_t written = ::write(file_.get(), line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size()))
    throw FileError(path_, "can't be written: " + writeFailureText(written < 0 ? errno : ENOSPC));
}

}  // namespace palpate
