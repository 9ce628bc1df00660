#include "gui/appearance/text_size.h"

#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QPointer>
#include <QWidget>
#include <cmath>
#include <utility>
#include <vector>

namespace palpate::gui {
namespace {
constexpr const char* kTextPtKey = "view/text_pt";

// The size that was asked for; of a font in pixels, that of the font found, which is rounded.
double sizePtOf(const QFont& font) {
  return font.pointSizeF() > 0.0 ? font.pointSizeF() : QFontInfo(font).pointSizeF();
}

double& presentScale() noexcept {
  static double scale = 1.0;
  return scale;
}
}  // namespace

double textScale() noexcept { return presentScale(); }

int loadTextPt(const QSettings& settings) {
  const int pt = settings.value(kTextPtKey, 0).toInt();
  return pt >= kMinInterfaceTextPt && pt <= kMaxInterfaceTextPt ? pt : 0;
}

void saveTextPt(int pt, QSettings& settings) { settings.setValue(kTextPtKey, pt); }

void applyTextPt(int pt) {
  static const double ofDesktopPt = sizePtOf(QApplication::font());
  QFont font = QApplication::font();
  const double beforePt = sizePtOf(font);
  const double wantedPt = pt > 0 ? pt : ofDesktopPt;
  presentScale() = wantedPt / ofDesktopPt;
  constexpr double kSame = 0.01;
  if (std::abs(wantedPt - beforePt) < kSame) return;
  font.setPointSizeF(wantedPt);
  // Widgets with a size of their own take none of the application.
  std::vector<std::pair<QPointer<QWidget>, double>> ownSizes;
  for (QWidget* widget : QApplication::allWidgets()) {
    const QFont own = widget->font();
    if (widget->testAttribute(Qt::WA_SetFont) && own.pointSizeF() > 0.0 &&
        (own.resolveMask() & QFont::SizeResolved) != 0)
      ownSizes.emplace_back(widget, own.pointSizeF());
  }
  QApplication::setFont(font);
  // Qt tells windows only, and under a style sheet children don't inherit the font of their window.
  for (QWidget* widget : QApplication::allWidgets()) {
    QEvent changed(QEvent::ApplicationFontChange);
    QApplication::sendEvent(widget, &changed);
  }
  for (const auto& [widget, sizePt] : ownSizes) {
    if (!widget) continue;
    QFont own = widget->font();
    own.setPointSizeF(sizePt * wantedPt / beforePt);
    widget->setFont(own);
  }
  // Qt keeps the least size of a combo box after a change of its font.
  for (QWidget* widget : QApplication::allWidgets()) {
    if (!qobject_cast<QComboBox*>(widget)) continue;
    QEvent changed(QEvent::StyleChange);
    QApplication::sendEvent(widget, &changed);
  }
}

}  // namespace palpate::gui
