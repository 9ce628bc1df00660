// palpate render --view hand: the hand in space instead of the heat maps.
#pragma once

#include <optional>
#include <vector>

#include "palpate/model/profile.h"

#include "commands/command_line.h"
#include "gui/hand3d/hand_look.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/picture/exported_view.h"

namespace palpate::commands {

// The options that --view hand adds.
std::vector<OptionSpec> handViewOptions();
// Throws UsageError: an option of the hand without --view hand, or one that makes no sense.
void checkHandUsage(const CommandLine& given);

// What is drawn of the hand, and from where.
struct HandRendering {
  gui::HandLook look = {};
  std::vector<double> assumedAnglesDeg = {};  // where none are recorded; empty: at rest
  // Where the eye stands; nothing: as in the window.
  struct Eye {
    double azimuthDeg = 0.0, elevationDeg = 0.0;
  };
  std::optional<Eye> eye = std::nullopt;
};
// Draws frames of the hand, from one place for all of `span`. Throws Error for a geometry that
// isn't there.
gui::FramePictures::Paint handPainter(const HandRendering& view,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page);
// The same as `given` says. Throws Error for a matrix that isn't there, too.
gui::FramePictures::Paint handPainter(const CommandLine& given,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page);

}  // namespace palpate::commands
