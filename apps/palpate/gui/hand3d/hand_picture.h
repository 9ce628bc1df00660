// Paints the hand in 3-D as a picture: the scene and, over it, title, colour bar, scale and
// notices. Used by the window, by exported files and by `palpate render --view hand`.
#pragma once

#include <QRectF>
#include <QString>

#include "gui/hand3d/hand_camera.h"
#include "gui/hand3d/hand_look.h"
#include "gui/hand3d/hand_scene_builder.h"
#include "gui/matrices/matrices_painter.h"

class QPainter;

namespace palpate::gui {

struct HandPictureOptions {
  // Size, title, caption, colour bar, theme, font, pixel ratio.
  MatricesPictureOptions page;
  // Its colour map, range and theme are replaced by those of the page.
  HandLook look;
  HandCamera camera;
  // For example "no joint angles: the hand at rest"; empty: no notice.
  QString notice;
};

// The look with the colours of the page; an empty range becomes that of the frame.
HandLook lookOf(const HandPictureOptions& options, const HandSceneBuilder& drawing);
// Paints everything over the scene; `area` is that of the picture.
void paintHandOverlay(QPainter& painter,
                      const QRectF& area,
                      const HandSceneBuilder& drawing,
                      const HandScene& scene,
                      const HandPictureOptions& options);
// Paints the whole picture without OpenGL. On vector devices the scene is an image of 300 dots per
// inch.
void paintHandPicture(QPainter& painter,
                      const QRectF& area,
                      const HandSceneBuilder& drawing,
                      const HandPictureOptions& options);

// "enclosing sphere 65.9 mm across"; empty: there is no sphere.
QString sphereText(const HandSceneBuilder& drawing, SphereOf of);
// What the user should know about the displayed pose; empty: nothing. `assumed`: the angles aren't
// those of the recording.
QString poseNotice(const HandSceneBuilder& drawing, bool assumed);
// What a notice takes of a view of this width, at its top [px]; 0 without one.
double noticeHeight(const QFont& font, double widthPx, const QString& notice);

}  // namespace palpate::gui
