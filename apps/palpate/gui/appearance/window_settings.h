// The appearance settings of the window (theme, colour map, range, plotted signal, units,
// playback), stored from one start to the next.
#pragma once

#include <QSettings>
#include <QString>
#include <array>

#include "gui/appearance/color_map.h"
#include "gui/appearance/display_units.h"
#include "gui/appearance/plotted_signal.h"
#include "gui/appearance/taxel_view.h"
#include "gui/appearance/theme.h"

namespace palpate::gui {

// Where the colour range of the heat maps ends.
enum class RangeMode {
  // The largest value of the whole recording.
  kRecording,
  // The largest value of the frame.
  kFrame,
  // The largest value that the AD converter can deliver.
  kFullScale,
  kManual
};
inline constexpr std::array kAllRangeModes = {
    RangeMode::kRecording, RangeMode::kFrame, RangeMode::kFullScale, RangeMode::kManual};
// "whole recording", ..; also the key in the settings.
QString nameOf(RangeMode mode);

struct ViewSettings {
  ThemeChoice theme = ThemeChoice::kSystem;
  ColorMapName map = ColorMapName::kInferno;
  bool interpolated = false;
  bool values = false;
  TaxelView taxels = TaxelView::kNormal;
  double arrows = kUsualArrows;  // factor of the arrows of shear; 0: none
  RangeMode range = RangeMode::kRecording;
  double manualMin = 0.0;  // [counts]
  double manualMax = 1000.0;
  PlottedSignal signal = PlottedSignal::kSum;  // steady when a taxel is at the threshold
  DisplayUnits units = {};
  double speed = 1.0;
  bool loop = false;
  bool skipGaps = false;
};

// $XDG_CONFIG_HOME/palpate/palpate.ini
QString settingsPath();
// Folder of what can be computed again. With settings other than the user's own (of a test or a
// screenshot) it is next to those settings, so that the user's files are not touched.
QString cacheFolder(const QSettings& settings);
// Values out of range are replaced by the defaults: a settings file never stops the program.
ViewSettings loadViewSettings(const QSettings& settings);
void saveViewSettings(const ViewSettings& view, QSettings& settings);

}  // namespace palpate::gui
