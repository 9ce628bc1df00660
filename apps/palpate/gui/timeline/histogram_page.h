// The page with the histogram of a curve over the selection.
#pragma once

#include <QWidget>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/signals/histogram.h>

#include "gui/appearance/theme.h"

class QComboBox;
class QCPBars;
class QCustomPlot;
class QLabel;
class QSpinBox;

namespace palpate::gui {

struct SelectedCurves;

class HistogramPage : public QWidget {
  Q_OBJECT
 public:
  HistogramPage(const SelectedCurves& selected, QWidget* parent = nullptr);
  const Histogram& histogram() const noexcept { return histogram_; }
  // A row per bin: its limits and the number of values.
  TextTable table() const;

 private:
  void show();

  std::vector<std::vector<double>> values_;
  std::vector<QString> units_;
  Histogram histogram_;
  QComboBox* curve_;
  QSpinBox* bins_;
  QLabel* words_;
  QCustomPlot* plot_;
  QCPBars* bars_;
};

}  // namespace palpate::gui
