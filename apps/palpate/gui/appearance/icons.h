// Icons drawn as paths in the colours of the theme: sharp at every scale, no files, no font glyphs.
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
  kRecord,  // in the colour of danger
  kStopRecording,
  kLive
};

// Switched on (checked) it takes the accent colour, disabled a faded one.
QIcon makeIcon(IconShape shape, Theme theme);

}  // namespace palpate::gui
