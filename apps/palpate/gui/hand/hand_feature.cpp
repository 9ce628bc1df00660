#include "gui/hand/hand_feature.h"

#include "gui/hand/hand_dock.h"
#include "gui/hand/sensitivity_modes.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {

HandFeature::HandFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      actions_(bench.actions),
      panel_(new HandDock(bench.settings, window)) {
  dock_ = new Dock("Hand", panel_, nullptr, window);
  panel_->bind(actions_);
  LiveController& live = bench.live;
  connect(&live, &LiveController::came, this, [this, &live] {
    panel_->setHand(live.source()->session.get(), live.source()->control.get());
  });
  connect(&live, &LiveController::leaving, this, [this] { panel_->setHand(nullptr, nullptr); });
  connect(panel_, &HandDock::blindChanged, &bench.overlays, &Overlays::setBlind);
  connect(panel_, &HandDock::stopPressed, &bench.handRequests, &HandRequests::asked);
  connect(panel_, &HandDock::asked, &bench.handRequests, &HandRequests::asked);
  followTheme(panel_);
  SensitivityModes& modes = panel_->sensitivity();
  modes.noiseLines = [&bench](const std::string& hand) {
    const auto& lines = bench.handRequests.noiseLines;
    return lines ? lines(hand) : std::optional<NoiseFloor>();
  };
  connect(&modes,
          &SensitivityModes::highChanged,
          &bench.handRequests,
          &HandRequests::highSensitivityChanged);
}

HandFeature::~HandFeature() { panel_->setHand(nullptr, nullptr); }

std::vector<DockOffer> HandFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+H"),
           .liveArea = Qt::LeftDockWidgetArea,
           .tab = 3,
           .shownLive = true}};
}

}  // namespace palpate::gui
