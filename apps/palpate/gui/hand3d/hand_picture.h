// The hand in space as a picture: the scene, and over it title, colour bar, scale and what there is
// to say. Used by the window, by exported files and by `palpate render --view hand`.
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
  MatricesPictureOptions page;  // size, title, caption, colour bar, theme, font, pixel ratio
  HandLook look;                // its map, range and theme follow the page's
  HandCamera camera;
  QString notice;  // "no joint angles: the hand at rest"; empty: nothing to say
};

// The look with the colours of the page; a range that is empty there is that of the frame.
HandLook lookOf(const HandPictureOptions& options, const HandSceneBuilder& drawing);
// What lies over the scene; `area` is the picture's.
void paintHandOverlay(QPainter& painter,
                      const QRectF& area,
                      const HandSceneBuilder& drawing,
                      const HandScene& scene,
                      const HandPictureOptions& options);
// Everything, drawn without OpenGL. On vector devices the scene is an image of 300 dots per inch.
void paintHandPicture(QPainter& painter,
                      const QRectF& area,
                      const HandSceneBuilder& drawing,
                      const HandPictureOptions& options);

// "enclosing sphere 65.9 mm across"; empty: there is none.
QString sphereText(const HandSceneBuilder& drawing, SphereOf of);
// What a user should know about the pose that is shown; empty: all is well. `assumed`: the angles
// aren't the recording's.
QString poseNotice(const HandSceneBuilder& drawing, bool assumed);

}  // namespace palpate::gui
