// The curves of a recording as data: reads what a chart asks for beside the window, keeps it, and
// thins it for the width that is there. Short recordings are kept sample by sample. Of long ones
// there are, in this order: some samples spread evenly (at once), the extremes of every second (as
// they are read), and every sample of what is seen as soon as that isn't too much.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/signals/bucket_series.h>
#include <palpate/signals/min_max_decimation.h>
#include <palpate/signals/profile_series.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

class SeriesStore : public QObject {
  Q_OBJECT
 public:
  explicit SeriesStore(QObject* parent = nullptr);
  ~SeriesStore() override;

  void setRecording(const OpenedRecordingPtr& recording);  // null: none
  // What is plotted now; what the recording hasn't is left out. Others are forgotten.
  void setWanted(const std::vector<SeriesChoice>& wanted);
  // What is seen, from the first frame [s].
  void setVisibleRange(double fromS, double toS);

  // Of what is there now; gaps of the recording break the line. Empty: nothing yet.
  std::vector<SeriesPoint> points(const SeriesChoice& choice,
                                  const DecimationOptions& options) const;
  // The value at a time: the last sample at or before it; nothing where none is (or in a gap).
  std::optional<double> valueAt(const SeriesChoice& choice, double timeS) const;
  // Every sample, where the recording is short; else what is seen, once it is read. Null: not
  // there.
  std::shared_ptr<const Series> samples(const SeriesChoice& choice) const;
  // Largest and smallest of what is there, of the whole recording.
  std::optional<std::pair<double, double>> extremes(const SeriesChoice& choice) const;

  // Part of the recording that has been read for what is plotted; 1: all of it.
  double progress() const;
  bool busy() const { return progress() < 1.0 || numJobs_ > 0; }
  // For tests and pictures: waits for all that has been asked for, or only for the first look at
  // it.
  void waitUntilRead();
  void waitForFirstLook();

 signals:
  void changed();

 private:
  struct Entry {
    SeriesChoice choice;
    std::shared_ptr<const Series> whole;   // short recording
    std::shared_ptr<const Series> sample;  // long: spread evenly
    std::shared_ptr<BucketSeries> buckets;
    std::shared_ptr<const Series> exact;  // long: of exactFrom..exactTo
    double exactFromS = 0.0;
    double exactToS = -1.0;
    bool exactAsked = false;
    std::optional<std::pair<double, double>> extremes;
  };
  using Stop = std::shared_ptr<std::atomic<bool>>;

  Entry* find(const SeriesChoice& choice);
  const Entry* find(const SeriesChoice& choice) const;
  void begin(Entry& entry);
  void beginLong(Entry& entry);
  // Ready when it is done, or given up.
  std::shared_future<void> lookAtFrames();
  void takeFirstLook(Entry& entry) const;
  void askForExact();
  void deliver(const SeriesChoice& choice, const Stop& stop, std::function<void(Entry&)> put);
  const BucketSeries* bucketsOf(const Entry& entry) const;
  std::vector<std::size_t> breaksIn(const std::vector<double>& timeS) const;

  // Frames spread evenly over a long recording, with all their signals.
  struct FirstLook {
    std::vector<double> timeS;
    std::vector<std::vector<CharacteristicSignals>> rows;
  };

  OpenedRecordingPtr recording_;
  std::shared_ptr<const FirstLook> firstLook_;
  std::vector<Entry> entries_;
  double fromS_ = 0.0;
  double toS_ = 0.0;
  Stop stop_;           // of everything that is being read for this recording
  QThreadPool passes_;  // over whole recordings, one after the other
  QThreadPool reads_;   // short ones
  QTimer news_;
  std::atomic<int> numJobs_ = 0;
  double toldProgress_ = 1.0;
};

}  // namespace palpate::gui
