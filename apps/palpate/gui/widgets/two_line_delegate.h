// Paints the items of a list in two lines: the name and, below it in a muted colour, a description.
#pragma once

#include <QStyledItemDelegate>

namespace palpate::gui {

class TwoLineDelegate : public QStyledItemDelegate {
  Q_OBJECT
 public:
  // The role of an item that holds its second line; the first one is Qt::DisplayRole.
  static constexpr int kDetailRole = Qt::UserRole + 1;

  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  void paint(QPainter* painter,
             const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
};

}  // namespace palpate::gui
