// Paints the heat maps of single frames of a recording, for exported files.
#pragma once

#include "gui/matrices/matrices_painter.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// Converts options for the screen into options for an exported picture.
MatricesPictureOptions fitted(MatricesPictureOptions options, const PictureLook& look);
// "frame 42 · 1.31 s"
QString captionOf(const Profile& profile, std::size_t frame);
// Returns a function that paints the heat maps of a frame. It owns its data and may be called in
// any thread, by one thread at a time. Unless options.title is empty, every picture names its
// frame.
FramePictures::Paint matricesFramePainter(const OpenedRecordingPtr& recording,
                                          const MatricesPictureOptions& options);

}  // namespace palpate::gui
