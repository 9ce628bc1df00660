#include "gui/space/frame_painters.h"

#include <memory>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

namespace palpate::gui {
MatricesPictureOptions fitted(MatricesPictureOptions options, const PictureLook& look) {
  options.size = look.size;
  options.pixelRatio = look.pixelRatio;
  if (look.textUnits > 0) options.font.setPixelSize(look.textUnits);
  if (look.forPrint) options.theme = Theme::kLight;
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

FramePictures::Paint handFramePainter(const Profile& profile,
                                      const HandPictureOptions& options,
                                      const std::vector<double>& assumedDeg) {
  const auto drawing = std::make_shared<HandDrawing>();
  drawing->setHand(profile.hand());
  return [profile, options, assumedDeg, drawing](QPainter& painter, std::size_t frame) {
    HandPictureOptions now = options;
    if (!now.page.title.isEmpty()) now.page.caption = captionOf(profile, frame);
    const auto angles = profile.anglesAtFrame(frame);
    drawing->setMoment(profile.frame(frame), angles ? angles->deg : assumedDeg);
    now.notice = poseNotice(*drawing, !angles && !assumedDeg.empty());
    paintHandPicture(painter, QRectF(QPointF(), now.page.size), *drawing, now);
  };
}

}  // namespace palpate::gui
