// The content of the dock Inspect: the current frame and the recording, in numbers.
#pragma once

#include <QScrollArea>
#include <cstdint>
#include <memory>

#include <palpate/live/live_results.h>
#include <palpate/model/series.h>

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
                 const std::optional<Sample>& angles,
                 const std::optional<Sample>& temperatures);
  // Shows the events of the recording as edited.
  void showEvents(const std::vector<Event>& events);
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
  // Shows results ten times a second at most: nobody reads more numbers, and drawing text takes
  // time. Those in between are shown by showLatest().
  void showLive(const LiveResults& results);
  // To be called when no results follow for now: shows the newest ones.
  void showLatest();
  // The units of areas, joint angles and temperatures.
  void setUnits(const DisplayUnits& units);
  MatrixTableModel& table() noexcept { return *model_; }
  // Whether the figures of the matrices are old, and whether angles and temperatures are: they are
  // grey then.
  void setStale(bool matrices, bool angles);
  QSize sizeHint() const override { return {470, 400}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;
  // Watches the content.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  // Two columns where there is room for both.
  void arrange();
  void listSensors(const HandDescription& hand, bool angles, bool temperatures);
  void showAngles(const Sample& angles);
  void showTemperatures(const Sample& temperatures);
  // A line for each column of a further series.
  void showFurther(std::vector<Fact> values);

  OpenedRecordingPtr recording_;
  // Newest live results that aren't shown yet; null when all are.
  std::unique_ptr<const LiveResults> latest_;
  // Time stamp of the live frame that is shown [us since 1970].
  std::int64_t shownUs_ = 0;
  OpenedRecordingPtr asRecorded_;
  QString calibration_;
  MatrixTableModel* model_;
  MatrixTable* matrices_;
  QLabel* heading_;
  FactsView* facts_;
  QLabel* eventsHeading_;
  QLabel* anglesHeading_;
  QLabel* temperaturesHeading_;
  QLabel* furtherHeading_;
  DisplayUnits units_;
  // The axes of the hand, and the values that are shown.
  std::vector<AxisDescription> axes_;
  std::optional<Sample> shownAngles_;
  std::optional<Sample> shownTemperatures_;
  FactsView* events_;
  FactsView* angles_;
  FactsView* temperatures_;
  FactsView* further_;
  QBoxLayout* columns_;
};

}  // namespace palpate::gui
