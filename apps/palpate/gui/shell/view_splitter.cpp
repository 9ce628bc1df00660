#include "gui/shell/view_splitter.h"

#include <QEvent>
#include <QResizeEvent>
#include <algorithm>

namespace palpate::gui {
namespace {

// Below this width [px], views side by side would show less than below one another.
constexpr int kComfortable = 460;

QSize leastOf(const QWidget& view) { return view.minimumSizeHint().expandedTo(view.minimumSize()); }

}  // namespace

ViewSplitter::ViewSplitter(QWidget* parent) : QSplitter(Qt::Horizontal, parent) {
  setChildrenCollapsible(false);
}

QSize ViewSplitter::sum() const {
  QSize all(0, 0);
  bool first = true;
  for (int i = 0; i < count(); ++i) {
    if (widget(i)->isHidden()) continue;
    all += leastOf(*widget(i));
    if (!first) all += QSize(handleWidth(), handleWidth());
    first = false;
  }
  return all;
}

QSize ViewSplitter::largest() const {
  QSize all(0, 0);
  for (int i = 0; i < count(); ++i)
    if (!widget(i)->isHidden()) all = all.expandedTo(leastOf(*widget(i)));
  return all;
}

int ViewSplitter::widthSideBySide() const { return std::max(sum().width(), kComfortable); }

bool ViewSplitter::mayStack() const {
  // Views that are below one another stay so: a line above them may take some of their height, and
  // the window must not become wider for that.
  return orientation() == Qt::Vertical || height() >= sum().height();
}

QSize ViewSplitter::minimumSizeHint() const {
  // A splitter that isn't high enough for views below one another needs the width of all.
  return {mayStack() ? largest().width() : sum().width(), largest().height()};
}

void ViewSplitter::arrange() {
  const bool stacked = width() < widthSideBySide() && mayStack();
  const Qt::Orientation wanted = stacked ? Qt::Vertical : Qt::Horizontal;
  if (orientation() == wanted) return;
  const QList<int> parts = sizes();
  setOrientation(wanted);
  setSizes(parts);
}

void ViewSplitter::resizeEvent(QResizeEvent* event) {
  arrange();
  QSplitter::resizeEvent(event);
  // The smallest size depends on the height.
  if (event->size().height() != event->oldSize().height()) updateGeometry();
}

bool ViewSplitter::event(QEvent* event) {
  const bool done = QSplitter::event(event);
  if (event->type() == QEvent::LayoutRequest) arrange();
  return done;
}

}  // namespace palpate::gui
