#include "gui/widgets/content_scroll.h"

#include <QEvent>
#include <QScrollBar>

namespace palpate::gui {

ContentScroll::ContentScroll(QWidget* content, QSize least, QWidget* parent)
    : QScrollArea(parent), least_(least) {
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  setWidgetResizable(true);
  if (least.width() == 0) setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  if (least.height() == 0) setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setWidget(content);
  content->installEventFilter(this);
}

QSize ContentScroll::sizeHint() const { return widget()->sizeHint().expandedTo(minimumSizeHint()); }

QSize ContentScroll::minimumSizeHint() const {
  const QSize content = widget()->minimumSizeHint().expandedTo(widget()->minimumSize());
  QSize size = content.boundedTo(least_);
  // Beside content that doesn't scroll in one direction there is room for the bar of the other.
  if (least_.width() == 0)
    size.setWidth(content.width() + (content.height() > least_.height()
                                         ? verticalScrollBar()->sizeHint().width()
                                         : 0));
  if (least_.height() == 0) size.setHeight(content.height());
  return size;
}

bool ContentScroll::eventFilter(QObject* watched, QEvent* event) {
  // The content may need another size now.
  if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
  return QScrollArea::eventFilter(watched, event);
}

}  // namespace palpate::gui
