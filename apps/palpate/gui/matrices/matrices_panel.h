// The heat maps with their controls: look, colour map, range.
#pragma once

#include <QList>
#include <QWidget>
#include <optional>

#include "gui/appearance/window_settings.h"
#include "gui/matrices/matrices_view.h"
#include "gui/source/opened_recording.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QToolButton;

namespace palpate::gui {

class MatricesPanel : public QWidget {
  Q_OBJECT
 public:
  // The actions stand as buttons in the header.
  MatricesPanel(QAction* interpolated, QAction* values, QWidget* parent = nullptr);

  void setRecording(const OpenedRecordingPtr& recording);  // null: none
  // Of that recording, or of the live hand.
  void show(const TactileFrame& frame);
  // More is known of a long recording now.
  void renewRange();
  // The connection ends: the largest value of the next hand is not known yet.
  void forgetLargest();
  // A live hand instead of a recording.
  void setHand(const HandDescription& hand);
  // Whose frames are shown; null: nobody's.
  const HandDescription* hand() const noexcept { return hand_ ? &*hand_ : nullptr; }
  // Map, look and range; theme as resolved.
  void setSettings(const ViewSettings& settings, Theme theme);
  MatricesView& view() noexcept { return *view_; }
  const TactileFrame& frame() const noexcept { return frame_; }
  // What is seen, for a picture of its own.
  MatricesPictureOptions pictureOptions() const;

 signals:
  // Map, range or theme; the views beside follow.
  void lookChanged(const palpate::gui::MatricesLook& look);
  void mapChosen(palpate::gui::ColorMapName map);
  void rangeChosen(palpate::gui::RangeMode mode);
  void manualRangeChosen(double minimum, double maximum);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  ValueRange rangeNow() const;
  void applyLook();

  MatricesView* view_;
  QList<QToolButton*> looks_;
  QComboBox* map_;
  QComboBox* range_;
  QDoubleSpinBox* minimum_;
  QLabel* to_;
  QDoubleSpinBox* maximum_;
  OpenedRecordingPtr recording_;
  std::optional<HandDescription> hand_;
  double largestLive_ = 0.0;  // end of the colour range of a live hand [counts]
  TactileFrame frame_;
  ViewSettings settings_;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
