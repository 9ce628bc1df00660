// Supplies the data of the plotted curves: reads what a chart needs in the background, caches it,
// and decimates it for the available width. Short recordings are kept sample by sample. For long
// ones three forms follow each other: some samples spread evenly (at once), the extremes of every
// second (as they are read), and every sample of the visible span as soon as those aren't too many.
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

  // Null: none.
  void setRecording(const OpenedRecordingPtr& recording);
  // Sets the profile that the curves are read from: that of the recording with computed series.
  // What was computed before is dropped; setWanted() asks for it anew.
  void setProfile(const Profile& profile);
  // Sets the plotted curves; those that the recording doesn't have are left out. Data of all others
  // are dropped.
  void setWanted(const std::vector<SeriesChoice>& wanted);
  // Sets the visible span, from the first frame [s].
  void setVisibleRange(double fromS, double toS);

  // Decimated points of the data read so far; gaps of the recording break the line. Empty: nothing
  // has been read yet.
  std::vector<SeriesPoint> points(const SeriesChoice& choice,
                                  const DecimationOptions& options) const;
  // The value at a time: that of the last sample at or before it; nothing if there is none, in a
  // gap, or for a formula with a frequency filter that would have to be computed first.
  std::optional<double> valueAt(const SeriesChoice& choice, double timeS) const;
  // Whether every sample of the span is in memory: valueAt() reads no file.
  bool holds(const SeriesChoice& choice, double fromS, double toS) const;
  // Every sample of a short recording; of a long one those of the visible span once they are read.
  // Null: not read yet.
  std::shared_ptr<const Series> samples(const SeriesChoice& choice) const;
  // Smallest and largest value of the data read so far, of the whole recording.
  std::optional<std::pair<double, double>> extremes(const SeriesChoice& choice) const;

  // Share of the recording that has been read for the plotted curves, 0..1.
  double progress() const;
  // Share of the series that are being computed now for a curve; nothing: none is.
  std::optional<double> computing() const;
  bool busy() const { return progress() < 1.0 || numJobs_ > 0; }
  // Wait for everything that was requested, or only for the first samples; for tests and pictures.
  void waitUntilRead();
  void waitForFirstLook();

 signals:
  void changed();

 private:
  using Stop = std::shared_ptr<std::atomic<bool>>;
  struct Entry {
    SeriesChoice choice;
    // Short recording: all samples.
    std::shared_ptr<const Series> whole;
    // Long recording: samples spread evenly.
    std::shared_ptr<const Series> sample;
    std::shared_ptr<BucketSeries> buckets;
    // Long recording: every sample of exactFromS..exactToS.
    std::shared_ptr<const Series> exact;
    double exactFromS = 0.0;
    double exactToS = -1.0;
    bool exactRequested = false;
    std::optional<std::pair<double, double>> extremes;
    // Set when the curve is no longer wanted: ends its computing.
    Stop dropped = std::make_shared<std::atomic<bool>>(false);
  };

  // Takes the curve out; what is computed for it ends.
  template <typename Which>
  void dropIf(const Which& which);
  Progress progressOf(const Entry& entry);
  Entry* find(const SeriesChoice& choice);
  const Entry* find(const SeriesChoice& choice) const;
  void begin(Entry& entry);
  void beginLong(Entry& entry);
  // The future becomes ready when the reading is done or cancelled.
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
  // Of the recording; perhaps with computed series.
  std::optional<Profile> profile_;
  std::shared_ptr<const FirstLook> firstLook_;
  std::vector<Entry> entries_;
  double fromS_ = 0.0;
  double toS_ = 0.0;
  // Stops all reading for this recording.
  Stop stop_;
  // Passes over whole recordings, one after the other.
  QThreadPool passes_;
  // Short reads.
  QThreadPool reads_;
  QTimer news_;
  std::atomic<int> numJobs_ = 0;
  double toldProgress_ = 1.0;
  // Below 0: nothing is computed.
  std::atomic<double> computing_ = -1.0;
  double toldComputing_ = -1.0;
};

}  // namespace palpate::gui
