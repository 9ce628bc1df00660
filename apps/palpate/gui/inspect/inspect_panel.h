// What is in the current frame and in the recording, in numbers.
#pragma once

#include <QScrollArea>

#include <palpate/live/live_results.h>
#include <palpate/model/hand_state.h>

#include "gui/inspect/matrix_table.h"
#include "gui/source/opened_recording.h"
#include "gui/widgets/facts_view.h"

class QBoxLayout;
class QLabel;

namespace palpate::gui {

class InspectPanel : public QScrollArea {
  Q_OBJECT
 public:
  explicit InspectPanel(QWidget* parent = nullptr);
  void setRecording(const OpenedRecordingPtr& recording);
  // Of that recording; angles and temperatures that aren't known stay as they are.
  void showFrame(std::size_t frame,
                 const std::optional<JointAngles>& angles,
                 const std::optional<Temperatures>& temperatures);
  // Events of the recording, as they were edited, too.
  void showEvents(const std::vector<RecordingEvent>& events);
  // What values are told in beside counts: "none: values are counts", or the calibration's name.
  void setCalibration(const QString& text);
  // More is known of a long recording now.
  void renewFacts();
  // A live hand instead of a recording.
  void setHand(const HandDescription& hand);
  // Of the same hand other taxels are scanned.
  void renewHand(const HandDescription& hand) { model_->renewHand(hand); }
  void setLiveFacts(std::vector<Fact> facts);  // of the link
  void showLive(const LiveResults& results);
  void setTheme(Theme theme);
  MatrixTableModel& table() noexcept { return *model_; }
  QSize sizeHint() const override { return {470, 400}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void listSensors(const HandDescription& hand, bool angles, bool temperatures);
  void showAngles(const JointAngles& angles);
  void showTemperatures(const Temperatures& temperatures);

  OpenedRecordingPtr recording_;
  QString calibration_;
  MatrixTableModel* model_;
  MatrixTable* matrices_;
  QLabel* heading_;
  FactsView* facts_;
  QLabel* eventsHeading_;
  FactsView* events_;
  FactsView* angles_;
  FactsView* temperatures_;
  QBoxLayout* columns_;
};

}  // namespace palpate::gui
