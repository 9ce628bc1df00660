// Heat maps of single frames of a recording, as files take them.
#pragma once

#include "gui/matrices/matrices_painter.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// Options for a picture on paper instead of on screen.
MatricesPictureOptions fitted(MatricesPictureOptions options, const PictureLook& look);
// "frame 42 · 1.31 s"
QString captionOf(const Profile& profile, std::size_t frame);
// Holds its data itself and may be called in any thread, by one at a time. Where options.title
// isn't empty, each picture says which frame it is.
FramePictures::Paint matricesFramePainter(const OpenedRecordingPtr& recording,
                                          const MatricesPictureOptions& options);

}  // namespace palpate::gui
