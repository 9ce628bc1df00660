#include "gui/source/recording_opener.h"

#include <algorithm>
#include <new>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/recording/recording.h>

namespace palpate::gui {
namespace {

// Share of reading in the whole work; computing the signals is the rest.
constexpr double kRecordingOpenerReadShare = 0.6;

OpenedRecordingPtr openedBy(const RecordingOpener::Read& read,
                            const RecordingOpener::ReadDamaged& readDamaged,
                            const std::filesystem::path& path,
                            const Progress& progress) {
  const Progress reading = [&](double done) { return progress(kRecordingOpenerReadShare * done); };
  const Progress computing = [&](double done) {
    return progress(kRecordingOpenerReadShare + (1.0 - kRecordingOpenerReadShare) * done);
  };
  try {
    try {
      return makeOpenedRecording(path, read(path, reading), computing);
    } catch (const FormatError& error) {
      if (!readDamaged) throw;
      Recording readable = readDamaged(path, reading);
      if (readable.damage.text.empty()) readable.damage.text = error.what();
      return makeOpenedRecording(path, std::move(readable), computing);
    }
  } catch (const std::bad_alloc&) {
    throw Error(path.string() + ": too large for this computer's memory");
  }
}

}  // namespace

RecordingOpener::RecordingOpener(QObject* parent)
    : RecordingOpener([](const std::filesystem::path& path,
                         const Progress& progress) { return readRecording(path, {}, progress); },
                      [](const std::filesystem::path& path, const Progress& progress) {
                        return readableRecording(path, {}, progress);
                      },
                      parent) {}

RecordingOpener::RecordingOpener(Read read, QObject* parent)
    : RecordingOpener(std::move(read), {}, parent) {}

RecordingOpener::RecordingOpener(Read read, ReadDamaged readDamaged, QObject* parent)
    : QObject(parent), read_(std::move(read)), readDamaged_(std::move(readDamaged)) {
  connect(&job_, &BackgroundJob::started, this, [this](const QString& path) {
    current_ = waiting_.front();
    waiting_.pop_front();
    emit started(path);
  });
  connect(&job_, &BackgroundJob::progressed, this, &RecordingOpener::progressed);
  connect(&job_, &BackgroundJob::failed, this, [this](const QString& message, const QString& path) {
    emit failed(path, message);
  });
  connect(&job_, &BackgroundJob::cancelled, this, &RecordingOpener::cancelled);
  connect(&job_, &BackgroundJob::finished, this, &RecordingOpener::finished);
}

std::uint64_t RecordingOpener::open(const std::filesystem::path& path) {
  const std::uint64_t ticket = ++tickets_;
  waiting_.push_back(ticket);
  auto recording = std::make_shared<OpenedRecordingPtr>();
  job_.start(
      QString::fromStdString(path.string()),
      [recording, read = read_, readDamaged = readDamaged_, path](const Progress& progress) {
        *recording = openedBy(read, readDamaged, path, progress);
      },
      [this, recording, ticket] { emit opened(*recording, ticket); });
  return ticket;
}

void RecordingOpener::cancel() {
  waiting_.clear();
  current_ = 0;
  job_.cancel();
}

bool RecordingOpener::pending(std::uint64_t ticket) const {
  return (busy() && ticket == current_) ||
         std::find(waiting_.begin(), waiting_.end(), ticket) != waiting_.end();
}

}  // namespace palpate::gui
