// Paints a table as a picture for export: names on the left, numbers right-aligned in their
// columns, hairlines between the rows.
#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"

class QFont;
class QPainter;

namespace palpate::gui {

struct TablePicture {
  QString title = {};
  QString caption = {};
  QStringList header = {};
  // Every row has as many cells as the header; the first is the name of the row.
  std::vector<QStringList> rows = {};
};

// Uses the colours of `theme`, or those for paper. The text shrinks where the table wouldn't fit.
void paintTable(QPainter& painter,
                const PictureLook& look,
                const TablePicture& table,
                const QFont& font,
                Theme theme);

}  // namespace palpate::gui
