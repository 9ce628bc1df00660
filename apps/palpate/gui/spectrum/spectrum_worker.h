// Spectra of a recording, computed beside the window, and given up as soon as something else is
// asked for.
#pragma once

#include <QObject>
#include <QString>
#include <QThreadPool>
#include <atomic>
#include <memory>

#include <palpate/signals/profile_series.h>
#include <palpate/signals/spectrogram.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

struct SpectrumQuestion {
  OpenedRecordingPtr recording = nullptr;  // never null
  TaxelSelection taxels = {};              // empty: the strongest one
  SpectrogramOptions options = {};
  // What is seen [s from the first frame]. Where the whole recording fits the options, all of it is
  // computed.
  double fromS = 0.0;
  double toS = 0.0;
};

struct SpectrumAnswer {
  TaxelSelection taxels = {};  // whose mean it is; empty: none feels anything
  bool strongest = false;      // nobody chose it
  bool whole = true;           // of the whole recording, not only of what was seen
  SpectrumOptions options = {};
  std::shared_ptr<const Series> series = nullptr;            // null: there is none
  std::shared_ptr<const Spectrogram> spectrogram = nullptr;  // likewise; without a part: too short
  QString failure = {};                                      // one line; a block that can't be read
};

// Whether every segment of the whole recording is computed; else only those of what is seen.
bool fitsWhole(const SpectrumQuestion& question);

class SpectrumWorker : public QObject {
  Q_OBJECT
 public:
  explicit SpectrumWorker(QObject* parent = nullptr);
  // Gives up and waits.
  ~SpectrumWorker() override;

  // Replaces what was asked before.
  void ask(const SpectrumQuestion& question);
  void cancel();
  bool busy() const noexcept { return busy_; }
  void waitForDone() { pool_.waitForDone(); }

 signals:
  void started();
  void progressed(double fraction);
  void answered(const palpate::gui::SpectrumAnswer& answer);
  void ended();  // answered, or given up

 private:
  struct Kept;
  void work(const SpectrumQuestion& question, int generation);
  SpectrumAnswer answerTo(const SpectrumQuestion& question, const Progress& progress);

  QThreadPool pool_;  // one thread: what is kept belongs to it
  std::shared_ptr<Kept> kept_;
  std::atomic<int> generation_ = 0;  // of the newest question
  bool busy_ = false;
};

}  // namespace palpate::gui
