// A table as a picture of its own: names on the left, figures on the right of their columns,
// hairlines between rows.
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
  // as many cells as the header has; the first is the row's name
  std::vector<QStringList> rows = {};
};

// In the colours of `theme`, or of paper. Text shrinks where the table wouldn't fit.
void paintTable(QPainter& painter,
                const PictureLook& look,
                const TablePicture& table,
                const QFont& font,
                Theme theme);

}  // namespace palpate::gui
