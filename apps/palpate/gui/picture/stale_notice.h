// Paints the sign that the picture of a view is stale: a veil over it and a line with the reason.
// All views use it.
#pragma once

#include <QRectF>
#include <QString>

#include "gui/appearance/theme.h"

class QPainter;

namespace palpate::gui {

// Text over a picture that the user holds.
inline constexpr const char* kHeldText = "on hold – P resumes";

struct StaleNotice {
  // The reason, one line; empty: the picture is current.
  QString notice;
  // The user holds the picture; a lighter veil keeps it readable.
  bool held = false;
  bool operator==(const StaleNotice&) const = default;
};

// Paints over the picture; without a notice, paints nothing.
void paintStaleNotice(QPainter& painter,
                      const QRectF& area,
                      const StaleNotice& old,
                      Theme theme = shownTheme());

}  // namespace palpate::gui
