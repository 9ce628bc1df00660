#include "gui/help/whats_this.h"

#include <QCoreApplication>
#include <QDockWidget>
#include <QHelpEvent>
#include <QWhatsThis>

namespace palpate::gui {

WhatsThis::WhatsThis(std::function<QString(const QString&)> aboutDock, QObject* parent)
    : QObject(parent), aboutDock_(std::move(aboutDock)) {
  QCoreApplication::instance()->installEventFilter(this);
}

QString WhatsThis::about(const QWidget& widget) const {
  for (const QWidget* each = &widget; each; each = each->parentWidget()) {
    if (!each->whatsThis().isEmpty()) return each->whatsThis();
    if (!each->toolTip().isEmpty()) return each->toolTip();
    if (qobject_cast<const QDockWidget*>(each)) return aboutDock_(each->objectName());
    if (each->isWindow()) break;
  }
  return {};
}

bool WhatsThis::eventFilter(QObject* watched, QEvent* event) {
  const bool asked = event->type() == QEvent::QueryWhatsThis;
  if (!asked && event->type() != QEvent::WhatsThis) return false;
  const auto* widget = qobject_cast<const QWidget*>(watched);
  // Menus tell the text of the entry themselves.
  if (!widget || widget->inherits("QMenu") || widget->inherits("QMenuBar")) return false;
  const QString text = about(*widget);
  if (text.isEmpty()) return false;
  event->accept();
  if (!asked) QWhatsThis::showText(static_cast<QHelpEvent*>(event)->globalPos(), text);
  return true;
}

}  // namespace palpate::gui
