// A stack of pages that needs only the room of the page that is shown: a large page that is hidden
// doesn't make the window large.
#pragma once

#include <QStackedWidget>

namespace palpate::gui {

// Name of a stack in a dock whose pages need different widths: the dock is widened for the page
// that is shown.
inline constexpr const char* kDockPages = "dockPages";

class FittingPages : public QStackedWidget {
  Q_OBJECT
 public:
  explicit FittingPages(QWidget* parent = nullptr) : QStackedWidget(parent) {
    connect(this, &QStackedWidget::currentChanged, this, [this] { updateGeometry(); });
  }
  QSize sizeHint() const override {
    return currentWidget() ? currentWidget()->sizeHint() : QStackedWidget::sizeHint();
  }
  QSize minimumSizeHint() const override {
    const QWidget* page = currentWidget();
    return page ? page->minimumSizeHint().expandedTo(page->minimumSize())
                : QStackedWidget::minimumSizeHint();
  }
};

}  // namespace palpate::gui
