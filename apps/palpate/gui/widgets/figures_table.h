// A small table of right-aligned numbers; below each one, in a muted colour, its confidence
// interval or another detail.
#pragma once

#include <QIcon>
#include <QTableWidget>
#include <vector>

#include <palpate/core/text_table.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct FigureCell {
  QString text;
  // Second line of the cell.
  QString detail = {};
  QString tip = {};
  // The value needs attention.
  bool warning = false;
  // Drawn before the text.
  QIcon icon = {};
};

struct FigureColumn {
  // "K [counts]" is shown in two lines: name and unit.
  QString name;
  QString tip = {};
  // Width of the column [letters].
  int letters = 7;
  // Left-aligned text instead of numbers.
  bool words = false;
};

class FiguresTable : public QTableWidget {
  Q_OBJECT
 public:
  explicit FiguresTable(const std::vector<FigureColumn>& columns, QWidget* parent = nullptr);
  void setRows(const std::vector<std::vector<FigureCell>>& rows);
  // To be called when no cell has a second line; rows are lower then.
  void setSingleLine();
  // Index of the chosen row; -1: none.
  int chosenRow() const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  void rowChosen(int row);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  // The last column takes the remaining width; where there is too little, the others shrink.
  void fitColumns();
  // The widths at which headings and figures aren't shortened [px].
  std::vector<int> neededWidths() const;

  // Sizes of rows and columns for the present size of text.
  void fitTextSize();

  int linesOfRow_ = 2;
  // Widths of the columns when there is room, in digits.
  std::vector<int> letters_;
  // The same [px].
  std::vector<int> widths_;
  std::vector<int> needed_;
};

}  // namespace palpate::gui
