// palpate render --view hand: the hand in space instead of the heat maps.
#pragma once

#include <vector>

#include "palpate/model/profile.h"

#include "commands/command_line.h"
#include "gui/exported_view.h"
#include "gui/matrices_painter.h"

namespace palpate::commands {

// The options that --view hand adds.
std::vector<OptionSpec> handViewOptions();
// Throws UsageError: an option of the hand without --view hand, or one that makes no sense.
void checkHandUsage(const CommandLine& given);
// Draws frames of the hand as `given` says, from one place for all of `span`. Throws Error for a matrix or a geometry that
// isn't there.
gui::FramePictures::Paint handPainter(const CommandLine& given,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page);

}  // namespace palpate::commands
