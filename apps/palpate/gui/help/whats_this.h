// Shift+F1: What's this. A control tells its tool tip; where it has none, what surrounds it tells
// its own, and a dock the first paragraph of its section in the manual. Names of pages in it are
// links to the manual.
#pragma once

#include <QObject>
#include <QString>
#include <QWidget>
#include <functional>

namespace palpate::gui {

class WhatsThis : public QObject {
 public:
  // `aboutDock` gives the text for the name of a dock; empty: nothing is known. `openPage` opens
  // the manual where a link says: "docks.md#slip".
  WhatsThis(std::function<QString(const QString& dock)> aboutDock,
            std::function<void(const QString& link)> openPage,
            QObject* parent);

  // What is told about a widget; empty: nothing.
  QString about(const QWidget& widget) const;
  // The same text, plain or rich, with each name of a page ("slip.md", "docks.md#slip") as a link.
  static QString withLinks(const QString& text);

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::function<QString(const QString&)> aboutDock_;
  std::function<void(const QString&)> openPage_;
};

}  // namespace palpate::gui
