// The window of the plan of recordings: the table, what comes next, how far the plan is, the
// quality of the takes, and buttons that record the next one and repeat a bad one. It is not modal:
// the window, and Stop, stay usable.
#pragma once

#include <QDialog>
#include <array>
#include <functional>

#include "gui/record/plan_controller.h"
#include "gui/record/plan_model.h"
#include "gui/window_state/window_state.h"

class QCheckBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTableView;

namespace palpate::gui {

class OfferStrip;
class PlanLimits;

class PlanDialog : public QDialog {
  Q_OBJECT
 public:
  // Both must outlive the dialog. `record`: the action that starts and stops a recording.
  PlanDialog(WindowState& windowState,
             PlanController& controller,
             QAction* record,
             QWidget* parent = nullptr);
  ~PlanDialog() override;

  // The line for the question about a take.
  OfferStrip& question() noexcept { return *question_; }
  // Takes what is being typed into a cell, as if the user had pressed Enter.
  void takeTyped();
  // What Escape ends before it closes this window: true if there was something; may be empty.
  std::function<bool()> escape;

 public slots:
  // Shows what is present; called with every change.
  void showState();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QWidget* makeRows();
  std::array<int, PlanModel::kNumColumns> wantedWidths() const;
  int aroundColumns() const;
  void fitSize();
  void fitColumns();
  QWidget* makeFoot();
  void addRow();
  void removeRow();
  void importTable();
  void exportTable();
  void beginAnew();
  void recordNext();
  void repeatLast();
  void say(const QString& text);

  WindowState& windowState_;
  PlanController& controller_;
  QAction* record_;
  PlanModel* model_;
  QTableView* table_;
  QLabel* progress_;
  QLabel* next_;
  QProgressBar* bar_;
  QLabel* said_;
  OfferStrip* question_;
  PlanLimits* limits_;
  QCheckBox* follow_;
  QPushButton* add_;
  QPushButton* import_;
  QPushButton* remove_;
  QPushButton* export_;
  QPushButton* anew_;
  QPushButton* repeat_;
  QPushButton* recordNext_;
};

}  // namespace palpate::gui
