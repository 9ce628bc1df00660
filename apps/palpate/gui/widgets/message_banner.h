// A banner with messages inside the window, shown until the user closes it. It blocks nothing.
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
  // `name`: object name; `part`: prefix of the object names of its widgets.
  explicit MessageBanner(QWidget* parent = nullptr,
                         const QString& name = "MessageBanner",
                         const QString& part = "banner");
  // Failures of several files are shown together.
  void showMessage(const QString& message) { showAbout({}, message); }
  // Shows a message that withdraw() can remove by its topic.
  void showAbout(const QString& topic, const QString& message);
  // Removes the messages of a topic, whose cause is gone.
  void withdraw(const QString& topic);
  // Replaces all messages by these, without emitting said(); an empty list hides the banner.
  void showAll(const QStringList& messages);
  void dismiss();
  QString message() const;

 signals:
  // Emitted for every message that is added.
  void said(const QString& message);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Line {
    QString topic;
    QString text;
  };
  void showLines();
  // All lines are seen: other parts of the window are squeezed instead.
  void askForHeight();

  QList<Line> lines_;
  QLabel* text_;
};

}  // namespace palpate::gui
