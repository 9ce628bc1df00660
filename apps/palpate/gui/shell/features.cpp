#include "gui/shell/features.h"

#include "gui/batch/batch_feature.h"
#include "gui/calibrate/calibrate_feature.h"
#include "gui/compare/compare_feature.h"
#include "gui/connect/connect_feature.h"
#include "gui/export/export_feature.h"
#include "gui/filter/filter_feature.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/help/help_feature.h"
#include "gui/import/import_feature.h"
#include "gui/inspect/inspect_feature.h"
#include "gui/library/library_feature.h"
#include "gui/library/log_feature.h"
#include "gui/link/link_feature.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/open/open_feature.h"
#include "gui/open/recovery_feature.h"
#include "gui/playback/playback_feature.h"
#include "gui/recognise/recognise_feature.h"
#include "gui/record/record_feature.h"
#include "gui/settings/settings_feature.h"
#include "gui/slip/slip_feature.h"
#include "gui/spectrum/spectrum_feature.h"
#include "gui/timeline/timeline_feature.h"

namespace palpate::gui {

std::vector<std::unique_ptr<Feature>> allFeatures(WindowState& windowState, QWidget* window) {
  std::vector<std::unique_ptr<Feature>> all;
  const auto add = [&all](auto feature) -> auto& {
    auto& made = *feature;
    all.push_back(std::move(feature));
    return made;
  };
  // The central views come first: the key Tab moves the focus in this order.
  add(std::make_unique<OpenFeature>(windowState, window));
  auto& matrices = add(std::make_unique<MatricesFeature>(windowState, window));
  add(std::make_unique<Hand3dFeature>(windowState, window, matrices.panel()));
  add(std::make_unique<PlaybackFeature>(windowState, window));
  add(std::make_unique<CompareFeature>(windowState, window));
  add(std::make_unique<InspectFeature>(windowState, window));
  add(std::make_unique<TimelineFeature>(windowState, window));
  add(std::make_unique<HandFeature>(windowState, window));
  add(std::make_unique<LinkFeature>(windowState, window));
  add(std::make_unique<FilterFeature>(windowState, window));
  add(std::make_unique<SpectrumFeature>(windowState, window));
  add(std::make_unique<CalibrateFeature>(windowState, window));
  add(std::make_unique<SlipFeature>(windowState, window));
  add(std::make_unique<LibraryFeature>(windowState, window));
  add(std::make_unique<LogFeature>(windowState, window));
  add(std::make_unique<RecogniseFeature>(windowState, window));
  add(std::make_unique<ConnectFeature>(windowState, window));
  add(std::make_unique<RecordFeature>(windowState, window));
  add(std::make_unique<RecoveryFeature>(windowState, window));
  add(std::make_unique<ExportFeature>(windowState, window));
  add(std::make_unique<ImportFeature>(windowState, window));
  add(std::make_unique<BatchFeature>(windowState, window));
  add(std::make_unique<SettingsFeature>(windowState, window));
  add(std::make_unique<HelpFeature>(windowState, window));
  return all;
}

}  // namespace palpate::gui
