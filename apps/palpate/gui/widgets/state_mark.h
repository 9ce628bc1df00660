// A small mark before a line of text: good, bad, warning, in progress. The states differ in shape,
// not only in colour.
#pragma once

#include <QWidget>

namespace palpate::gui {

class StateMark : public QWidget {
  Q_OBJECT
 public:
  enum class State { kNone, kAtWork, kGood, kWarning, kBad };

  explicit StateMark(QWidget* parent);
  void setState(State state);
  State state() const noexcept { return state_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  State state_ = State::kNone;
};

}  // namespace palpate::gui
