// The taxels that are chosen in the main window: what they say, and which ones the hand scans.
#include <QMenu>
#include <algorithm>
#include <chrono>

#include "gui/look/captions.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/shell/main_window.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
void MainWindow::connectScanActions() {
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions_.scanOnly, [this] { scan(MaskChoice::kOnly); });
  on(actions_.scanWithout, [this] { scan(MaskChoice::kWithout); });
  on(actions_.scanAlso, [this] { scan(MaskChoice::kAlso); });
  on(actions_.scanAll, [this] { scan(MaskChoice::kAll); });
  on(actions_.chooseNone, [this] { matrices_->view().clearSelection(); });
  connect(&matrices_->view(), &MatricesView::selectionChanged, this, &MainWindow::updateStatus);
  connect(menus_->scanned, &QMenu::aboutToShow, this, [this] {
    const bool live = liveShown_ && live_.source() && live_.source()->control;
    const bool chosen = !matrices_->view().selection().empty();
    for (QAction* action : {actions_.scanOnly, actions_.scanWithout, actions_.scanAlso})
      action->setEnabled(live && chosen);
    actions_.scanAll->setEnabled(live);
    actions_.chooseNone->setEnabled(chosen);
  });
  // Enabled again when the menu is gone: their keys must not depend on it.
  connect(menus_->scanned, &QMenu::aboutToHide, this, [this] {
    actions_.chooseNone->setEnabled(true);
  });
  connect(&matrices_->view(), &MatricesView::menuAsked, this, [this](const QPoint& at) {
    menus_->scanned->popup(at);
  });
}

void MainWindow::scan(MaskChoice choice) {
  LiveSource* source = live_.source();
  if (!source || !source->control) return;
  try {
    const auto commands = maskCommands(
        *source->session->device().hand().layout, matrices_->view().selection(), choice);
    for (const DeviceCommand& command : commands)
      scanAnswers_.push_back(source->control->change(command));
    flash(commands.empty() ? "these taxels are scanned already"
                           : "which taxels are scanned is being changed: the stream pauses");
  } catch (const std::exception& error) {
    banner_->showMessage(error.what());
  }
}

// What the hand made of it.
void MainWindow::heedScanAnswers() {
  const auto isReady = [](const auto& answer) {
    return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  for (const auto& answer : scanAnswers_) {
    if (!isReady(answer)) continue;
    try {
      answer.get();
    } catch (const std::exception& error) {
      banner_->showMessage("Which taxels are scanned was not changed: " + QString(error.what()));
    }
  }
  std::erase_if(scanAnswers_, isReady);
}

QString MainWindow::selectionText() const {
  const TaxelSelection& selection = matrices_->view().selection();
  const std::size_t count = selection.count();
  if (count == 0) return {};
  QString text = QString::number(count) + (count == 1 ? " taxel chosen" : " taxels chosen");
  const TactileFrame& frame = matrices_->frame();
  if (frame.values.empty() || !matrices_->hand()) return text;
  double sum = 0.0, largest = 0.0;
  for (std::size_t m = 0; m < selection.numMatrices(); ++m) {
    const auto values = frame.allValues(m);
    for (int y = 0; y < values.rows(); ++y)
      for (int x = 0; x < values.cols(); ++x)
        if (selection.contains(m, y, x)) {
          sum += static_cast<double>(values(y, x));
          largest = std::max(largest, static_cast<double>(values(y, x)));
        }
  }
  return text + ": mean " + figure(sum / static_cast<double>(count), 0) + ", max " +
         figure(largest, 0) + " counts";
}

}  // namespace palpate::gui
