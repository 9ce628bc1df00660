#include "gui/widgets/keep_keys.h"

#include <QKeyEvent>
#include <QWidget>
#include <utility>

namespace palpate::gui {
namespace {

class KeptKeys : public QObject {
 public:
  KeptKeys(QWidget& widget, QList<QKeySequence> keys, std::function<void()> pressed)
      : QObject(&widget), keys_(std::move(keys)), pressed_(std::move(pressed)) {
    widget.installEventFilter(this);
  }

 protected:
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    const bool isPress = event->type() == QEvent::KeyPress && pressed_;
    if (event->type() != QEvent::ShortcutOverride && !isPress) return false;
    const auto& key = *static_cast<QKeyEvent*>(event);
    const Qt::KeyboardModifiers modifiers = key.modifiers() & ~Qt::KeypadModifier;
    if (!keys_.contains(QKeySequence(QKeyCombination(modifiers, Qt::Key(key.key()))))) return false;
    event->accept();
    if (isPress) pressed_();
    return true;
  }

 private:
  QList<QKeySequence> keys_;
  std::function<void()> pressed_;
};

}  // namespace

const QList<QKeySequence> kRowKeys = {
    Qt::Key_Up, Qt::Key_Down, Qt::Key_Home, Qt::Key_End, Qt::Key_PageUp, Qt::Key_PageDown};

void keepKeys(QWidget& widget, const QList<QKeySequence>& keys, std::function<void()> pressed) {
  // The widget owns it.
  new KeptKeys(widget, keys, std::move(pressed));  // NOLINT(cppcoreguidelines-owning-memory)
}

void keepKeys(QWidget& widget, QKeySequence::StandardKey keys, std::function<void()> pressed) {
  keepKeys(widget, QKeySequence::keyBindings(keys), std::move(pressed));
}

}  // namespace palpate::gui
