#include "gui/chart/span_overlay.h"

#include <QWidget>
#include <algorithm>
#include <cmath>

#include "gui/appearance/theme.h"

namespace palpate::gui {
namespace {

constexpr int kSpanHandleWidth = 3;  // [px]
constexpr float kShadeAlpha = 0.16F;

int pixelOf(double position) {
  return static_cast<int>(std::lround(std::clamp(position, -1e6, 1e6)));
}

}  // namespace

QWidget* overlayOn(QWidget* chart, const char* name) {
  auto* widget = new QWidget(chart);
  widget->setObjectName(name);
  widget->setAttribute(Qt::WA_TransparentForMouseEvents);
  widget->hide();
  return widget;
}

SpanOverlay::SpanOverlay(QWidget* chart)
    : shade_(overlayOn(chart, "selectionShade")),
      handles_{overlayOn(chart, "selectionHandle"), overlayOn(chart, "selectionHandle")} {}

void SpanOverlay::restyle() {
  const ThemeColors& colors = colorsOf();
  QColor soft = colors.accent;
  soft.setAlphaF(kShadeAlpha);
  shade_->setStyleSheet("background: " + soft.name(QColor::HexArgb));
  for (QWidget* handle : handles_) handle->setStyleSheet("background: " + colors.accent.name());
}

void SpanOverlay::place(const QRect& plot,
                        std::optional<double> first,
                        std::optional<double> second) {
  const int from = first && second ? pixelOf(std::min(*first, *second)) : 0;
  const int to = first && second ? pixelOf(std::max(*first, *second)) : 0;
  const bool shaded = first && second && to >= plot.left() && from <= plot.right();
  shade_->setVisible(shaded);
  const int left = std::max(from, plot.left());
  shade_->setGeometry(
      left, plot.top(), std::max(1, std::min(to, plot.right()) - left), plot.height());
  for (const auto& [handle, end] : {std::pair(handles_[0], first), {handles_[1], second}}) {
    const int x = end ? pixelOf(*end) : 0;
    handle->setVisible(end && x >= plot.left() - 1 && x <= plot.right() + 1);
    handle->setGeometry(x - kSpanHandleWidth / 2, plot.top(), kSpanHandleWidth, plot.height());
  }
}

}  // namespace palpate::gui
