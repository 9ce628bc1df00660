// Finds recordings that were never finished and recovers them in a worker thread, one task after
// the other. Found files are only read: a recovered recording is a new file next to the old one.
// Signals are emitted in the thread of this object.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <QStringList>
#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/recording/recording.h>
#include <palpate/recording/unfinished_recordings.h>

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
  // Cancels and waits for the worker.
  ~RecoveryFinder() override;

  // Searches the folder; found() follows, also with an empty list, unless cancelled.
  void look(const QString& folder);
  // For each path recovered() or failed() follows in this order, then finished() once.
  void recover(const QStringList& paths);
  // Cancels the running and all waiting tasks; no incomplete file remains. A cancelled search emits
  // nothing, a cancelled recovery emits finished().
  void cancel();
  bool busy() const noexcept { return busy_; }

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
  // Reports the result of a task in this object's thread.
  using Report = std::function<void()>;
  // Runs in the worker; returns soon after the flag is set.
  using Work = std::function<Report(const std::atomic<bool>& cancelled)>;
  struct Task {
    Work work;
    std::shared_ptr<std::atomic<bool>> cancelled;
  };

  void begin(Work work);
  void startNext();
  Report lookInto(const QString& folder, const std::atomic<bool>& cancelled);
  Report recoverAll(const QStringList& paths, const std::atomic<bool>& cancelled);
  void recoverOne(const QString& path, const Progress& progress);
  void postResult(Report report);
  void offer(const std::vector<UnfinishedRecording>& recordings);

  QSettings& settings_;
  Recover recoverFile_;
  // Time of the last change of each found recording [us].
  std::map<QString, std::int64_t> changedUs_;
  std::deque<Task> waiting_;
  // The cancel flag of the running task.
  std::shared_ptr<std::atomic<bool>> inWork_;
  bool busy_ = false;
  std::jthread worker_;
};

}  // namespace palpate::gui
