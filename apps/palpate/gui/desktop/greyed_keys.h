// The key of a greyed action does nothing. This tells why, and so does the tool tip of its entry in
// a menu. It does so in the window and in all windows that belong to it: docks that float, the
// answer on the whole screen.
#pragma once

#include <QAction>
#include <QList>
#include <QObject>
#include <functional>

class QHelpEvent;
class QKeyEvent;
class QMenu;
class QWidget;

namespace palpate::gui {

// The property of an action with the words for its refusal: "Can't open the hand"; without it the
// action's own text is used.
inline constexpr const char* kRefusalProperty = "refusal";

class GreyedKeys : public QObject {
  Q_OBJECT
 public:
  // `why` says why an action is greyed; empty: its key and its entry are left alone. `window` and
  // the actions must outlive this.
  GreyedKeys(QList<QAction*> actions,
             std::function<QString(const QAction&)> why,
             QWidget* window,
             QObject* parent = nullptr);

 signals:
  // One line that tells why the action can't be taken now: "Can't open the hand: ..".
  void refused(const QString& why, const QAction* action);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool refuse(const QKeyEvent& key);
  bool tell(QMenu& menu, const QHelpEvent& event) const;

  QList<QAction*> actions_;
  std::function<QString(const QAction&)> why_;
  QWidget* window_;
  // Time stamp of the last press [ms]: a press passes through several widgets.
  quint64 lastPress_ = 0;
};

}  // namespace palpate::gui
