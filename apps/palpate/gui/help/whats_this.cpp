#include "gui/help/whats_this.h"

#include <QCoreApplication>
#include <QDockWidget>
#include <QHelpEvent>
#include <QRegularExpression>
#include <QTextDocument>
#include <QTimer>
#include <QWhatsThis>
#include <QWhatsThisClickedEvent>

namespace palpate::gui {

WhatsThis::WhatsThis(std::function<QString(const QString&)> aboutDock,
                     std::function<void(const QString&)> openPage,
                     QObject* parent)
    : QObject(parent), aboutDock_(std::move(aboutDock)), openPage_(std::move(openPage)) {
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

QString WhatsThis::withLinks(const QString& text) {
  static const QRegularExpression page(R"((\w+\.md)(#[\w-]+)?)");
  if (Qt::mightBeRichText(text) || !text.contains(page)) return text;
  QString rich = text.toHtmlEscaped().replace('\n', "<br>");
  return "<p>" + rich.replace(page, R"(<a href="\1\2">\1</a>)") + "</p>";
}

bool WhatsThis::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::WhatsThisClicked && watched->isWidgetType()) {
    openPage_(static_cast<QWhatsThisClickedEvent*>(event)->href());
    // Its window is still handling the click.
    QTimer::singleShot(0, this, [] { QWhatsThis::hideText(); });
    return true;
  }
  const bool asked = event->type() == QEvent::QueryWhatsThis;
  if (!asked && event->type() != QEvent::WhatsThis) return false;
  const auto* widget = qobject_cast<const QWidget*>(watched);
  // Menus tell the text of the entry themselves.
  if (!widget || widget->inherits("QMenu") || widget->inherits("QMenuBar")) return false;
  const QString text = about(*widget);
  if (text.isEmpty()) return false;
  event->accept();
  if (!asked)
    QWhatsThis::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                         withLinks(text),
                         const_cast<QWidget*>(widget));
  return true;
}

}  // namespace palpate::gui
