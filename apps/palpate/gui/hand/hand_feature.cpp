#include "gui/hand/hand_feature.h"

#include "gui/desktop/greyed_keys.h"
#include "gui/hand/dialog_stop.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand/joint_panel.h"
#include "gui/hand/sensitivity_modes.h"
#include "gui/hand/tactile_settings_panel.h"
#include "gui/hand/touch_store.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr const char* kTouchesTopic = "touches of objects";
// Fingers that are closed this far touch the objects of data/scenes.
constexpr double kEmulatedCloseRatio = 0.85;

}  // namespace

HandActions::HandActions(ActionRegistry& book) {
  // No access keys: a letter that is typed into a menu moves nothing.
  graspHand = book.make("graspHand", "Hand", "Grasp", {key("Ctrl+Alt+G")});
  reactiveGrasp = book.make("reactiveGrasp", "Hand", "Reactive grasp", {key("Ctrl+Alt+R")});
  slipAwareGrasp = book.make("slipAwareGrasp", "Hand", "Slip-aware grasp", {key("Ctrl+Alt+S")});
  openHand = book.make("openHand", "Hand", "Open the hand", {key("Ctrl+Alt+O")});
  relaxHand = book.make("relaxHand", "Hand", "Relax", {key("Ctrl+Alt+X")});
  graspHand->setProperty(kRefusalProperty, "Can't grasp");
  reactiveGrasp->setProperty(kRefusalProperty, "Can't begin a reactive grasp");
  slipAwareGrasp->setProperty(kRefusalProperty, "Can't begin a slip-aware grasp");
  openHand->setProperty(kRefusalProperty, "Can't open the hand");
  relaxHand->setProperty(kRefusalProperty, "Can't relax the hand");
  stopHand = book.make("stopHand", "Hand", "&Stop the hand (Esc)");
  acknowledgeHand = book.make("acknowledgeHand", "Hand", "Acknowledge");
  acknowledgeHand->setToolTip("Acknowledge that the hand is not protected");
  acknowledgeHand->setEnabled(false);
}

HandFeature::HandFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      panel_(new HandDock(windowState.settings, windowState.ask, actions_, window)) {
  dock_ = new Dock("Hand", panel_, nullptr, window);
  auto* dialogs = new DialogStop(*actions_.stopHand, this);
  connect(panel_, &HandDock::reachedChanged, dialogs, &DialogStop::setReached);
  connect(panel_,
          &HandDock::conditionShown,
          dialogs,
          [dialogs](const std::optional<ExplainedCondition>& now) {
            dialogs->setMoving(now && (now->condition == HandCondition::kMoving ||
                                       now->condition == HandCondition::kEasing));
          });
  windowState.handCommands.stop = actions_.stopHand;
  windowState.handCommands.motions = {actions_.graspHand,
                                      actions_.reactiveGrasp,
                                      actions_.slipAwareGrasp,
                                      actions_.openHand,
                                      actions_.relaxHand};
  connect(&windowState.handCommands, &HandCommands::keyRefused, panel_, &HandDock::answerKey);
  connect(panel_, &HandDock::stateShown, &windowState.handCommands, &HandCommands::setHandState);
  connect(panel_, &HandDock::unacknowledged, actions_.acknowledgeHand, &QAction::setEnabled);
  connect(
      panel_, &HandDock::conditionShown, &windowState.handCommands, &HandCommands::setCondition);
  connect(panel_, &HandDock::conditionChanged, this, [&windowState](const ExplainedCondition& now) {
    const std::string line = "hand: " + std::string(nameOf(now.condition)) + ": " + now.sentence;
    const bool bad =
        now.condition == HandCondition::kNotProtected || now.condition == HandCondition::kGone;
    windowState.log.add(bad ? LogLine::Severity::kWarning : LogLine::Severity::kInfo,
                        QString::fromStdString(line));
  });
  on(actions_.acknowledgeHand, [this] { panel_->acknowledge(); });
  connect(panel_, &HandDock::explained, this, [this, &windowState](const QString& why) {
    if (!panel_->isVisible()) windowState.messages.flash(why);
  });
  LiveController& live = windowState.live;
  connect(&live, &LiveController::sourceOpened, this, [this, &live] {
    panel_->setHand(live.source()->session.get(), live.source()->control.get());
    panel_->setUsualClose(live.source()->emulated ? kEmulatedCloseRatio
                                                  : GraspRequest().closeRatio);
  });
  connect(&live, &LiveController::leaving, this, [this] { panel_->setHand(nullptr, nullptr); });
  connect(&windowState.displayed, &DisplayedSource::handChanged, panel_, &HandDock::updateHand);
  connect(&windowState.displayed, &DisplayedSource::changed, this, [this, &windowState] {
    panel_->setInSight(!windowState.displayed.isRecording());
  });
  connect(panel_,
          &HandDock::unmeasurableChanged,
          &windowState.derivedResults,
          &DerivedResults::setUnmeasurable);
  connect(panel_, &HandDock::stopPressed, &windowState.handCommands, &HandCommands::asked);
  connect(panel_, &HandDock::stopPressed, &windowState.handCommands, &HandCommands::stopped);
  connect(panel_, &HandDock::asked, &windowState.handCommands, &HandCommands::asked);
  followUnits(panel_);
  SensitivityModes& modes = panel_->sensitivity();
  modes.noiseLines = [&windowState](const std::string& hand) {
    const auto& lines = windowState.handCommands.noiseLines;
    return lines ? lines(hand) : std::optional<NoiseFloor>();
  };
  panel_->calibrationOf = [&windowState](const std::string& hand) {
    const auto& applied = windowState.handCommands.calibration;
    return applied ? applied(hand) : std::optional<Calibration>();
  };
  panel_->calibrationBeingRead = [&windowState](const std::string& hand) {
    const auto& beingRead = windowState.handCommands.calibrationBeingRead;
    return beingRead && beingRead(hand);
  };
  panel_->ownMotion = [&live] {
    const LiveSource* source = live.source();
    const std::string_view text =
        source && source->emulated ? source->emulated->counts().ownMotion : std::string_view();
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
  };
  panel_->otherTask = [&windowState] {
    const auto& other = windowState.handCommands.otherTask;
    return other ? other() : HandTask();
  };
  TouchStore& touches = panel_->touches();
  touches.file = [&live] {
    const LiveSource* source = live.source();
    return touchesFile(source && source->emulated ? TouchedBy::kEmulatedHand : TouchedBy::kHand);
  };
  connect(&touches, &TouchStore::failed, this, [&windowState](const QString& why) {
    windowState.messages.failAbout(kTouchesTopic, why);
  });
  connect(&touches, &TouchStore::recovered, this, [&windowState] {
    windowState.messages.withdraw(kTouchesTopic);
  });
  connect(&windowState.handCommands,
          &HandCommands::calibrationApplied,
          panel_,
          &HandDock::renewCalibration);
  connect(&windowState.handCommands,
          &HandCommands::noiseLinesApplied,
          &modes,
          &SensitivityModes::renewNoiseLines);
  connect(&modes,
          &SensitivityModes::highChanged,
          &windowState.handCommands,
          &HandCommands::highSensitivityChanged);
}

HandFeature::~HandFeature() { panel_->setHand(nullptr, nullptr); }

std::vector<DockSpec> HandFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+H"),
           .liveArea = Qt::LeftDockWidgetArea,
           .tab = 3,
           .shownIn = {Preset::kGrasp}}};
}

}  // namespace palpate::gui
