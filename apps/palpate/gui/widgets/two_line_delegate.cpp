#include "gui/widgets/two_line_delegate.h"

#include <QPainter>

#include "gui/appearance/theme.h"

namespace palpate::gui {
namespace {

constexpr int kTwoLineDelegatePadding = 5;  // [px] above and below the text
constexpr int kIndent = 10;                 // [px]
constexpr int kLeading = 1;                 // [px] between the lines

}  // namespace

QSize TwoLineDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const {
  // The hint has no width: long names are elided in the middle and don't widen the list.
  return {0, 2 * option.fontMetrics.height() + kLeading + 2 * kTwoLineDelegatePadding};
}

void TwoLineDelegate::paint(QPainter* painter,
                            const QStyleOptionViewItem& option,
                            const QModelIndex& index) const {
  const ThemeColors& colors = colorsOf();
  const bool selected = option.state.testFlag(QStyle::State_Selected);
  const bool focused = selected && option.state.testFlag(QStyle::State_HasFocus);
  painter->save();
  painter->fillRect(option.rect, selected ? colors.accentSoft : colors.window);
  if (selected) {
    constexpr int kBar = 3;
    painter->fillRect(QRect(option.rect.topLeft(), QSize(kBar, option.rect.height())),
                      focused ? colors.accent : colors.border);
  }
  const QRect text =
      option.rect.adjusted(kIndent, kTwoLineDelegatePadding, -kIndent, -kTwoLineDelegatePadding);
  const QFontMetrics& metrics = option.fontMetrics;
  painter->setFont(option.font);
  painter->setPen(colors.text);
  painter->drawText(text,
                    Qt::AlignLeft | Qt::AlignTop | Qt::TextSingleLine,
                    metrics.elidedText(index.data().toString(), Qt::ElideMiddle, text.width()));
  painter->setPen(colors.muted);
  painter->drawText(
      text,
      Qt::AlignLeft | Qt::AlignBottom | Qt::TextSingleLine,
      metrics.elidedText(index.data(kDetailRole).toString(), Qt::ElideRight, text.width()));
  painter->restore();
}

}  // namespace palpate::gui
