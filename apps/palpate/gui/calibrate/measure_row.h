// A row of the pages Tare and Noise: measures the connected hand for some seconds, with progress
// and cancel, and hands over the frames as a recording in memory.
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <string>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/live/live_measurement.h>

#include "gui/source/background_job.h"
#include "gui/source/opened_recording.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QSettings;
class QSpinBox;

namespace palpate::gui {

// Whether it was measured live by a MeasureRow.
bool isMeasured(const OpenedRecording& recording);
// What a page says in place of a measurement of a hand that wasn't at rest; `why` by notAtRest().
QString refusal(const std::string& why);

class MeasureRow : public QWidget {
  Q_OBJECT
 public:
  struct Setup {
    // Prefix of the object names of its widgets, and its settings key below "calibrate/".
    QString part;
    int usualSeconds = 5;
    // It refuses while the controller hides small readings.
    bool needsThreshold0 = false;
    QString tip;
  };
  MeasureRow(QSettings& settings, Setup setup, QWidget* parent = nullptr);

  // Sets the session of the connected hand; null: none, which ends a running measurement. Call it
  // with null before the session is destroyed.
  void setSession(CaptureSession* session);
  // The window shows the connected hand. While it shows something else, only a running measurement
  // is visible.
  void setLive(bool live);
  bool running() const { return measurement_ != nullptr; }
  // Cancels the measurement; returns whether one was running.
  bool cancel();
  // Takes what has arrived; called by the timer, public for tests.
  void takeItems();
  // Waits until a complete measurement has been handed over; for tests and pictures.
  void settle();

 signals:
  void measured(const palpate::gui::OpenedRecordingPtr& measured);
  void said(const QString& text);

 private:
  void begin();
  // Why it can't begin now; empty: it can.
  QString obstacle() const;
  void complete();
  void endWith(const QString& text);
  void showState();

  QSettings& settings_;
  const Setup setup_;
  CaptureSession* session_ = nullptr;
  bool live_ = false;
  std::shared_ptr<CaptureQueue> queue_;
  std::unique_ptr<LiveMeasurement> measurement_;
  std::vector<CaptureItem> items_;
  // Since the last frame, or since the begin.
  QElapsedTimer silence_;
  QTimer timer_;
  QString result_;
  BackgroundJob job_;
  QPushButton* measure_;
  QSpinBox* seconds_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QLabel* text_;
};

}  // namespace palpate::gui
