#include "gui/appearance/text_size.h"

#include <QApplication>
#include <QWidget>
#include <cmath>

namespace palpate::gui {
namespace {
constexpr const char* kTextPtKey = "view/text_pt";
}  // namespace

int loadTextPt(const QSettings& settings) {
  const int pt = settings.value(kTextPtKey, 0).toInt();
  return pt >= kLeastTextPt && pt <= kMostTextPt ? pt : 0;
}

void saveTextPt(int pt, QSettings& settings) { settings.setValue(kTextPtKey, pt); }

void applyTextPt(int pt) {
  static const double ofDesktopPt = QFontInfo(QApplication::font()).pointSizeF();
  QFont font = QApplication::font();
  const double beforePt = QFontInfo(font).pointSizeF();
  const double wantedPt = pt > 0 ? pt : ofDesktopPt;
  constexpr double kSame = 0.01;
  if (std::abs(wantedPt - beforePt) < kSame) return;
  font.setPointSizeF(wantedPt);
  QApplication::setFont(font);
  // Widgets with a size of their own take none of the application.
  for (QWidget* widget : QApplication::allWidgets()) {
    QFont own = widget->font();
    if (!widget->testAttribute(Qt::WA_SetFont) || own.pointSizeF() <= 0.0) continue;
    if ((own.resolveMask() & QFont::SizeResolved) == 0) continue;
    own.setPointSizeF(own.pointSizeF() * wantedPt / beforePt);
    widget->setFont(own);
  }
}

}  // namespace palpate::gui
