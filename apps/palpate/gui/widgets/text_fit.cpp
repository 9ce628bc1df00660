#include "gui/widgets/text_fit.h"

#include <QAbstractButton>
#include <QEvent>
#include <QTimer>
#include <QWidget>
#include <algorithm>
#include <utility>

#include "gui/appearance/theme_change.h"

namespace palpate::gui {
namespace {

class Fit : public QObject {
 public:
  Fit(QWidget& widget, QEvent::Type after, std::function<void()> fit)
      : QObject(&widget), after_(after), fit_(std::move(fit)) {
    widget.installEventFilter(this);
    fit_();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == after_ && after_ == themeChange()) fit_();
    if (event->type() == after_ && after_ == QEvent::FontChange)
      QTimer::singleShot(0, this, [this] { fit_(); });
    return QObject::eventFilter(watched, event);
  }

 private:
  QEvent::Type after_;
  std::function<void()> fit_;
};

}  // namespace

void fitToText(QWidget& widget, std::function<void()> fit) {
  // The widget owns it.
  new Fit(widget, QEvent::FontChange, std::move(fit));  // NOLINT(cppcoreguidelines-owning-memory)
}

void fitToTheme(QWidget& widget, std::function<void()> fit) {
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory)
  new Fit(widget, themeChange(), std::move(fit));
}

void keepWide(QAbstractButton& button, int leastPx) {
  fitToText(button, [&button, leastPx] {
    button.setMinimumWidth(std::max(leastPx, button.sizeHint().width()));
  });
}

}  // namespace palpate::gui
