#include "gui/hand3d/hand_frame_painter.h"

#include <memory>
#include <mutex>

#include "gui/matrices/matrices_frame_painter.h"

namespace palpate::gui {

FramePictures::Paint handFramePainter(const Profile& profile,
                                      const HandPictureOptions& options,
                                      const std::vector<double>& assumedDeg) {
  const auto drawing = std::make_shared<HandSceneBuilder>();
  const auto begun = std::make_shared<std::once_flag>();
  return [profile, options, assumedDeg, drawing, begun](QPainter& painter, std::size_t frame) {
    // Reads the files of the hand's shape, in the thread that paints.
    std::call_once(*begun, [&] { drawing->setHand(profile.hand(), true); });
    HandPictureOptions now = options;
    if (!now.page.title.isEmpty()) now.page.caption = captionOf(profile, frame);
    const auto angles = profile.anglesAtFrame(frame);
    drawing->setMoment(profile.frame(frame), angles ? angles->values : assumedDeg);
    now.notice = poseNotice(*drawing, !angles && !assumedDeg.empty());
    paintHandPicture(painter, QRectF(QPointF(), now.page.size), *drawing, now);
  };
}

}  // namespace palpate::gui
