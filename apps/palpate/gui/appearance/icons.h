// Draws the icons of the window as paths in the colours of the theme: sharp at every scale, without
// files or font glyphs.
#pragma once

#include <QIcon>

#include "gui/appearance/theme.h"

namespace palpate::gui {

enum class IconShape {
  kOpen,
  kExport,
  kToStart,
  kStepBack,
  kPlay,
  kPause,
  kStepForward,
  kLoop,
  kSkipGaps,
  kHelp,
  kClose,
  kInterpolated,
  kValues,
  kConnect,
  // In the theme's colour "danger".
  kRecord,
  kStopRecording,
  kLive
};

// The icon takes the accent colour when checked, a faded one when disabled; always those of the
// theme that is shown.
QIcon makeIcon(IconShape shape);

}  // namespace palpate::gui
