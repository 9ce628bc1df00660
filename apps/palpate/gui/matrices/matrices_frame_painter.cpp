#include "gui/matrices/matrices_frame_painter.h"

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

namespace palpate::gui {
MatricesPictureOptions fitted(MatricesPictureOptions options, const PictureLook& look) {
  options.size = look.size;
  options.pixelRatio = look.pixelRatio;
  if (look.textUnits > 0) options.font.setPixelSize(look.textUnits);
  if (look.forPrint) options.theme = Theme::kLight;
  options.colorBar = options.colorBar && look.colorBar;
  if (!look.titled) {
    options.title.clear();
    options.caption.clear();
  }
  return options;
}

QString captionOf(const Profile& profile, std::size_t frame) {
  const auto us = profile.frameTimeUs(frame) - profile.frameTimeUs(0);
  return "frame " + QString::number(frame) + " · " +
         QString::fromStdString(fixedText(static_cast<double>(us) / kUsPerS, 2)) + " s";
}

FramePictures::Paint matricesFramePainter(const OpenedRecordingPtr& recording,
                                          const MatricesPictureOptions& options) {
  return [recording, options](QPainter& painter, std::size_t frame) {
    MatricesPictureOptions now = options;
    if (!now.title.isEmpty()) now.caption = captionOf(recording->profile, frame);
    paintMatricesPicture(painter,
                         QRectF(QPointF(), now.size),
                         recording->profile.frame(frame),
                         recording->profile.hand(),
                         now);
  };
}

}  // namespace palpate::gui
