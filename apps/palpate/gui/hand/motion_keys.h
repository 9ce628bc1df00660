// A key of a motion that can't begin now does nothing. This tells why, in the words of the tool tip
// of the action. It does so in the window and in all windows that belong to it: docks that float,
// the answer on the whole screen.
#pragma once

#include <QAction>
#include <QList>
#include <QObject>

namespace palpate::gui {

class MotionKeys : public QObject {
  Q_OBJECT
 public:
  // `window` and the actions must outlive this.
  MotionKeys(QList<QAction*> actions, QWidget* window, QObject* parent = nullptr);

 signals:
  // One line: "Reactive grasp: A slip-aware grasp holds; Stop (Esc) ends it".
  void refused(const QString& why);
  // Before refused().
  void refusedAction(const QAction* action);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QList<QAction*> actions_;
  QWidget* window_;
  // Time stamp of the last press [ms]: a press passes through several widgets.
  quint64 lastPress_ = 0;
};

}  // namespace palpate::gui
