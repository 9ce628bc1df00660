#include "gui/hand3d/hand_frame_painter.h"

#include <memory>

#include "gui/matrices/matrices_frame_painter.h"

namespace palpate::gui {

FramePictures::Paint handFramePainter(const Profile& profile,
                                      const HandPictureOptions& options,
                                      const std::vector<double>& assumedDeg) {
  const auto drawing = std::make_shared<HandSceneBuilder>();
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
