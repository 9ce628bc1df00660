#include "gui/appearance/window_settings.h"

#include <QStandardPaths>
#include <cmath>

#include <palpate/capture/playback.h>

namespace palpate::gui {
namespace {

// Largest end of a manual range [counts].
constexpr double kLargestValue = 1e9;

double windowSettingsNumberIn(const QSettings& settings,
                              const char* key,
                              double lowest,
                              double highest,
                              double defaultValue) {
  bool isNumber = false;
  const double value = settings.value(key, defaultValue).toDouble(&isNumber);
  return isNumber && value >= lowest && value <= highest ? value : defaultValue;
}

}  // namespace

QString nameOf(RangeMode mode) {
  switch (mode) {
    case RangeMode::kFrame:
      return "this frame";
    case RangeMode::kFullScale:
      return "full scale";
    case RangeMode::kManual:
      return "manual";
    case RangeMode::kRecording:
      break;
  }
  return "whole recording";
}

QString settingsPath() {
  return QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation) +
         "/palpate/palpate.ini";
}

ViewSettings loadViewSettings(const QSettings& settings) {
  const ViewSettings usual;
  ViewSettings view;
  view.theme = themeChoiceFrom(settings.value("view/theme").toString());
  const std::string map = settings.value("view/map").toString().toStdString();
  view.map = colorMapFrom(map).value_or(usual.map);
  view.interpolated = settings.value("view/interpolated", usual.interpolated).toBool();
  view.values = settings.value("view/values", usual.values).toBool();
  const QString range = settings.value("view/range").toString();
  for (const RangeMode mode : kAllRangeModes)
    if (range == nameOf(mode)) view.range = mode;
  view.manualMin =
      windowSettingsNumberIn(settings, "view/manual_min", 0.0, kLargestValue, usual.manualMin);
  view.manualMax =
      windowSettingsNumberIn(settings, "view/manual_max", 0.0, kLargestValue, usual.manualMax);
  if (!(view.manualMax > view.manualMin)) {
    view.manualMin = usual.manualMin;
    view.manualMax = usual.manualMax;
  }
  view.signal = plottedSignalFrom(settings.value("view/signal").toString());
  view.units = loadDisplayUnits(settings);
  view.speed = windowSettingsNumberIn(
      settings, "playback/speed", Playback::kMinimumSpeed, Playback::kMaximumSpeed, usual.speed);
  view.loop = settings.value("playback/loop", usual.loop).toBool();
  view.skipGaps = settings.value("playback/skip_gaps", usual.skipGaps).toBool();
  return view;
}

void saveViewSettings(const ViewSettings& view, QSettings& settings) {
  settings.setValue("view/theme", nameOf(view.theme));
  settings.setValue("view/map", QString(nameOf(view.map)));
  settings.setValue("view/interpolated", view.interpolated);
  settings.setValue("view/values", view.values);
  settings.setValue("view/range", nameOf(view.range));
  settings.setValue("view/manual_min", view.manualMin);
  settings.setValue("view/manual_max", view.manualMax);
  settings.setValue("view/signal", nameOf(view.signal));
  saveDisplayUnits(view.units, settings);
  settings.setValue("playback/speed", view.speed);
  settings.setValue("playback/loop", view.loop);
  settings.setValue("playback/skip_gaps", view.skipGaps);
}

}  // namespace palpate::gui
