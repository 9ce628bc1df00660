#include "palpate/library/recording_catalog.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <sys/vfs.h>

#include "palpate/core/error.h"
#include "palpate/core/hash.h"
#include "palpate/core/json.h"
#include "palpate/core/output_file.h"
#include "palpate/core/text_file.h"
#include "palpate/library/recording_folder.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/read_ahead.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kRecordingCatalogFormat = "palpate library";
constexpr std::int64_t kRecordingCatalogVersion = 2;
constexpr std::uintmax_t kLargestCache = 64u << 20;

// Tells whether a recording and its sidecar are what they were: size, time of change and of status
// of both.
using Stamp = std::array<std::int64_t, 6>;

void recordingCatalogStampOf(const fs::path& path, std::span<std::int64_t, 3> out) {
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return;
  out[0] = facts.st_size;
  out[1] = facts.st_mtim.tv_sec * kNsPerS + facts.st_mtim.tv_nsec;
  out[2] = facts.st_ctim.tv_sec * kNsPerS + facts.st_ctim.tv_nsec;
}

Stamp recordingCatalogStampOf(const fs::path& recording) {
  Stamp stamp{};
  const std::span<std::int64_t, 6> all(stamp);
  recordingCatalogStampOf(recording, all.first<3>());
  recordingCatalogStampOf(sidecarPathOf(recording), all.last<3>());
  return stamp;
}

struct Entry {
  Stamp stamp{};
  RecordingDetails details;
};
using Entries = std::map<std::string, Entry>;  // by path within the folder

Json optionalJson(const std::optional<std::int64_t>& value) {
  return value ? Json(*value) : Json();
}
std::optional<std::int64_t> optionalFrom(const Json& json) {
  return json.isNull() ? std::nullopt : std::optional(json.asInteger());
}

Json toJson(const std::string& path, const Entry& entry) {
  const RecordingDetails& details = entry.details;
  Json stamp = Json::array();
  for (const std::int64_t value : entry.stamp) stamp.push(value);
  Json labels = Json::array();
  for (const std::string& label : details.labels) labels.push(label);
  return Json::object()
      .set("path", path)
      .set("stamp", std::move(stamp))
      .set("form", details.form)
      .set("state", nameOf(details.state))
      .set("message", details.message)
      .set("size", static_cast<std::int64_t>(details.sizeBytes))
      .set("changed_us", details.changedUs)
      .set("start_us", optionalJson(details.startUs))
      .set("duration_us", optionalJson(details.durationUs))
      .set("frames", optionalJson(details.numFrames))
      .set("operator", details.operatorName)
      .set("object", details.object)
      .set("run", details.run)
      .set("notes", details.notes)
      .set("labels", std::move(labels))
      .set("series", jsonList(details.series, [](const SeriesDetails& series) {
             return Json::object()
                 .set("name", series.name)
                 .set("samples", series.samples)
                 .set("rate_hz", series.rateHz)
                 .set("columns", jsonList(series.columns, [](const Column& column) {
                        return Json::object().set("name", column.name).set("unit", column.unit);
                      }));
           }));
}

// Throws Error.
std::pair<std::string, Entry> fromJson(const Json& json) {
  Entry entry;
  RecordingDetails& details = entry.details;
  const std::string path = json.at("path").asString();
  const Json stamp = json.at("stamp");
  if (stamp.size() != entry.stamp.size()) throw Error("a stamp has the wrong size");
  for (std::size_t i = 0; i < entry.stamp.size(); ++i) entry.stamp[i] = stamp.at(i).asInteger();
  const auto state = detailsStateFrom(json.at("state").asString());
  if (!state) throw Error("a state is unknown");
  details.state = *state;
  details.form = json.at("form").asString();
  details.message = json.at("message").asString();
  details.sizeBytes = static_cast<std::uintmax_t>(json.at("size").asInteger());
  details.changedUs = json.at("changed_us").asInteger();
  details.startUs = optionalFrom(json.at("start_us"));
  details.durationUs = optionalFrom(json.at("duration_us"));
  details.numFrames = optionalFrom(json.at("frames"));
  details.operatorName = json.at("operator").asString();
  details.object = json.at("object").asString();
  details.run = json.at("run").asString();
  details.notes = json.at("notes").asString();
  const Json labels = json.at("labels");
  for (std::size_t i = 0; i < labels.size(); ++i) details.labels.push_back(labels.at(i).asString());
  const Json series = json.at("series");
  for (std::size_t i = 0; i < series.size(); ++i) {
    SeriesDetails& found = details.series.emplace_back();
    const Json each = series.at(i);
    found.name = each.at("name").asString();
    found.samples = each.at("samples").asInteger();
    found.rateHz = each.at("rate_hz").asDouble();
    const Json columns = each.at("columns");
    for (std::size_t c = 0; c < columns.size(); ++c)
      found.columns.push_back(
          {columns.at(c).at("name").asString(), columns.at(c).at("unit").asString()});
  }
  return {path, std::move(entry)};
}

// Nothing where there is no cache, or one that can't be used.
Entries readCache(const fs::path& path) {
  Entries entries;
  try {
    const Json json = Json::parse(readTextFile(path, kLargestCache));
    if (json.at("format").asString() != kRecordingCatalogFormat ||
        json.at("version").asInteger() != kRecordingCatalogVersion)
      return {};
    const Json list = json.at("recordings");
    for (std::size_t i = 0; i < list.size(); ++i) entries.insert(fromJson(list.at(i)));
  } catch (const Error&) {
    return {};
  }
  return entries;
}

void writeCache(const fs::path& path, const Entries& entries) {
  std::error_code failure;
  fs::create_directories(path.parent_path(), failure);
  if (failure) throw FileError(path.parent_path(), "can't be created: " + failure.message());
  Json list = Json::array();
  for (const auto& [name, entry] : entries) list.push(toJson(name, entry));
  OutputFile file(path, Overwrite::kReplace);
  file.write(Json::object()
                 .set("format", kRecordingCatalogFormat)
                 .set("version", kRecordingCatalogVersion)
                 .set("recordings", std::move(list))
                 .text(-1));
  file.write("\n");
  file.commit();
}

// Network and user-space file systems don't tell what others change in them, and may hang.
bool isLocal(const fs::path& folder) {
  constexpr std::array<std::uint32_t, 6> kRemote{
      0x6969,      // NFS
      0x517B,      // SMB
      0xFE534D42,  // SMB 2
      0xFF534D42,  // CIFS
      0x01021997,  // 9P
      0x65735546,  // FUSE
  };
  struct statfs facts {};
  return ::statfs(folder.c_str(), &facts) == 0 &&
         std::find(kRemote.begin(), kRemote.end(), static_cast<std::uint32_t>(facts.f_type)) ==
             kRemote.end();
}

// What may change without a change of the file is asked again each time.
bool isKept(const RecordingDetails& details) {
  return details.state == RecordingDetails::State::kFinished ||
         details.state == RecordingDetails::State::kDamaged;
}

// One way through a folder.
class CatalogRun {
 public:
  CatalogRun(const fs::path& folder, const fs::path& cacheFolder, const CatalogSink& sink)
      : sink_(sink),
        folder_(folder),
        cachePath_(cacheFolder.empty() ? fs::path() : catalogCachePath(folder, cacheFolder)) {
    if (!cachePath_.empty()) known_ = readCache(cachePath_);
  }

  CatalogReport through(RecordingFolder listing, const Progress& progress) {
    report_.numFiles = listing.files.size();
    report_.problems = std::move(listing.problems);
    report_.folders = std::move(listing.folders);
    report_.local = isLocal(folder_);
    if (sink_.listed) sink_.listed(report_.numFiles);
    std::vector<std::pair<fs::path, Stamp>> unread;
    double bytesToRead = 0.0;
    for (fs::path& file : listing.files) {
      if (progress && !progress(0.0)) throw Cancelled();
      const Stamp stamp = recordingCatalogStampOf(file);
      const auto found = known_.find(keyOf(file));
      if (found != known_.end() && found->second.stamp == stamp) {
        found->second.details.path = file;
        take(found->second);
        continue;
      }
      bytesToRead += static_cast<double>(stamp[0]);
      unread.emplace_back(std::move(file), stamp);
    }
    readAll(unread, std::max(bytesToRead, 1.0), progress);
    if (kept_.size() != known_.size() || report_.numRead > 0) keep(kept_);
    return std::move(report_);
  }

 private:
  void take(const Entry& entry) {
    if (isKept(entry.details)) kept_.insert_or_assign(keyOf(entry.details.path), entry);
    if (sink_.take) sink_.take(RecordingDetails(entry.details));
  }

  void readAll(const std::vector<std::pair<fs::path, Stamp>>& files,
               double bytes,
               const Progress& progress) {
    double done = 0.0;
    std::vector<fs::path> paths;
    for (const auto& [file, stamp] : files) paths.push_back(file);
    ReadAhead<RecordingDetails> details(
        paths, [](const fs::path& file, const Progress& part, std::size_t threads) {
          return readDetails(file, part, threads);
        });
    try {
      for (const auto& [file, stamp] : files) {
        const double share = static_cast<double>(stamp[0]);
        const Progress part = [&](double fraction) {
          return !progress || progress((done + fraction * share) / bytes);
        };
        if (!part(0.0)) throw Cancelled();
        Entry entry{stamp, details.take(part)};
        done += share;
        ++report_.numRead;
        take(entry);
      }
    } catch (const Cancelled&) {
      // What wasn't looked at again may still be as it was.
      kept_.merge(known_);
      keep(kept_);
      throw;
    }
  }

  void keep(const Entries& entries) {
    if (cachePath_.empty()) return;
    try {
      writeCache(cachePath_, entries);
    } catch (const Error& error) {
      report_.cacheProblem = error.what();
    }
  }

  std::string keyOf(const fs::path& file) const {
    return file.lexically_relative(folder_).string();
  }

  const CatalogSink& sink_;
  fs::path folder_;
  fs::path cachePath_;
  Entries known_;
  Entries kept_;
  CatalogReport report_;
};

}  // namespace

fs::path catalogCachePath(const fs::path& folder, const fs::path& cacheFolder) {
  constexpr std::size_t kDigits = 16;
  std::error_code failure;
  const fs::path absolute = fs::weakly_canonical(folder, failure);
  const std::string name = failure ? folder.string() : absolute.string();
  const std::string hash = sha256(std::as_bytes(std::span(name.data(), name.size())));
  return cacheFolder / ("library_" + hash.substr(0, kDigits) + ".json");
}

CatalogReport catalogRecordings(const fs::path& folder,
                                const fs::path& cacheFolder,
                                const CatalogSink& sink,
                                const Progress& progress) {
  RecordingFolder listing = recordingsBelow(folder, progress);
  return CatalogRun(folder, cacheFolder, sink).through(std::move(listing), progress);
}

}  // namespace palpate
