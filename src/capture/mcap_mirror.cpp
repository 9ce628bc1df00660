#include "capture/mcap_mirror.h"

#include <exception>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"

namespace palpate {
namespace {

constexpr std::int64_t kMcapFlushUs = 1'000'000;

}  // namespace

McapMirror::McapMirror(const McapWriteOptions& options, std::size_t queueItems)
    : options_(options), queue_(queueItems) {
  options.validate();
  thread_ = std::jthread([this] { run(); });
}

McapMirror::~McapMirror() { finish(); }

void McapMirror::push(Task task) {
  if (stopped_) return;
  if (!queue_.tryPush(std::move(task))) fail("it could not keep up with the recording");
}

void McapMirror::begin(const std::filesystem::path& path,
                       std::shared_ptr<const SensorLayout> layout,
                       RecordingMeta meta) {
  push(Begin{path, std::move(layout), std::move(meta)});
}

void McapMirror::addSeries(std::size_t series, const SeriesDescription& description) {
  push(BeginSeries{series, description});
}

void McapMirror::add(const CaptureItem& item) { push(item); }

void McapMirror::flushWhenDue(std::int64_t monoUs) {
  if (monoUs - flushedMonoUs_ < kMcapFlushUs) return;
  flushedMonoUs_ = monoUs;
  push(Flush{});
}

void McapMirror::finish() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  for (const auto& [path, file] : files_) {
    try {
      if (file) requireLeadsTo(path, *file);
    } catch (const FileError& error) {
      fail(error.what());
    }
  }
}

std::string McapMirror::takeFailure() {
  const std::lock_guard lock(mutex_);
  return std::exchange(failure_, {});
}

std::vector<std::filesystem::path> McapMirror::paths() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::filesystem::path> paths;
  for (const auto& [path, file] : files_)
    if (!file || leadsTo(path, *file)) paths.push_back(path);
  return paths;
}

// Only the first failure is reported.
void McapMirror::fail(const std::string& why) {
  if (stopped_.exchange(true)) return;
  const std::lock_guard lock(mutex_);
  failure_ = why;
}

void McapMirror::run() {
  bool broken = false;
  const auto attempt = [&](const auto& what) {
    if (broken) return;
    try {
      what();
    } catch (const std::exception& error) {  // of the disk, memory, a file that is there already
      broken = true;
      fail(error.what());
    }
  };
  while (auto task = queue_.pop()) attempt([&] { work(*task); });
  // Also where it could not keep up: the file ends with what was taken until then.
  attempt([&] {
    if (writer_) writer_->finish();
  });
  writer_.reset();
}

void McapMirror::work(Task& task) {
  if (auto* begin = std::get_if<Begin>(&task)) {
    if (writer_) writer_->finish();
    writer_.reset();
    HandDescription hand = recordedHand(begin->meta, *begin->layout, 0, 0);
    hand.layout = begin->layout;
    writer_ = std::make_unique<McapLiveWriter>(begin->path, hand, begin->meta, options_);
    const std::lock_guard lock(mutex_);
    files_.emplace_back(begin->path, fileIdOf(begin->path));
    return;
  }
  if (!writer_) return;
  if (std::holds_alternative<Flush>(task)) return writer_->flush();
  if (const auto* series = std::get_if<BeginSeries>(&task))
    return writer_->addSeries(series->index, series->description);
  const auto& item = std::get<CaptureItem>(task);
  if (const auto* frame = std::get_if<SharedFrame>(&item))
    writer_->addFrame(**frame);
  else if (const auto* sample = std::get_if<Sample>(&item))
    writer_->addSample(*sample);
  else
    writer_->addEvent(std::get<Event>(item));
}

}  // namespace palpate
