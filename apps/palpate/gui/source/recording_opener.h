// Opens recordings in a worker thread, one after the other, with progress and cancel. Signals come
// in the thread of this object.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <thread>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

class RecordingOpener : public QObject {
  Q_OBJECT
 public:
  // How a file is read; tests hand in their own.
  using Read = std::function<Profile(const std::filesystem::path&, const Progress&)>;

  explicit RecordingOpener(QObject* parent = nullptr);
  RecordingOpener(Read read, QObject* parent = nullptr);
  // Cancels and waits for the worker.
  ~RecordingOpener() override;

  // Appends to what is to be opened. The ticket comes back with opened(); none is given twice.
  std::uint64_t open(const std::filesystem::path& path);
  // Gives up the file in work and all that wait; cancelled() follows when something was given up.
  void cancel();
  bool busy() const noexcept { return busy_; }
  std::size_t numWaiting() const noexcept { return waiting_.size(); }

 signals:
  void started(const QString& path);
  void progressed(double fraction);  // 0..1
  void opened(palpate::gui::OpenedRecordingPtr recording, std::uint64_t ticket);
  // message: one line that says what is wrong, where, and what to do.
  void failed(const QString& path, const QString& message);
  void cancelled(const QString& path);
  // Nothing waits any more.
  void finished();

 private:
  struct Asked {
    std::filesystem::path path;
    std::uint64_t ticket = 0;
  };
  void startNext();
  void work(const Asked& asked);
  // Runs `report` in this object's thread, then goes on with the next file.
  void conclude(std::function<void()> report);

  Read read_;
  std::deque<Asked> waiting_;
  std::uint64_t tickets_ = 0;  // given
  std::atomic<bool> cancelRequested_ = false;
  bool busy_ = false;
  std::jthread worker_;
};

}  // namespace palpate::gui
