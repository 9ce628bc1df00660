#include "gui/widgets/text_fit.h"

#include <QAbstractButton>
#include <QEvent>
#include <QTimer>
#include <QWidget>
#include <algorithm>
#include <utility>

namespace palpate::gui {
namespace {

class TextFit : public QObject {
 public:
  TextFit(QWidget& widget, std::function<void()> fit) : QObject(&widget), fit_(std::move(fit)) {
    widget.installEventFilter(this);
    fit_();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::FontChange) QTimer::singleShot(0, this, [this] { fit_(); });
    return QObject::eventFilter(watched, event);
  }

 private:
  std::function<void()> fit_;
};

}  // namespace

void fitToText(QWidget& widget, std::function<void()> fit) {
  // The widget owns it.
  new TextFit(widget, std::move(fit));  // NOLINT(cppcoreguidelines-owning-memory)
}

void keepWide(QAbstractButton& button, int leastPx) {
  fitToText(button, [&button, leastPx] {
    button.setMinimumWidth(std::max(leastPx, button.sizeHint().width()));
  });
}

}  // namespace palpate::gui
