// The rows that arrive from a sensor before it is added, read by a separate source.
#pragma once

#include <QString>
#include <deque>
#include <mutex>

#include <palpate/device/device.h>
#include <palpate/device/series_source.h>

namespace palpate::gui {

class SensorRows : private DeviceSink {
 public:
  // Opens the source. Throws std::invalid_argument (options).
  explicit SensorRows(SeriesSourceOptions options);
  // Ends within 2 s: not to be destroyed in the thread of the window.
  ~SensorRows() override;
  SensorRows(const SensorRows&) = delete;
  SensorRows& operator=(const SensorRows&) = delete;

  // The state, the columns and the newest rows, one line each.
  QString text() const;

 private:
  void onFrame(TactileFrame&&) override {}
  void onSample(Sample&& sample) override;
  void onEvent(Event&&) override {}

  mutable std::mutex mutex_;
  std::deque<Sample> newest_;
  SeriesSource source_;
};

}  // namespace palpate::gui
