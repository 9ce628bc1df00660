#include "gui/record/recovery_finder.h"

#include <QMetaObject>
#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr const char* kIgnored = "recording/ignored";
constexpr qsizetype kMostIgnored = 500;               // the oldest entries are removed
constexpr double kRecoveryFinderSmallestNews = 0.01;  // step of progress reports

std::string narrow(const QString& path) { return path.toStdString(); }

// A recording with its time of change; a changed recording counts as another one.
QString entryOf(const QString& path, std::int64_t changedUs) {
  return QString::number(changedUs) + " " + path;
}
QString pathOf(const QString& entry) { return entry.section(' ', 1); }

QString unfinishedFinderMessageOf(const std::exception& error, const QString& path) {
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return path + ": too large for this computer's memory";
  return QString::fromUtf8(error.what());
}

}  // namespace

RecoveryFinder::RecoveryFinder(QSettings& settings, QObject* parent)
    : RecoveryFinder(
          settings,
          [](const auto& in, const auto& out, const Progress& progress) {
            return recoverRecording(in, out, Overwrite::kRefuse, progress);
          },
          parent) {}

RecoveryFinder::RecoveryFinder(QSettings& settings, Recover recoverFile, QObject* parent)
    : QObject(parent), settings_(settings), recoverFile_(std::move(recoverFile)) {}

RecoveryFinder::~RecoveryFinder() {
  cancel();
  if (worker_.joinable()) worker_.join();
}

void RecoveryFinder::look(const QString& folder) {
  begin([this, folder](const auto& cancelled) { return lookInto(folder, cancelled); });
}

void RecoveryFinder::recover(const QStringList& paths) {
  begin([this, paths](const auto& cancelled) { return recoverAll(paths, cancelled); });
}

void RecoveryFinder::cancel() {
  if (inWork_) *inWork_ = true;
  // Each cancelled task still reports its end.
  for (Task& task : waiting_) *task.cancelled = true;
}

void RecoveryFinder::begin(Work work) {
  waiting_.push_back({std::move(work), std::make_shared<std::atomic<bool>>(false)});
  if (!busy_) startNext();
}

void RecoveryFinder::startNext() {
  inWork_.reset();
  if (waiting_.empty()) return;
  const Task task = std::move(waiting_.front());
  waiting_.pop_front();
  busy_ = true;
  inWork_ = task.cancelled;
  // The thread has already reported, so that joining does not wait.
  if (worker_.joinable()) worker_.join();
  worker_ = std::jthread([this, task] {
    Report report = task.work(*task.cancelled);
    postResult([this, report = std::move(report)] {
      busy_ = false;
      report();
      // Unless the receiver of the report started the next task.
      if (!busy_) startNext();
    });
  });
}

void RecoveryFinder::postResult(Report report) {
  QMetaObject::invokeMethod(this, std::move(report), Qt::QueuedConnection);
}

RecoveryFinder::Report RecoveryFinder::lookInto(const QString& folder,
                                                const std::atomic<bool>& cancelled) {
  try {
    auto recordings = findUnfinished(narrow(folder), [&](double) { return !cancelled; });
    return [this, recordings = std::move(recordings)] { offer(recordings); };
  } catch (const Cancelled&) {
    return [] {};
  } catch (const std::exception& error) {
    const QString message = unfinishedFinderMessageOf(error, folder);
    return [this, folder, message] {
      emit failed(folder, message);
      emit found({});
    };
  }
}

RecoveryFinder::Report RecoveryFinder::recoverAll(const QStringList& paths,
                                                  const std::atomic<bool>& cancelled) {
  double reported = -1.0;
  for (qsizetype i = 0; i < paths.size() && !cancelled; ++i) {
    const auto progress = [&](double fraction) {
      const double now = (static_cast<double>(i) + fraction) / static_cast<double>(paths.size());
      if (now - reported >= kRecoveryFinderSmallestNews) {
        reported = now;
        postResult([this, now] { emit progressed(now); });
      }
      return !cancelled;
    };
    try {
      recoverOne(paths[i], progress);
    } catch (const Cancelled&) {
      break;
    } catch (const std::exception& error) {
      const QString message = unfinishedFinderMessageOf(error, paths[i]);
      postResult([this, path = paths[i], message] { emit failed(path, message); });
    }
  }
  return [this] { emit finished(); };
}

void RecoveryFinder::recoverOne(const QString& path, const Progress& progress) {
  const std::filesystem::path saved = recoveredPathOf(narrow(path));
  const RecoverReport report = recoverFile_(narrow(path), saved, progress);
  const QString message = QString::fromStdString(report.message);
  if (report.state == RecoverReport::State::kNothing)
    postResult([this, path, message] { emit failed(path, path + ": " + message); });
  else
    postResult([this, path, message, saved] { emit recovered(path, message, pathText(saved)); });
}

void RecoveryFinder::offer(const std::vector<UnfinishedRecording>& recordings) {
  const QStringList ignored = settings_.value(kIgnored).toStringList();
  QStringList paths;
  for (const UnfinishedRecording& recording : recordings) {
    const QString path = pathText(recording.path);
    changedUs_[path] = recording.changedUs;
    if (!ignored.contains(entryOf(path, recording.changedUs))) paths.append(path);
  }
  emit found(paths);
}

void RecoveryFinder::ignore(const QStringList& paths) {
  QStringList ignored = settings_.value(kIgnored).toStringList();
  for (const QString& path : paths) {
    const auto known = changedUs_.find(path);
    if (known == changedUs_.end()) continue;
    ignored.removeIf([&](const QString& entry) { return pathOf(entry) == path; });
    ignored.append(entryOf(path, known->second));
  }
  settings_.setValue(kIgnored, ignored.mid(std::max<qsizetype>(0, ignored.size() - kMostIgnored)));
}

}  // namespace palpate::gui
