// What is in the current frame and in the recording, in numbers.
#pragma once

#include <QScrollArea>

#include "gui/facts_view.h"
#include "gui/matrix_table.h"
#include "gui/opened_recording.h"

class QBoxLayout;
class QLabel;

namespace palpate::gui {

class InspectPanel : public QScrollArea {
  Q_OBJECT
 public:
  explicit InspectPanel(QWidget* parent = nullptr);
  void setRecording(const OpenedRecordingPtr& recording);
  void showFrame(std::size_t frame);
  void setTheme(Theme theme);
  MatrixTableModel& table() noexcept { return *model_; }
  QSize sizeHint() const override { return {470, 400}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void showAngles(std::size_t frame);
  void showTemperatures(std::size_t frame);

  OpenedRecordingPtr recording_;
  MatrixTableModel* model_;
  MatrixTable* matrices_;
  FactsView* facts_;
  FactsView* angles_;
  FactsView* temperatures_;
  QBoxLayout* columns_;
};

}  // namespace palpate::gui
