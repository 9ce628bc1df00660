// The hand in 3-D with its controls: how taxels are drawn, which sphere, which single matrix,
// what else is visible.
#pragma once

#include <QWidget>
#include <vector>

#include "gui/hand3d/hand_view.h"
#include "gui/matrices/matrices_view.h"
#include "gui/source/opened_recording.h"

class QAction;
class QComboBox;

namespace palpate::gui {

class HandPanel : public QWidget {
  Q_OBJECT
 public:
  // `shown`: checkable actions for what is visible, offered by a button of the header.
  explicit HandPanel(const QList<QAction*>& shown, QWidget* parent = nullptr);

  // Shows a recording; null: none.
  void setRecording(const OpenedRecordingPtr& recording);
  // Shows a live hand instead of a recording.
  void setHand(const HandDescription& hand);
  // Shows one frame with its joint angles [deg]; empty: the angles aren't known.
  void show(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  void showLive(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  // Takes the colours of the heat maps.
  void setColors(const MatricesLook& look);
  // Sets the look except its colours.
  void setLook(const HandLook& look);
  const HandLook& look() const noexcept { return view_->look(); }
  HandView& view() noexcept { return *view_; }

 signals:
  // The user chose a look with the controls of the header.
  void lookChosen(const palpate::gui::HandLook& look);

 private:
  void listMatrices(const HandDescription& hand);

  HandView* view_;
  QComboBox* taxels_;
  QComboBox* spheres_;
  QComboBox* matrix_;
};

}  // namespace palpate::gui
