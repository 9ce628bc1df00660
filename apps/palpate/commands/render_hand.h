// `palpate render --view hand`: draws the hand in 3-D instead of the heat maps.
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
// Throws UsageError for an option of the hand without --view hand, or an invalid combination.
void checkHandUsage(const CommandLine& given);

// What is drawn of the hand, and the viewpoint.
struct HandRendering {
  gui::HandLook look = {};
  // Joint angles [deg] for recordings without them; empty: the hand at rest.
  std::vector<double> assumedAnglesDeg = {};
  // Direction of the viewpoint; nothing: as in the window.
  struct Eye {
    double azimuthDeg = 0.0, elevationDeg = 0.0;
  };
  std::optional<Eye> eye = std::nullopt;
};
// Draws frames of the hand with one camera for all frames of `span`. Throws Error when the geometry
// does not exist.
gui::FramePictures::Paint handPainter(const HandRendering& view,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page);
// The same with the options of `given`. Also throws Error when a matrix does not exist.
gui::FramePictures::Paint handPainter(const CommandLine& given,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page);

}  // namespace palpate::commands
