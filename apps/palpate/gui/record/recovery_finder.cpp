#include "gui/record/recovery_finder.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr const char* kIgnored = "recording/ignored";
constexpr qsizetype kMaxIgnored = 500;                // the oldest entries are removed
constexpr double kRecoveryFinderSmallestNews = 0.01;  // step of progress reports

std::string narrow(const QString& path) { return path.toStdString(); }

// A recording with its time of change; a changed recording counts as another one.
QString entryOf(const QString& path, std::int64_t changedUs) {
  return QString::number(changedUs) + " " + path;
}
QString pathOf(const QString& entry) { return entry.section(' ', 1); }

}  // namespace

RecoveryFinder::RecoveryFinder(QSettings& settings, QObject* parent)
    : RecoveryFinder(
          settings,
          [](const auto& in, const auto& out, const Progress& progress) {
            return recoverRecording(in, out, Overwrite::kRefuse, progress);
          },
          parent) {}

RecoveryFinder::RecoveryFinder(QSettings& settings, Recover recoverFile, QObject* parent)
    : QObject(parent), settings_(settings), recoverFile_(std::move(recoverFile)) {
  connect(&job_, &BackgroundJob::failed, this, [this](const QString& message, const QString& path) {
    emit failed(path, message);
  });
  connect(&job_, &BackgroundJob::progressed, this, [this](double fraction) {
    if (recoveries_ > 0) emit progressed(fraction);
  });
  // Those that were cancelled before they began, too.
  connect(&job_, &BackgroundJob::finished, this, [this] {
    while (recoveries_ > 0) endRecovery();
  });
}

void RecoveryFinder::look(const QString& folder) {
  struct Result {
    std::vector<UnfinishedRecording> recordings;
    QString problem;
  };
  auto result = std::make_shared<Result>();
  job_.start(
      folder,
      [result, folder](const Progress& progress) {
        try {
          result->recordings =
              findUnfinished(narrow(folder), [&](double) { return progress(0.0); });
        } catch (const Cancelled&) {
          throw;
        } catch (const std::exception& error) {
          result->problem = QString::fromUtf8(error.what());
        }
      },
      [this, result, folder] {
        if (!result->problem.isEmpty()) emit failed(folder, result->problem);
        offer(result->recordings);
      });
}

void RecoveryFinder::recover(const QStringList& paths) {
  ++recoveries_;
  const auto count = static_cast<double>(paths.size());
  for (qsizetype i = 0; i < paths.size(); ++i) {
    const QString path = paths[i];
    const std::filesystem::path saved = recoveredPathOf(narrow(path));
    auto report = std::make_shared<RecoverReport>();
    job_.start(
        path,
        [report, recoverFile = recoverFile_, path, saved, i, count](const Progress& progress) {
          try {
            *report = recoverFile(narrow(path), saved, [&](double fraction) {
              return progress((static_cast<double>(i) + fraction) / count);
            });
          } catch (const std::bad_alloc&) {
            throw Error(narrow(path) + ": too large for this computer's memory");
          }
        },
        [this, report, path, saved] {
          const QString message = QString::fromStdString(report->message);
          if (report->state == RecoverReport::State::kNothing)
            emit failed(path, path + ": " + message);
          else
            emit recovered(path, message, pathText(saved));
        });
  }
  job_.start(
      {}, [](const Progress&) {}, [this] { endRecovery(); });
}

void RecoveryFinder::endRecovery() {
  --recoveries_;
  emit finished();
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
  settings_.setValue(kIgnored, ignored.mid(std::max<qsizetype>(0, ignored.size() - kMaxIgnored)));
}

}  // namespace palpate::gui
