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
  // The other signal is the mean of a matrix or of the hand, a formula, taxels that are kept as
  // they are chosen now, or a name or formula that is typed. Null: no recording.
  void setRecording(const OpenedRecordingPtr& recording);
  void setFormulas(const std::vector<FormulaCurve>& formulas);
  void setTaxels(const TaxelSelection& taxels) { taxels_ = taxels; }
  // The other signal of the coherence.
  const SeriesChoice& other() const noexcept { return chosen_; }
  QString otherName() const { return chosenName_; }
  // What is wrong with the typed signal; empty: nothing.
  QString problem() const;
  // Shows an answer with a mean spectrum or a coherence.
  void setAnswer(const SpectrumAnswer& answer);
  // Whether the field for the other signal is shown.
  void setChoosing(bool choosing);
  // The tables of what is shown: the line, and its peaks.
  std::vector<ExportedTable> tables() const;

 signals:
  void otherChanged();

 private:
  void fillOthers();
  // Takes what the field for the other signal shows.
  void choose();
  void take(const SeriesChoice& choice, const QString& name);

  OpenedRecordingPtr recording_;
  std::vector<FormulaCurve> formulas_;
  TaxelSelection taxels_;
  SeriesChoice chosen_;
  QString chosenName_;
  SpectrumLineChart* chart_;
  QLabel* otherLabel_;
  QComboBox* other_;
  QLabel* problem_;
  QStackedWidget* pages_;
  FiguresTable* peaks_;
  FiguresTable* common_;
  QLabel* none_;
};

}  // namespace palpate::gui
