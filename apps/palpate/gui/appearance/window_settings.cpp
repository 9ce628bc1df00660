#include "gui/appearance/window_settings.h"

#include <QFileInfo>
#include <QStandardPaths>

#include <palpate/playback/playback.h>

#include "gui/appearance/settings_table.h"

namespace palpate::gui {
namespace {

// Largest end of a manual range [counts].
constexpr double kLargestValue = 1e9;

void viewFields(SettingsTable& table, ViewSettings& view) {
  table.choice("view/theme", view.theme, kAllThemeChoices);
  table.choice("view/map", view.map, kAllColorMaps);
  table.flag("view/interpolated", view.interpolated);
  table.flag("view/values", view.values);
  table.choice("view/taxels", view.taxels, kAllTaxelViews);
  table.number("view/arrows", view.arrows, 0.0, kLongestArrows);
  table.choice("view/range", view.range, kAllRangeModes);
  table.number("view/manual_min", view.manualMin, 0.0, kLargestValue);
  table.number("view/manual_max", view.manualMax, 0.0, kLargestValue);
  QString signal = nameOf(view.signal);
  table.text("view/signal", signal);
  view.signal = plottedSignalFrom(signal);
  table.choice("units/angle", view.units.angle, kAllAngleUnits);
  table.choice("units/temperature", view.units.temperature, kAllTemperatureUnits);
  table.choice("units/area", view.units.area, kAllAreaUnits);
  table.choice("units/pressure", view.units.pressure, kAllPressureUnits);
  table.number("playback/speed", view.speed, Playback::kMinimumSpeed, Playback::kMaximumSpeed);
  table.flag("playback/loop", view.loop);
  table.flag("playback/skip_gaps", view.skipGaps);
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

QString cacheFolder(const QSettings& settings) {
  // Of files that don't exist yet QFileInfo compares nothing.
  if (QFileInfo(settings.fileName()).absoluteFilePath() ==
      QFileInfo(settingsPath()).absoluteFilePath())
    return QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + "/palpate";
  return QFileInfo(settings.fileName()).absolutePath() + "/cache";
}

ViewSettings loadViewSettings(const QSettings& settings) {
  auto view = loadFields<ViewSettings>(settings, viewFields);
  if (!(view.manualMax > view.manualMin)) {
    view.manualMin = ViewSettings().manualMin;
    view.manualMax = ViewSettings().manualMax;
  }
  return view;
}

void saveViewSettings(const ViewSettings& view, QSettings& settings) {
  saveFields(settings, view, viewFields);
}

}  // namespace palpate::gui
