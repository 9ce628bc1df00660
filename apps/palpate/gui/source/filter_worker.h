// Filters a recording by a recipe in a background thread; delivers the filtered recording, and cost
// and latency of each step. A new start() replaces the work in progress, so that only the last
// recipe gives a result.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/filter/recipe.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

struct FilterFigures {
  // Time per step and frame [us]; 0: the step is off.
  std::vector<double> costsUs;
  // Latency of each step [frames]; nothing: a step of load never appears in its output.
  std::vector<std::optional<int>> latencies;
  // Latency of the whole chain [frames]; nothing as above.
  std::optional<int> latency;
};

// Returns the recording with filtered values; time stamps, joint angles, events and the saturated
// frames are those of the source. Throws std::invalid_argument (the recipe names a matrix that the
// hand doesn't have), Error, Cancelled.
OpenedRecordingPtr filteredRecording(const OpenedRecordingPtr& source,
                                     const Recipe& recipe,
                                     const Progress& progress = {});
// Measures the costs on up to 200 frames around the frame of largest sum (of a long recording,
// around the middle frame).
FilterFigures figuresOf(const OpenedRecording& source, const Recipe& recipe);

class FilterWorker : public QObject {
  Q_OBJECT
 public:
  explicit FilterWorker(QObject* parent = nullptr);
  // Cancels and waits.
  ~FilterWorker() override;

  void start(const OpenedRecordingPtr& source, const Recipe& recipe);
  void cancel();
  bool busy() const noexcept { return busy_; }
  // Waits until all work has ended; for tests and pictures.
  void wait();

 signals:
  void progressed(double fraction);
  void made(const palpate::gui::OpenedRecordingPtr& source,
            const palpate::gui::OpenedRecordingPtr& filtered);
  void measured(const palpate::gui::FilterFigures& figures);
  void failed(const QString& message);

 private:
  void postResult(std::uint64_t generation, std::function<void()> what);

  QThreadPool pool_;
  std::shared_ptr<std::atomic<bool>> stop_;
  std::uint64_t generation_ = 0;
  bool busy_ = false;
};

}  // namespace palpate::gui
