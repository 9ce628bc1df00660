// `palpate render --view hand`: draws the hand in 3-D instead of the heat maps.
#pragma once

#include <vector>

#include "palpate/model/profile.h"

#include "commands/command_line.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/picture/exported_view.h"

namespace palpate::commands {

// The options that --view hand adds.
std::vector<OptionSpec> handViewOptions();
// Throws UsageError for an option of the hand without --view hand, or an invalid combination.
void checkHandUsage(const CommandLine& given);

// Draws frames of the hand with one camera for all frames of `span`, with the options of `given`.
// Throws Error when the geometry or a matrix does not exist.
gui::FramePictures::Paint handPainter(const CommandLine& given,
                                      const Profile& profile,
                                      const gui::FrameSpan& span,
                                      const gui::MatricesPictureOptions& page);

}  // namespace palpate::commands
