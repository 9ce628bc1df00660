// Looks for recordings that were never finished and recovers them, in a worker thread, one piece of
// work after the other. What is found is only read: a recovered recording is a new file beside it.
// Signals come in the thread of this object.
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
  // How one is recovered; tests hand in their own.
  using Recover = std::function<RecoverReport(
      const std::filesystem::path& in, const std::filesystem::path& out, const Progress&)>;

  // The settings must outlive it: they remember which ones nobody wants to hear of again.
  explicit RecoveryFinder(QSettings& settings, QObject* parent = nullptr);
  RecoveryFinder(QSettings& settings, Recover recoverFile, QObject* parent = nullptr);
  // Cancels and waits for the worker.
  ~RecoveryFinder() override;

  // found() follows, unless it is cancelled: also with an empty list.
  void look(const QString& folder);
  // recovered() or failed() of each follow in this order, then one finished().
  void recover(const QStringList& paths);
  // Gives up what is in work and all that waits; nothing half-done is left. Of a look that is given
  // up nothing is heard, of a recovery finished().
  void cancel();
  bool busy() const noexcept { return busy_; }

  // Doesn't offer these again until they change. Only of what was found.
  void ignore(const QStringList& paths);

 signals:
  // Those that aren't ignored, the one changed last first.
  void found(const QStringList& paths);
  void progressed(double fraction);  // of what recover() was given, 0..1
  // message: one line, what was saved and what is lost; `saved` is the new recording.
  void recovered(const QString& path, const QString& message, const QString& saved);
  // message: one line that says what is wrong and what to do; of a folder that can't be looked
  // into, too.
  void failed(const QString& path, const QString& message);
  void finished();

 private:
  // Says in this object's thread what came of a piece of work.
  using Report = std::function<void()>;
  // Runs in the worker; stops soon when the flag is set.
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
  std::map<QString, std::int64_t> changedUs_;  // of all that was found
  std::deque<Task> waiting_;
  std::shared_ptr<std::atomic<bool>> inWork_;  // its flag
  bool busy_ = false;
  std::jthread worker_;
};

}  // namespace palpate::gui
