// The page with the XY plot of two curves over the selection: a point per frame, the line of least
// squares, and the correlation.
#pragma once

#include <QWidget>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/signals/linear_relation.h>

#include "gui/appearance/theme.h"

class QComboBox;
class QCPCurve;
class QCPGraph;
class QCustomPlot;
class QLabel;

namespace palpate::gui {

struct SelectedCurves;

class RelationPage : public QWidget {
  Q_OBJECT
 public:
  RelationPage(const SelectedCurves& selected, QWidget* parent = nullptr);
  const LinearRelation& relation() const noexcept { return relation_; }
  // A row per frame: time, x, y.
  TextTable table() const;

 private:
  void show();

  std::vector<double> timeS_;
  std::vector<std::vector<double>> values_;
  std::vector<QString> names_;
  LinearRelation relation_;
  QComboBox* x_;
  QComboBox* y_;
  QLabel* words_;
  QCustomPlot* plot_;
  QCPCurve* points_;
  QCPGraph* line_;
};

}  // namespace palpate::gui
