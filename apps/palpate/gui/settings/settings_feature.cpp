#include "gui/settings/settings_feature.h"

#include "gui/appearance/text_size.h"
#include "gui/export/export_request.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {
namespace {

constexpr const char* kReopenKey = "settings/reopen";
constexpr const char* kForgottenKey = "settings/forgotten";

QString problemOfRecordings(RecordingSettings recording, const QString& folder) {
  recording.folder = folder;
  return previewNextPath(recording, systemClock().wallUs()).problem;
}

}  // namespace

bool reopensSession(const QSettings& settings) { return settings.value(kReopenKey, true).toBool(); }

void forgetChosen(QSettings& settings) {
  const QStringList chosen = settings.value(kForgottenKey).toStringList();
  settings.remove(kForgottenKey);
  for (const Forgettable& each : forgettable()) {
    if (!chosen.contains(each.name)) continue;
    if (each.groups.empty()) settings.clear();
    for (const char* group : each.groups) settings.remove(group);
  }
}

SettingsFeature::SettingsFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window) {
  QAction* action = windowState.actions.make("settings", "File", "Settin&gs…", {key("Ctrl+,")});
  on(action, [this] { ask(); });
  applyTextPt(loadTextPt(windowState.settings));
}

WindowChoices SettingsFeature::choices() const {
  const QSettings& settings = state().settings;
  const ViewSettings& view = state().appearance.view();
  return {.theme = view.theme,
          .textPt = loadTextPt(settings),
          .map = view.map,
          .range = view.range,
          .units = view.units,
          .recordings = loadRecordingSettings(settings).folder,
          .exports = loadExportRequest(settings).folder,
          .reopen = reopensSession(settings),
          .forgotten = settings.value(kForgottenKey).toStringList()};
}

void SettingsFeature::apply(const WindowChoices& wanted) {
  const WindowChoices now = choices();
  if (wanted == now) return;
  WindowState& all = state();
  saveTextPt(wanted.textPt, all.settings);
  applyTextPt(wanted.textPt);
  // The charts take colours and text from the theme.
  if (wanted.theme != now.theme || wanted.textPt != now.textPt)
    all.appearance.setTheme(wanted.theme);
  if (wanted.map != now.map || wanted.range != now.range)
    all.appearance.change([&](ViewSettings& view) {
      view.map = wanted.map;
      view.range = wanted.range;
    });
  all.appearance.setUnits(wanted.units);
  if (wanted.recordings != now.recordings) {
    RecordingSettings recording = loadRecordingSettings(all.settings);
    recording.folder = wanted.recordings;
    saveRecordingSettings(recording, all.settings);
    all.live.setFolder(wanted.recordings.toStdString());
  }
  if (wanted.exports != now.exports) {
    ExportRequest request = loadExportRequest(all.settings);
    request.folder = wanted.exports;
    saveExportRequest(request, all.settings);
  }
  all.settings.setValue(kReopenKey, wanted.reopen);
  all.settings.setValue(kForgottenKey, wanted.forgotten);
}

void SettingsFeature::ask() {
  SettingsDialog dialog(
      choices(),
      [this](const QString& folder) {
        return problemOfRecordings(loadRecordingSettings(state().settings), folder);
      },
      state().ask,
      window());
  connect(&dialog, &SettingsDialog::changed, this, &SettingsFeature::apply);
  dialog.exec();
}

}  // namespace palpate::gui
