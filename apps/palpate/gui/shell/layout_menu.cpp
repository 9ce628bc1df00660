#include "gui/shell/layout_menu.h"

#include "gui/shell/dock_arrangement.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {
namespace {

// Presets for a connected hand, which is shown then.
bool needsHand(Preset preset) { return preset == Preset::kGrasp || preset == Preset::kRecord; }

QString wordsOf(Preset preset) {
  constexpr std::array kBeside{"the data and their chart",
                               "with the controls of the hand",
                               "with the state of the link",
                               "with the figures"};
  return "&" + nameOf(preset) + ": " + kBeside[static_cast<std::size_t>(preset)];
}

}  // namespace

LayoutMenu::LayoutMenu(WindowState& windowState, DockArrangement& docks, QMenu& menu)
    : windowState_(windowState), docks_(docks), menu_(menu), presets_(nullptr) {
  ActionRegistry& book = windowState.actions;
  ActionEnabler& enabler = windowState.actionEnabler;
  for (const Preset preset : kAllPresets) {
    const QString name = nameOf(preset);
    QAction* action = book.make("preset" + name,
                                "View",
                                wordsOf(preset),
                                {key(qPrintable("Ctrl+" + QString::number(1 + int(preset))))},
                                true);
    presets_.addAction(action);
    action->setData(name);
    if (needsHand(preset))
      enabler.add(
          {action},
          [&windowState] { return windowState.live.source() != nullptr; },
          "No hand is connected: connect one first (Ctrl+K)");
    else
      enabler.add(
          {action},
          [&windowState] {
            return windowState.displayed.kind() != DisplayedSource::Kind::kNothing;
          },
          "Nothing is shown: open a recording or connect a hand first");
  }
  keep_ = book.make("keepLayout", "View", "Sa&ve this layout as…");
  remove_ = book.make("removeLayout", "View", "Re&move this layout");
  reset_ = book.make("resetLayout", "View", "Rese&t this layout");
  // The comparison hides all docks: that isn't the layout which is stored, or goes on.
  const auto leaveComparison = [&windowState] { windowState.comparison.set(false); };
  for (QAction* action : presets_.actions() + QList<QAction*>{keep_, remove_, reset_})
    connect(action, &QAction::triggered, this, leaveComparison);
  for (std::size_t i = 0; i < kAllPresets.size(); ++i)
    connect(presets_.actions()[static_cast<qsizetype>(i)], &QAction::triggered, this, [this, i] {
      use(kAllPresets[i]);
    });
  connect(keep_, &QAction::triggered, this, &LayoutMenu::keep);
  connect(remove_, &QAction::triggered, &docks, &DockArrangement::removeOwn);
  connect(reset_, &QAction::triggered, &docks, &DockArrangement::reset);
  connect(&docks, &DockArrangement::presetsChanged, this, &LayoutMenu::renew);
}

void LayoutMenu::begin() {
  show_ = windowState_.actions.at("showMode");
  renew();
}

void LayoutMenu::use(Preset preset) {
  if (needsHand(preset) && !windowState_.displayed.isLive())
    windowState_.actions.at("live")->trigger();
  docks_.use(nameOf(preset));
}

void LayoutMenu::renew() {
  if (!show_) return;
  menu_.clear();
  for (QAction* action : presets_.actions().mid(std::size(kAllPresets))) {
    presets_.removeAction(action);
    action->deleteLater();  // it may have called this
  }
  const QStringList own = docks_.ownPresets();
  for (const QString& name : own) {
    auto* action = new QAction(QString(name).replace('&', "&&"), &presets_);
    action->setCheckable(true);
    action->setData(name);
    connect(action, &QAction::triggered, this, [this, name] {
      windowState_.comparison.set(false);
      docks_.use(name);
    });
  }
  for (QAction* action : presets_.actions())
    if (action->data() == docks_.preset()) action->setChecked(true);
  menu_.addActions(presets_.actions().mid(0, std::size(kAllPresets)));
  menu_.addAction(show_);
  if (!own.isEmpty()) menu_.addSeparator();
  menu_.addActions(presets_.actions().mid(std::size(kAllPresets)));
  menu_.addSeparator();
  menu_.addActions({keep_, remove_, reset_});
  remove_->setVisible(own.contains(docks_.preset()));
  menu_.menuAction()->setToolTip("Layout: " + docks_.preset() + " (Ctrl+1 .. Ctrl+5)");
  menu_.menuAction()->setVisible(!docks_.preset().isEmpty());
}

void LayoutMenu::keep() {
  const auto name = windowState_.ask.text("Own layout", "Name", {});
  if (!name || name->isEmpty()) return;
  if (const QString problem = docks_.keepAs(*name); !problem.isEmpty())
    windowState_.messages.fail(problem);
}

}  // namespace palpate::gui
