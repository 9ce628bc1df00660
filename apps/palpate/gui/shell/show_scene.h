// What is shown beside the answer on the whole screen: the hand in 3-D and its heat maps, as in the
// window.
#pragma once

#include <QWidget>

namespace palpate::gui {

class HandView;
class MatricesPanel;
class MatricesView;
struct WindowState;

class ShowScene : public QWidget {
  Q_OBJECT
 public:
  // The colours are those of `panel`. All arguments must outlive this.
  ShowScene(WindowState& windowState, MatricesPanel& panel, QWidget* parent);
  HandView& hand() noexcept { return *hand_; }
  MatricesView& matrices() noexcept { return *matrices_; }

 private:
  void takeHand();
  void takeFrame();
  void takeLook();

  WindowState& windowState_;
  MatricesPanel& panel_;
  HandView* hand_;
  MatricesView* matrices_;
};

}  // namespace palpate::gui
