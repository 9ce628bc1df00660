// One message inside the window: it blocks nothing, and what is open stays open.
#pragma once

#include <QList>
#include <QWidget>

#include "gui/appearance/theme.h"

class QLabel;
class QToolButton;

namespace palpate::gui {

class MessageBanner : public QWidget {
  Q_OBJECT
 public:
  // `part`: the beginning of its parts' names.
  explicit MessageBanner(QWidget* parent = nullptr,
                         const QString& name = "MessageBanner",
                         const QString& part = "banner");
  // Failures of several files are shown together.
  void showMessage(const QString& message) { showAbout({}, message); }
  // One that is withdrawn with its topic.
  void showAbout(const QString& topic, const QString& message);
  // What was said about a topic isn't so any more.
  void withdraw(const QString& topic);
  // Exactly these, instead of what was shown; none: hides. Of these nothing is said().
  void showAll(const QStringList& messages);
  void dismiss();
  QString message() const;
  void setTheme(Theme theme);

 signals:
  void said(const QString& message);  // a message, each time it comes

 private:
  struct Line {
    QString topic;
    QString text;
  };
  void showLines();

  QList<Line> lines_;
  QLabel* text_;
  QToolButton* close_;
};

}  // namespace palpate::gui
