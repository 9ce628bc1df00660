// Shift+F1: What's this. A control tells its tool tip; where it has none, what surrounds it tells
// its own, and a dock the first paragraph of its section in the manual.
#pragma once

#include <QObject>
#include <QString>
#include <QWidget>
#include <functional>

namespace palpate::gui {

class WhatsThis : public QObject {
 public:
  // `aboutDock` gives the text for the name of a dock; empty: nothing is known.
  WhatsThis(std::function<QString(const QString& dock)> aboutDock, QObject* parent);

  // What is told about a widget; empty: nothing.
  QString about(const QWidget& widget) const;

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::function<QString(const QString&)> aboutDock_;
};

}  // namespace palpate::gui
