// The hand in space at single frames of a recording, as files take it.
#pragma once

#include <vector>

#include <palpate/model/profile.h>

#include "gui/hand3d/hand_picture.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

// As matricesFramePainter(). `assumedDeg`: for a recording without joint angles; empty: at rest.
FramePictures::Paint handFramePainter(const Profile& profile,
                                      const HandPictureOptions& options,
                                      const std::vector<double>& assumedDeg);

}  // namespace palpate::gui
