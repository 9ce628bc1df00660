// The page of the dock Spectrum for one line: its chart, the table of its peaks, and for coherence
// the field that chooses the other signal.
#pragma once

#include <QWidget>
#include <vector>

#include "gui/picture/exported_view.h"
#include "gui/spectrum/spectrum_line_chart.h"

class QComboBox;
class QLabel;
class QStackedWidget;

namespace palpate::gui {

class FiguresTable;

class SpectrumLinePage : public QWidget {
  Q_OBJECT
 public:
  explicit SpectrumLinePage(QWidget* parent = nullptr);

  SpectrumLineChart& chart() noexcept { return *chart_; }
  const SpectrumLineChart& chart() const noexcept { return *chart_; }
  // The signals that can be chosen as the other one: the mean of each matrix, then of the hand.
  void setHand(const HandDescription& hand);
  // The other signal of the coherence.
  SeriesChoice other() const;
  QString otherName() const;
  // Shows an answer with a mean spectrum or a coherence.
  void setAnswer(const SpectrumAnswer& answer);
  // Whether the field for the other signal is shown.
  void setChoosing(bool choosing);
  void setTheme(Theme theme);
  // The tables of what is shown: the line, and its peaks.
  std::vector<ExportedTable> tables() const;

 signals:
  void otherChanged();

 private:
  SpectrumLineChart* chart_;
  QLabel* otherLabel_;
  QComboBox* other_;
  QStackedWidget* pages_;
  FiguresTable* peaks_;
  FiguresTable* common_;
  QLabel* none_;
};

}  // namespace palpate::gui
