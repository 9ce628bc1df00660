// The content of the dock Inspect: the current frame and the recording, in numbers.
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
  // `recording`: as it is shown, filtered or not; `asRecorded`: the content of the file.
  void setRecording(const OpenedRecordingPtr& recording, const OpenedRecordingPtr& asRecorded);
  // Shows a frame of the recording; angles and temperatures that aren't known keep their values.
  void showFrame(std::size_t frame,
                 const std::optional<JointAngles>& angles,
                 const std::optional<Temperatures>& temperatures);
  // Shows the events of the recording as edited.
  void showEvents(const std::vector<RecordingEvent>& events);
  // The calibration as text: "none: values are counts", or its name.
  void setCalibration(const QString& text);
  // To be called when a long recording has been read completely.
  void renewFacts();
  // Shows a live hand instead of a recording.
  void setHand(const HandDescription& hand);
  // To be called when the same hand scans other taxels.
  void renewHand(const HandDescription& hand) { model_->renewHand(hand); }
  // Facts about the connection.
  void setLiveFacts(std::vector<Fact> facts);
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
  OpenedRecordingPtr asRecorded_;
  QString calibration_;
  MatrixTableModel* model_;
  MatrixTable* matrices_;
  QLabel* heading_;
  FactsView* facts_;
  QLabel* eventsHeading_;
  QLabel* anglesHeading_;
  QLabel* temperaturesHeading_;
  std::vector<QString> angleUnits_;
  FactsView* events_;
  FactsView* angles_;
  FactsView* temperatures_;
  QBoxLayout* columns_;
};

}  // namespace palpate::gui
