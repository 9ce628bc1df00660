// Finds recordings that were never finished and recovers them in the background, one task after the
// other. Found files are only read: a recovered recording is a new file next to the old one.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <QStringList>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/library/unfinished_recordings.h>
#include <palpate/recording/recording.h>

#include "gui/source/background_job.h"

namespace palpate::gui {

class RecoveryFinder : public QObject {
  Q_OBJECT
 public:
  // The function that recovers a recording; tests pass their own.
  using Recover = std::function<RecoverReport(
      const std::filesystem::path& in, const std::filesystem::path& out, const Progress&)>;

  // `settings` stores the ignored recordings; it must outlive this.
  explicit RecoveryFinder(QSettings& settings, QObject* parent = nullptr);
  RecoveryFinder(QSettings& settings, Recover recoverFile, QObject* parent = nullptr);

  // Searches the folder; found() follows, also with an empty list, unless cancelled.
  void look(const QString& folder);
  // For each path recovered() or failed() follows in this order, then finished() once.
  void recover(const QStringList& paths);
  // Cancels the running and all waiting tasks; no incomplete file remains. A cancelled search emits
  // nothing, a cancelled recovery emits finished().
  void cancel() { job_.cancel(); }
  bool busy() const noexcept { return job_.busy(); }

  // Does not offer these recordings again until they change. Applies only to paths that were found.
  void ignore(const QStringList& paths);

 signals:
  // The recordings that are not ignored, the last changed first.
  void found(const QStringList& paths);
  // Progress of recover(), 0..1.
  void progressed(double fraction);
  // `message`: one line that tells what was saved and what is lost; `saved` is the new recording.
  void recovered(const QString& path, const QString& message, const QString& saved);
  // `message`: one line with the problem and what the user can do. `path` may also be a folder that
  // cannot be read.
  void failed(const QString& path, const QString& message);
  void finished();

 private:
  void offer(const std::vector<UnfinishedRecording>& recordings);
  void endRecovery();

  QSettings& settings_;
  Recover recoverFile_;
  // Time of the last change of each found recording [us].
  std::map<QString, std::int64_t> changedUs_;
  // Calls of recover() without finished() so far.
  int recoveries_ = 0;
  BackgroundJob job_{BackgroundJob::Leaving::kAtOnce};
};

}  // namespace palpate::gui
