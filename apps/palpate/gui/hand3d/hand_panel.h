// The hand in space with its controls: how taxels are drawn, which sphere, which matrix alone, what
// else is seen.
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
  // `shown`: what can be ticked to be seen, offered by a button of the header.
  explicit HandPanel(const QList<QAction*>& shown, QWidget* parent = nullptr);

  void setRecording(const OpenedRecordingPtr& recording);  // null: none
  // A live hand instead of a recording.
  void setHand(const HandDescription& hand);
  // At one moment; no angles: they aren't known.
  void show(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  // Colours as in the heat maps.
  void setColors(const MatricesLook& look);
  void setLook(const HandLook& look);  // its colours are left as they are
  const HandLook& look() const noexcept { return view_->look(); }
  HandView& view() noexcept { return *view_; }

 signals:
  // By the header's boxes.
  void lookChosen(const palpate::gui::HandLook& look);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void listMatrices(const HandDescription& hand);

  HandView* view_;
  QComboBox* taxels_;
  QComboBox* spheres_;
  QComboBox* matrix_;
};

}  // namespace palpate::gui
