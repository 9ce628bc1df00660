// The heat maps with the controls of their look, colour map and range.
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
  // The actions become buttons in the header.
  MatricesPanel(QAction* interpolated, QAction* values, QWidget* parent = nullptr);

  // Shows a recording; null: none.
  void setRecording(const OpenedRecordingPtr& recording);
  // Shows a frame of the recording or of the live hand.
  void show(const TactileFrame& frame);
  // To be called when a long recording has been read completely and its maximum is known.
  void renewRange();
  // To be called when the connection ends: the largest value of the next hand isn't known yet.
  void forgetLargest();
  // Shows a live hand instead of a recording.
  void setHand(const HandDescription& hand);
  // The hand of the displayed frames; null: none.
  const HandDescription* hand() const noexcept { return hand_ ? &*hand_ : nullptr; }
  // Takes colour map, look and range.
  void setSettings(const ViewSettings& settings);
  MatricesView& view() noexcept { return *view_; }
  const TactileFrame& frame() const noexcept { return frame_; }
  // Options for an exported picture that looks like the view.
  MatricesPictureOptions pictureOptions() const;

 signals:
  // Colour map, range or theme has changed; the other views follow.
  void lookChanged(const palpate::gui::MatricesLook& look);
  void mapChosen(palpate::gui::ColorMapName map);
  void rangeChosen(palpate::gui::RangeMode mode);
  void taxelsChosen(palpate::gui::TaxelView view);
  void arrowsChosen(double factor);
  void manualRangeChosen(double minimum, double maximum);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  ValueRange rangeNow() const;
  // Of the magnitudes of the frame; 0 where others are shown.
  double largestShown() const;
  void applyLook();
  // Unit and decimals of the range fields; which choices the hand's readings have.
  void showUnit();

  MatricesView* view_;
  QList<QToolButton*> looks_;
  QComboBox* map_;
  QComboBox* range_;
  QComboBox* taxels_;
  QDoubleSpinBox* arrows_;
  QDoubleSpinBox* minimum_;
  QLabel* to_;
  QDoubleSpinBox* maximum_;
  OpenedRecordingPtr recording_;
  std::optional<HandDescription> hand_;
  // Upper end of the colour range of a live hand, in its unit.
  double largestLive_ = 0.0;
  // Largest magnitude of the frames of a recording that were shown so far.
  double largestMagnitude_ = 0.0;
  TactileFrame frame_;
  ViewSettings settings_;
};

}  // namespace palpate::gui
