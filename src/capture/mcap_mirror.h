// Writes what a recording takes into an MCAP file beside it, on a thread of its own, so that the
// recording never waits for it. When it can't keep up or its disk fails, it stops, says so once,
// and takes nothing more. Private to this module.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "palpate/capture/capture_queue.h"
#include "palpate/core/bounded_queue.h"
#include "palpate/core/file_id.h"
#include "palpate/recording/mcap_recording.h"

namespace palpate {

// The recorder's thread calls all functions; none of them waits but finish().
class McapMirror {
 public:
  McapMirror(const McapWriteOptions& options, std::size_t queueItems);
  ~McapMirror();  // as finish()
  McapMirror(const McapMirror&) = delete;
  McapMirror& operator=(const McapMirror&) = delete;

  // Ends the open file and begins another one; `meta` as for a native recording.
  void begin(const std::filesystem::path& path,
             std::shared_ptr<const SensorLayout> layout,
             RecordingMeta meta);
  // Before the first sample of a series beside those of the hand, in each file.
  void addSeries(std::size_t series, const SeriesDescription& description);
  void add(const CaptureItem& item);
  // Writes what waits when the last time was a second ago.
  void flushWhenDue(std::int64_t monoUs);
  // Ends the file and the thread, and looks whether all files are still there.
  void finish();

  // Why it stopped; empty: it did not, or this was asked before.
  std::string takeFailure();
  // The files that were begun and are there.
  std::vector<std::filesystem::path> paths() const;

 private:
  struct Begin {
    std::filesystem::path path;
    std::shared_ptr<const SensorLayout> layout;
    RecordingMeta meta;
  };
  struct BeginSeries {
    std::size_t index = 0;
    SeriesDescription description;
  };
  struct Flush {};
  using Task = std::variant<Begin, BeginSeries, CaptureItem, Flush>;

  void push(Task task);
  void run();
  void work(Task& task);
  void fail(const std::string& why);

  const McapWriteOptions options_;
  BoundedQueue<Task> queue_;
  std::atomic<bool> stopped_ = false;  // nothing more is taken
  std::int64_t flushedMonoUs_ = 0;
  std::unique_ptr<McapLiveWriter> writer_;  // of the thread
  mutable std::mutex mutex_;
  std::string failure_;
  std::vector<std::pair<std::filesystem::path, std::optional<FileId>>> files_;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace palpate
