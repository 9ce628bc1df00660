// How a view says that its picture isn't of now: a veil over it, and a line that tells why. The
// same in every view.
#pragma once

#include <QRectF>
#include <QString>

#include "gui/appearance/theme.h"

class QPainter;

namespace palpate::gui {

// Of a picture that the user holds.
inline constexpr const char* kHeldText = "held – P goes on";

struct StaleNotice {
  QString notice;     // why, one line; empty: the picture is of now
  bool held = false;  // by the user: still to be read, under a light veil
  bool operator==(const StaleNotice&) const = default;
};

// Over what was painted; nothing without a notice.
void paintStaleNotice(QPainter& painter, const QRectF& area, const StaleNotice& old, Theme theme);

}  // namespace palpate::gui
