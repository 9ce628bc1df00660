// Paints the items of a list in two lines: the name and, below it in a muted colour, a description.
#pragma once

#include <QStyledItemDelegate>

#include "gui/appearance/theme.h"

namespace palpate::gui {

class TwoLineDelegate : public QStyledItemDelegate {
  Q_OBJECT
 public:
  // The role of an item that holds its second line; the first one is Qt::DisplayRole.
  static constexpr int kDetailRole = Qt::UserRole + 1;

  TwoLineDelegate(Theme theme, QObject* parent) : QStyledItemDelegate(parent), theme_(theme) {}
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  void paint(QPainter* painter,
             const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;

 private:
  Theme theme_;
};

}  // namespace palpate::gui
