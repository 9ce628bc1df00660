// The content of the dock Spectrum: the mean signal of the chosen taxels (of the strongest taxel
// when none is chosen) and its spectrogram. It computes only while it is visible.
#pragma once

#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <optional>
#include <vector>

#include "gui/picture/exported_view.h"
#include "gui/spectrum/spectrum_chart.h"
#include "gui/spectrum/spectrum_header.h"
#include "gui/spectrum/spectrum_worker.h"

class QStackedWidget;

namespace palpate::gui {

class EmptyPage;
class SpectrumLinePage;
class OpeningStrip;

class SpectrumPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SpectrumPanel(QSettings& settings, QWidget* parent = nullptr);
  // For the title row of the dock.
  SpectrumHeader& header() noexcept { return *header_; }
  SpectrumChart& chart() noexcept { return *chart_; }
  SpectrumLinePage& linePage() noexcept { return *linePage_; }

  // `recording`: null when there is none. `live`: a live source is shown instead.
  void setSource(const OpenedRecordingPtr& recording, bool live);
  // Sets the chosen taxels; empty when none is chosen.
  void setTaxels(const TaxelSelection& taxels);
  // The curves by formulas, which can be chosen as signals, as can columns of further series.
  void setFormulas(const std::vector<FormulaCurve>& formulas);
  void setVisibleRange(double fromS, double toS);
  // The selected range, which the mean and the coherence are of; nothing: the visible part.
  void setSpan(const std::optional<TimeSpan>& span);
  void setPosition(double seconds);
  void setMap(ColorMapName map) { chart_->setMap(map); }
  // Paints the shown chart for export, and says how large it is.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);
  QSizeF chartSize() const;
  // Cancels the computation; returns whether one was running.
  bool cancel();

  // Whether a spectrum exists and is visible.
  bool shown() const;
  // The name of the signal: "finger 2 distal · x 2, y 9".
  QString name() const { return name_; }
  // Why there is no spectrum; empty when there is one.
  QString emptyText() const;
  bool busy() const { return worker_.busy() || later_.isActive(); }
  // Waits until the requested spectrum is computed; for tests and pictures.
  void settle();
  // Tables of the shown spectrum: every segment, and the mean over segments.
  std::vector<ExportedTable> tables() const;

 signals:
  void said(const QString& text);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void ask();
  void listSignals();
  void take(const SpectrumAnswer& answer);
  // Shows a mean spectrum or a coherence.
  void takeLine(const SpectrumAnswer& answer);
  TimeSpan lineSpan() const;
  void say(const QString& text, const QString& button = {});
  QString nameOf(const SpectrumAnswer& answer) const;

  QSettings& settings_;
  OpenedRecordingPtr recording_;
  bool live_ = false;
  TaxelSelection taxels_;
  std::vector<FormulaCurve> formulas_;
  std::vector<FormulaCurve> signals_;  // those, then the columns by their names
  double fromS_ = 0.0;
  double toS_ = 0.0;
  std::optional<TimeSpan> span_;
  QString name_;
  // The last question, answered or not.
  std::optional<SpectrumQuestion> asked_;
  SpectrumWorker worker_;
  QTimer later_;
  SpectrumHeader* header_;
  OpeningStrip* strip_;
  QStackedWidget* pages_;
  EmptyPage* empty_;
  SpectrumChart* chart_;
  SpectrumLinePage* linePage_;
};

}  // namespace palpate::gui
