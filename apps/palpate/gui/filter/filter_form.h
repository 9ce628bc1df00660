// The form of the dock Filter for the options of one filter: a field for each option with unit and
// range, and a description of the filter.
#pragma once

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include <palpate/filter/filter_step.h>

class QGridLayout;
class QLabel;
class QToolButton;

namespace palpate::gui {

class FilterForm : public QWidget {
  Q_OBJECT
 public:
  explicit FilterForm(QWidget* parent);
  // Shows the options of a step; null when none is chosen. The fields are rebuilt when the kind of
  // filter differs.
  void showStep(const FilterStep* step);
  void setMatrixNames(const QStringList& shortNames);
  // The rate of the frames [Hz]; 0: not known. Frequencies must be below half of it.
  void setRate(double rateHz);

 signals:
  // `value`: NaN means automatic.
  void optionChosen(const std::string& key, double value);
  void matricesChosen(const std::vector<std::size_t>& matrices);

 private:
  void build(const FilterKind& kind);
  void addField(QGridLayout& grid, int row, const FilterOption& option);
  void addMatrices(QGridLayout& grid, int row);
  void showMatrices(const std::vector<std::size_t>& matrices);

  // The range of a frequency, which depends on the rate.
  struct Frequency {
    FilterOption option;
    QLabel* range;
    QWidget* field;
  };
  void showRange(const Frequency& frequency) const;

  double rateHz_ = 0.0;
  std::vector<Frequency> frequencies_;
  QStringList matrixNames_;
  // The kind of filter that the fields belong to; empty when there is none.
  std::string kind_;
  QWidget* fields_ = nullptr;
  // Functions that show a step in the fields, one for each field.
  std::vector<std::function<void(const FilterStep&)>> show_;
  std::vector<QToolButton*> matrices_;
  QLabel* about_;
};

}  // namespace palpate::gui
