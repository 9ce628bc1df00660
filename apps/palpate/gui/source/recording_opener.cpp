#include "gui/source/recording_opener.h"

#include <QMetaObject>
#include <algorithm>
#include <new>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/recording/recording.h>

namespace palpate::gui {
namespace {

// Share of reading in the whole work; computing the signals is the rest.
constexpr double kRecordingOpenerReadShare = 0.6;
// Least step of progress that is reported.
constexpr double kRecordingOpenerSmallestNews = 0.01;

}  // namespace

RecordingOpener::RecordingOpener(QObject* parent)
    : RecordingOpener([](const std::filesystem::path& path,
                         const Progress& progress) { return openRecording(path, progress); },
                      [](const std::filesystem::path& path, const Progress& progress) {
                        return readableRecording(path, progress);
                      },
                      parent) {}

RecordingOpener::RecordingOpener(Read read, QObject* parent)
    : RecordingOpener(std::move(read), {}, parent) {}

RecordingOpener::RecordingOpener(Read read, ReadDamaged readDamaged, QObject* parent)
    : QObject(parent), read_(std::move(read)), readDamaged_(std::move(readDamaged)) {}

RecordingOpener::~RecordingOpener() {
  waiting_.clear();
  cancelRequested_ = true;
  if (worker_.joinable()) worker_.join();
}

std::uint64_t RecordingOpener::open(const std::filesystem::path& path) {
  waiting_.push_back({path, ++tickets_});
  if (!busy_) startNext();
  return tickets_;
}

void RecordingOpener::cancel() {
  waiting_.clear();
  cancelRequested_ = true;
}

bool RecordingOpener::pending(std::uint64_t ticket) const {
  if (busy_ && ticket == current_) return !cancelRequested_;
  return std::any_of(waiting_.begin(), waiting_.end(), [ticket](const Asked& asked) {
    return asked.ticket == ticket;
  });
}

void RecordingOpener::startNext() {
  if (waiting_.empty()) {
    busy_ = false;
    emit finished();
    return;
  }
  const Asked asked = waiting_.front();
  waiting_.pop_front();
  busy_ = true;
  current_ = asked.ticket;
  cancelRequested_ = false;
  emit started(QString::fromStdString(asked.path.string()));
  // The thread has already reported its result: joining it takes no time.
  if (worker_.joinable()) worker_.join();
  worker_ = std::jthread([this, asked] { work(asked); });
}

void RecordingOpener::work(const Asked& asked) {
  const std::filesystem::path& path = asked.path;
  const QString name = QString::fromStdString(path.string());
  double reported = -1.0;
  const std::function<Progress(double, double)> part = [&](double from, double share) -> Progress {
    return [this, &reported, from, share](double fraction) {
      const double now = from + share * fraction;
      if (now - reported >= kRecordingOpenerSmallestNews) {
        reported = now;
        QMetaObject::invokeMethod(
            this, [this, now] { emit progressed(now); }, Qt::QueuedConnection);
      }
      return !cancelRequested_;
    };
  };
  try {
    OpenedRecordingPtr recording;
    try {
      Profile profile = read_(path, part(0.0, kRecordingOpenerReadShare));
      recording =
          makeOpenedRecording(path,
                              std::move(profile),
                              part(kRecordingOpenerReadShare, 1.0 - kRecordingOpenerReadShare));
    } catch (const FormatError& error) {
      if (!readDamaged_) throw;
      recording = readablePart(path, error.what(), part);
    }
    conclude([this, recording, ticket = asked.ticket] { emit opened(recording, ticket); });
  } catch (const Cancelled&) {
    conclude([this, name] { emit cancelled(name); });
  } catch (const std::bad_alloc&) {
    conclude([this, name] { emit failed(name, name + ": too large for this computer's memory"); });
  } catch (const std::exception& error) {
    const QString message = QString::fromUtf8(error.what());
    conclude([this, name, message] { emit failed(name, message); });
  }
}

// Throws FormatError when nothing can be read.
OpenedRecordingPtr RecordingOpener::readablePart(
    const std::filesystem::path& path,
    const std::string& why,
    const std::function<Progress(double, double)>& part) const {
  ReadableRecording readable = readDamaged_(path, part(0.0, kRecordingOpenerReadShare));
  if (readable.damage.empty()) readable.damage = why;
  return makeOpenedRecording(
      path, std::move(readable), part(kRecordingOpenerReadShare, 1.0 - kRecordingOpenerReadShare));
}

void RecordingOpener::conclude(std::function<void()> report) {
  QMetaObject::invokeMethod(
      this,
      [this, report = std::move(report)] {
        report();
        startNext();
      },
      Qt::QueuedConnection);
}

}  // namespace palpate::gui
