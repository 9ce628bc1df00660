// What keys and the mouse wheel do in all windows beside what Qt does: one filter of the whole
// application. An event goes through these steps in this order, until one takes it:
//   1. the filters that are installed here, in the order of KeyPolicy::Order;
//   2. Esc in a list or menu that is open: see escapeInPopup();
//   3. a field takes only the keys with Ctrl that everybody knows from fields (undo, redo, select
//      all, copy, cut, paste) and lets those of the window pass (Ctrl+E, Ctrl+U, Ctrl+K, ..); a
//      double click selects the whole number, also right of its digits;
//   4. Return and Enter press the button that has the focus; Space, which marks a moment or plays,
//      never presses one that moves the hand;
//   5. the wheel changes a number, a slider or a choice only if that has the focus, and otherwise
//      scrolls: scrolling over the settings of a hand doesn't change them.
#pragma once

#include <QList>
#include <QObject>
#include <QPointer>
#include <utility>

namespace palpate::gui {

// Name of the property that marks buttons that move the hand.
inline constexpr const char* kMovesHand = "movesHand";
// Name of the property of sliders that always take the wheel: the position slider of the playback.
inline constexpr const char* kTakesWheel = "takesWheel";

class KeyPolicy : public QObject {
 public:
  enum class Order {
    kStop,   // of the hand: nothing comes before it
    kGreyed  // tells why a key does nothing
  };
  // That of the application, which is made when it is asked for first.
  static KeyPolicy& ofApplication();
  // `filter` sees the events of the whole application by its eventFilter(), for as long as it
  // exists.
  void install(Order order, QObject& filter);
  // Whether a list or menu was open when Esc was pressed, of the press that is being handled. Qt
  // may close it before the shortcut of that key is triggered, which must then do nothing else.
  bool escapeInPopup() const noexcept { return escapeInPopup_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  explicit KeyPolicy(QObject* parent);
  void followEscape(const QEvent& event);

  QList<std::pair<Order, QPointer<QObject>>> filters_;
  bool escapeInPopup_ = false;
};

}  // namespace palpate::gui
