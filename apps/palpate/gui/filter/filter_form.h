// The options of one filter: a field each, with unit and range, and what the filter is.
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
  // Null: nothing is chosen. Fields are made anew where it is another kind of filter.
  void showStep(const FilterStep* step);
  void setMatrixNames(const QStringList& shortNames);

 signals:
  void optionChosen(const std::string& key, double value);  // NaN: automatic
  void matricesChosen(const std::vector<std::size_t>& matrices);

 private:
  void build(const FilterKind& kind);
  void addField(QGridLayout& grid, int row, const FilterOption& option);
  void addMatrices(QGridLayout& grid, int row);
  void showMatrices(const std::vector<std::size_t>& matrices);

  QStringList matrixNames_;
  std::string kind_;  // that the fields are of; empty: none
  QWidget* fields_ = nullptr;
  std::vector<std::function<void(const FilterStep&)>> show_;  // one per field
  std::vector<QToolButton*> matrices_;
  QLabel* about_;
};

}  // namespace palpate::gui
