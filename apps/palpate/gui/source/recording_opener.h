// Opens recordings in the background, one after the other, with progress and cancel.
#pragma once

#include <QObject>
#include <QString>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>

#include "gui/source/background_job.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

class RecordingOpener : public QObject {
  Q_OBJECT
 public:
  // How a file is read; tests supply their own function.
  using Read = std::function<Recording(const std::filesystem::path&, const Progress&)>;
  // How the readable part of a damaged file is read.
  using ReadDamaged = Read;

  explicit RecordingOpener(QObject* parent = nullptr);
  // Without `readDamaged` a damaged file fails.
  RecordingOpener(Read read, ReadDamaged readDamaged, QObject* parent = nullptr);
  RecordingOpener(Read read, QObject* parent = nullptr);

  // Adds a file to the queue. Returns a unique ticket, which opened() passes on.
  std::uint64_t open(const std::filesystem::path& path);
  // Cancels the file that is being read and all that wait; cancelled() follows if there was any.
  void cancel();
  bool busy() const noexcept { return job_.busy(); }
  // Whether the file of this ticket is being read or waits, and was not cancelled.
  bool pending(std::uint64_t ticket) const;
  std::size_t numWaiting() const noexcept { return waiting_.size(); }

 signals:
  void started(const QString& path);
  // Progress of the file that is being read, 0..1.
  void progressed(double fraction);
  void opened(palpate::gui::OpenedRecordingPtr recording, std::uint64_t ticket);
  // `message`: one line that tells what is wrong, where, and what to do.
  void failed(const QString& path, const QString& message);
  void cancelled(const QString& path);
  // The queue is empty.
  void finished();

 private:
  Read read_;
  ReadDamaged readDamaged_;
  // Tickets.
  std::deque<std::uint64_t> waiting_;
  // Number of tickets given.
  std::uint64_t tickets_ = 0;
  // The ticket of the file that is being read, or was read last; 0: none, or it was cancelled.
  std::uint64_t current_ = 0;
  BackgroundJob job_{BackgroundJob::Leaving::kAtOnce};
};

}  // namespace palpate::gui
