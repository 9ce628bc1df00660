// A key of a motion that can't begin now does nothing. This tells why, in the words of the tool tip
// of the action. It does so in the window and in all windows that belong to it: docks that float,
// the answer on the whole screen.
#pragma once

#include <QAction>
#include <QList>
#include <QObject>

namespace palpate::gui {

// The property of an action with the words for its refusal: "Can't open the hand".
inline constexpr const char* kRefusalProperty = "refusal";
// One line that tells why the action can't be taken now: "Can't open the hand: ..".
QString refusalOf(const QAction& action);

class MotionKeys : public QObject {
  Q_OBJECT
 public:
  // `window` and the actions must outlive this.
  MotionKeys(QList<QAction*> actions, QWidget* window, QObject* parent = nullptr);

 signals:
  // refusalOf() the action.
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
