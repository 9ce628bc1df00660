#include "gui/widgets/dock.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolButton>
#include <algorithm>

#include "gui/appearance/icons.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {

Dock::Dock(const QString& name, QWidget* content, QWidget* header, QWidget* parent)
    : QDockWidget(name, parent) {
  setObjectName(name);
  setWidget(content);
  auto* row = new QWidget(this);
  row->setObjectName("DockTitle");
  row->setAttribute(Qt::WA_StyledBackground);
  row->setToolTip("Drag to move this dock, double-click to make it a separate window");
  auto* close = new QToolButton(row);
  close->setProperty("flat", true);
  close->setIcon(makeIcon(IconShape::kClose));
  close->setIconSize({10, 10});
  close->setToolTip("Close (open it again with the menu View)");
  close->setAccessibleName("Close " + name);
  close->setFocusPolicy(Qt::NoFocus);
  // As high as a button with text: the headers of docks and of the views end at one height.
  fitToText(*close, [close] { close->setMinimumHeight(close->fontMetrics().height() + 10); });
  connect(close, &QToolButton::clicked, this, &QDockWidget::close);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(12, 4, 10, 4);
  layout->setSpacing(10);
  layout->addWidget(new QLabel("<b>" + name + "</b>", row));
  if (header)
    layout->addWidget(header, 1);
  else
    layout->addStretch(1);
  layout->addWidget(close);
  setTitleBarWidget(row);
}

int Dock::contentWidth() const {
  int width = minimumSizeHint().width();
  if (const auto* area = qobject_cast<const ContentScroll*>(widget()))
    width = std::max(
        width,
        area->widget()->minimumSizeHint().width() + area->verticalScrollBar()->sizeHint().width());
  else if (const auto* plain = qobject_cast<const QScrollArea*>(widget()))
    width = std::max(width,
                     plain->widget()->minimumSizeHint().width() +
                         plain->verticalScrollBar()->sizeHint().width());
  return std::max(width, titleBarWidget()->sizeHint().width());
}

}  // namespace palpate::gui
