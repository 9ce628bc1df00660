// Paints the hand in 3-D at single frames of a recording, for exported files.
#pragma once

#include <vector>

#include <palpate/model/profile.h>

#include "gui/hand3d/hand_picture.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

// As matricesFramePainter(). `assumedDeg`: joint angles [deg] for a recording that has none; empty:
// the rest pose.
FramePictures::Paint handFramePainter(const Profile& profile,
                                      const HandPictureOptions& options,
                                      const std::vector<double>& assumedDeg);

}  // namespace palpate::gui
