// A small table of figures: right-aligned, below each one its interval or what else belongs to it,
// in a quieter colour.
#pragma once

#include <QIcon>
#include <QTableWidget>
#include <vector>

#include <palpate/core/text_table.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct FigureCell {
  QString text;
  QString detail = {};  // second line
  QString tip = {};
  bool warning = false;  // needs a look
  QIcon icon = {};       // before the text
};

struct FigureColumn {
  QString name;  // "K [counts]" in two lines: name, unit
  QString tip = {};
  int letters = 7;     // of its width
  bool words = false;  // left-aligned
};

class FiguresTable : public QTableWidget {
  Q_OBJECT
 public:
  explicit FiguresTable(const std::vector<FigureColumn>& columns, QWidget* parent = nullptr);
  void setRows(const std::vector<std::vector<FigureCell>>& rows);
  void setTheme(Theme theme);
  // No cell has a second line.
  void setSingleLine();
  // -1: none.
  int chosenRow() const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  void rowChosen(int row);

 protected:
  // Keys that move in it move in it, and play nothing back.
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  // The last column takes what is left; where there is too little the others give way.
  void fitColumns();

  std::vector<int> widths_;  // of the columns, where there is room [px]
};

}  // namespace palpate::gui
