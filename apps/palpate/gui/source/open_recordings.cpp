#include "gui/source/open_recordings.h"

#include <algorithm>
#include <utility>

namespace palpate::gui {
namespace {

bool isWhole(const OpenedRecording& recording) {
  return recording.damage.empty() && !isUnfinished(recording);
}

}  // namespace

OpenRecordings::OpenRecordings(RecordingOpener& opener, QObject* parent)
    : QObject(parent), opener_(opener) {
  connect(&opener, &RecordingOpener::opened, this, &OpenRecordings::take);
  connect(&opener, &RecordingOpener::finished, this, [this] {
    // Another slot of the same signal may have requested more files.
    if (opener_.busy()) return;
    running_.clear();
    emit settled();
  });
}

void OpenRecordings::open(const OpenRequest& request) {
  for (const auto& [ticket, running] : running_)
    if (running->request == request && opener_.pending(ticket)) return;
  const auto running = std::make_shared<Running>(Running{request});
  for (const std::filesystem::path& file : request.files) {
    const OpenedRecordingPtr known = at(file);
    const bool otherPath = known && known->path != file;
    const bool shownAsItIs = known && isWhole(*known) && (otherPath || !request.readAnew);
    if (shownAsItIs || (known && mayReadAnew && !mayReadAnew(known)))
      arriveAgain(known, file, *running);
    else
      running_[opener_.open(known ? known->path : file)] = running;
  }
}

void OpenRecordings::take(const OpenedRecordingPtr& recording, std::uint64_t ticket) {
  const auto asked = running_.find(ticket);
  // A file requested directly from the opener forms a request of its own.
  const auto running =
      asked != running_.end() ? asked->second : std::make_shared<Running>(Running{});
  if (asked != running_.end()) running_.erase(asked);
  const OpenedRecordingPtr known = at(recording->path);
  if (known && known->path != recording->path) return arriveAgain(known, recording->path, *running);
  if (known && mayReplace && !mayReplace(known)) return arrive(known, nullptr, *running);
  if (known) {
    *std::find(all_.begin(), all_.end(), known) = recording;
    emit gone(known);
  } else {
    all_.push_back(recording);
  }
  arrive(recording, known, *running);
}

void OpenRecordings::arrive(const OpenedRecordingPtr& recording,
                            OpenedRecordingPtr replaced,
                            Running& running) {
  const OpenArrival arrival{running.request.then, running.numArrived++, std::move(replaced)};
  emit arrived(recording, arrival);
}

void OpenRecordings::arriveAgain(const OpenedRecordingPtr& known,
                                 const std::filesystem::path& asked,
                                 Running& running) {
  arrive(known, nullptr, running);
  if (known->path != asked) emit openAlready(known, asked);
}

OpenedRecordingPtr OpenRecordings::close(const OpenedRecordingPtr& recording) {
  const auto at = std::find(all_.begin(), all_.end(), recording);
  if (at == all_.end()) return nullptr;
  const OpenedRecordingPtr closed = *at;
  const auto behind = all_.erase(at);
  const OpenedRecordingPtr next = all_.empty()           ? nullptr
                                  : behind == all_.end() ? all_.back()
                                                         : *behind;
  emit gone(closed);
  return next;
}

OpenedRecordingPtr OpenRecordings::at(const std::filesystem::path& path) const {
  for (const OpenedRecordingPtr& recording : all_)
    if (recording->path == path) return recording;
  // The files are compared as they are now; one that is missing is none of them.
  std::error_code missing;
  for (const OpenedRecordingPtr& recording : all_)
    if (std::filesystem::equivalent(recording->path, path, missing)) return recording;
  return nullptr;
}

OpenedRecordingPtr OpenRecordings::neighbour(const OpenedRecordingPtr& of, int step) const {
  const auto found = std::find(all_.begin(), all_.end(), of);
  if (found == all_.end()) return nullptr;
  const auto count = static_cast<std::ptrdiff_t>(all_.size());
  return all_[static_cast<std::size_t>(((found - all_.begin() + step) % count + count) % count)];
}

}  // namespace palpate::gui
