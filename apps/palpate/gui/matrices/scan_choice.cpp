#include "gui/matrices/scan_choice.h"

#include <QMenu>
#include <chrono>

#include "gui/matrices/matrices_feature.h"

namespace palpate::gui {
namespace {

constexpr const char* kChanging = "changing which taxels are scanned: no frames until this is done";

}  // namespace

ScanChoice::ScanChoice(WindowState& windowState, const MatricesActions& actions)
    : windowState_(windowState) {
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions.scanOnly, [this] { scan(MaskChoice::kOnly); });
  on(actions.scanOnlyInTheirMatrices, [this] { scan(MaskChoice::kOnlyInTheirMatrices); });
  on(actions.scanWithout, [this] { scan(MaskChoice::kWithout); });
  on(actions.scanAlso, [this] { scan(MaskChoice::kAlso); });
  on(actions.scanAll, [this] { scan(MaskChoice::kAll); });
  on(actions.chooseNone, [this] { windowState_.selection.clearTaxels(); });
  connect(windowState.menus.scanned, &QMenu::aboutToShow, this, [this, &actions] {
    const LiveSource* source = windowState_.displayed.source();
    const bool live = source && source->control;
    const bool chosen = !windowState_.selection.taxels().empty();
    for (QAction* action :
         {actions.scanOnly, actions.scanOnlyInTheirMatrices, actions.scanWithout, actions.scanAlso})
      action->setEnabled(live && chosen);
    actions.scanAll->setEnabled(live);
    actions.chooseNone->setEnabled(chosen);
  });
  // The actions are enabled again when the menu closes, so that their keys don't depend on it.
  connect(windowState.menus.scanned, &QMenu::aboutToHide, this, [&actions] {
    actions.chooseNone->setEnabled(true);
  });
  connect(&windowState.live, &LiveController::refreshed, this, &ScanChoice::takeAnswers);
  connect(&windowState.live, &LiveController::leaving, this, [this] {
    answers_.clear();
    windowState_.messages.takeBack(kChanging);
  });
}

void ScanChoice::scan(MaskChoice choice) {
  LiveSource* source = windowState_.live.source();
  if (!source || !source->control) return;
  try {
    const auto commands = maskCommands(
        *source->session->device().hand().layout, windowState_.selection.taxels(), choice);
    for (const DeviceCommand& command : commands)
      answers_.push_back(source->control->change(command));
    windowState_.messages.flash(commands.empty() ? "these taxels are scanned already" : kChanging);
  } catch (const std::exception& error) {
    windowState_.messages.fail(error.what());
  }
}

void ScanChoice::takeAnswers() {
  if (answers_.empty()) return;
  const auto isReady = [](const auto& answer) {
    return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  for (const auto& answer : answers_) {
    if (!isReady(answer)) continue;
    try {
      answer.get();
    } catch (const std::exception& error) {
      windowState_.messages.fail("The choice of scanned taxels was not changed: " +
                                 QString(error.what()));
    }
  }
  std::erase_if(answers_, isReady);
  if (answers_.empty()) windowState_.messages.takeBack(kChanging);
}

}  // namespace palpate::gui
