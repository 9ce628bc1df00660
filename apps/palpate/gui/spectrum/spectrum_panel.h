// The Spectrum dock: the signal of the chosen taxels (their mean; of the strongest taxel while none
// is chosen) and its spectra over time. It computes only while it is seen.
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
class OpeningStrip;

class SpectrumPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SpectrumPanel(QSettings& settings, QWidget* parent = nullptr);
  // For the dock's title row.
  SpectrumHeader& header() noexcept { return *header_; }
  SpectrumChart& chart() noexcept { return *chart_; }

  // Null: none. `live`: what is connected is shown instead.
  void setSource(const OpenedRecordingPtr& recording, bool live);
  void setTaxels(const TaxelSelection& taxels);  // empty: none is chosen
  void setVisibleRange(double fromS, double toS);
  void setPosition(double seconds);
  void setTheme(Theme theme);
  void setMap(ColorMapName map) { chart_->setMap(map); }
  // Gives up what is being computed; whether there was anything.
  bool cancel();

  // There is a spectrum, and it is seen.
  bool shown() const;
  QString name() const { return name_; }  // "finger 2 distal · x 2, y 9"
  QString emptyText() const;              // why there is none; empty: there is one
  bool busy() const { return worker_.busy() || later_.isActive(); }
  // For tests and pictures: until what was asked for is there.
  void settle();
  // What is shown, as tables: every segment, the mean of them.
  std::vector<ExportedTable> tables() const;

 signals:
  void said(const QString& text);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void ask();
  void take(const SpectrumAnswer& answer);
  void say(const QString& text, const QString& button = {});
  QString nameOf(const SpectrumAnswer& answer) const;

  QSettings& settings_;
  OpenedRecordingPtr recording_;
  bool live_ = false;
  TaxelSelection taxels_;
  double fromS_ = 0.0;
  double toS_ = 0.0;
  QString name_;
  std::optional<SpectrumQuestion> asked_;  // that is being answered, or was
  SpectrumWorker worker_;
  QTimer later_;
  SpectrumHeader* header_;
  OpeningStrip* strip_;
  QStackedWidget* pages_;
  EmptyPage* empty_;
  SpectrumChart* chart_;
};

}  // namespace palpate::gui
