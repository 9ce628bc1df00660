#include "gui/picture/views_together.h"

#include <QColor>
#include <QPainter>
#include <QPalette>
#include <algorithm>
#include <numeric>
#include <utility>

namespace palpate::gui {
namespace {

// The look of a part in its place, of views or of pictures of frames. The first one names the
// recording for all, and the first one that has a colour bar shows it for all.
template <class Parts, class HasColorBar>
PictureLook partLook(const PictureLook& look,
                     const QRectF& place,
                     const Parts& parts,
                     std::size_t index,
                     const HasColorBar& hasColorBar) {
  PictureLook own = look;
  own.size = QSizeF(look.size.width() * place.width(), look.size.height() * place.height());
  own.titled = look.titled && index == 0;
  own.colorBar =
      look.colorBar &&
      std::none_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(index), hasColorBar);
  return own;
}

// Calls `paint` with the painter moved to the part's place.
template <class Paint>
void paintPart(QPainter& painter, const QSizeF& whole, const QRectF& place, const Paint& paint) {
  painter.save();
  painter.translate(whole.width() * place.left(), whole.height() * place.top());
  painter.setClipRect(QRectF(0, 0, whole.width() * place.width(), whole.height() * place.height()));
  paint();
  painter.restore();
}

std::vector<const ExportedView*> together(const std::vector<const ExportedView*>& views) {
  std::vector<const ExportedView*> parts;
  for (const ExportedView* view : views)
    if (view->widget && view->widget->isVisible() && view->paint &&
        (view->framePart || view->framePictures) && view->isThere())
      parts.push_back(view);
  return parts;
}

// Where the parts lie on the screen, with their proportions there or on paper.
Arrangement arranged(const std::vector<const ExportedView*>& parts, bool onPaper) {
  std::vector<QRectF> onScreen;
  std::vector<double> heights;
  for (const ExportedView* part : parts) {
    onScreen.emplace_back(part->widget->mapToGlobal(QPoint()), part->sizeOnScreen());
    heights.push_back((onPaper ? part->proportionsNow() : part->sizeOnScreen()).height());
  }
  return arrangementOf(onScreen, heights);
}

}  // namespace

Arrangement arrangementOf(const std::vector<QRectF>& onScreen,
                          const std::vector<double>& heightsInPicture) {
  std::vector<std::size_t> order(onScreen.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return onScreen[a].top() < onScreen[b].top();
  });
  std::vector<std::vector<std::size_t>> rows;
  for (const std::size_t each : order) {
    const double middle = onScreen[each].center().y();
    if (!rows.empty()) {
      const QRectF& first = onScreen[rows.back().front()];
      if (middle >= first.top() && middle <= first.bottom()) {
        rows.back().push_back(each);
        continue;
      }
    }
    rows.push_back({each});
  }
  Arrangement arranged{.size = QSizeF(0.0, 0.0), .places = std::vector<QRectF>(onScreen.size())};
  std::vector<double> heights;
  for (auto& row : rows) {
    std::stable_sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) {
      return onScreen[a].left() < onScreen[b].left();
    });
    double width = 0.0, height = 0.0;
    for (const std::size_t each : row) {
      width += onScreen[each].width();
      height = std::max(
          height, heightsInPicture.empty() ? onScreen[each].height() : heightsInPicture.at(each));
    }
    heights.push_back(height);
    arranged.size.setWidth(std::max(arranged.size.width(), width));
    arranged.size.setHeight(arranged.size.height() + height);
  }
  double top = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    double width = 0.0, left = 0.0;
    for (const std::size_t each : rows[r]) width += onScreen[each].width();
    for (const std::size_t each : rows[r]) {
      const double share = onScreen[each].width() / width;
      arranged.places[each] =
          QRectF(left, top / arranged.size.height(), share, heights[r] / arranged.size.height());
      left += share;
    }
    top += heights[r];
  }
  return arranged;
}

FramePictures framesTogether(std::vector<FramePictures> parts,
                             const std::vector<QRectF>& places,
                             const QColor& ground) {
  FramePictures all = parts.front();
  all.painter = [parts = std::move(parts), places, ground](const PictureLook& look) {
    std::vector<FramePictures::Paint> paints;
    for (std::size_t i = 0; i < parts.size(); ++i)
      paints.push_back(parts[i].painter(partLook(
          look, places[i], parts, i, [](const FramePictures& each) { return each.hasColorBar; })));
    return FramePictures::Paint(
        [paints, places, ground, size = look.size, forPrint = look.forPrint](QPainter& painter,
                                                                             std::size_t frame) {
          painter.fillRect(QRectF(QPointF(), size), forPrint ? QColor(Qt::white) : ground);
          for (std::size_t i = 0; i < paints.size(); ++i)
            paintPart(painter, size, places[i], [&] { paints[i](painter, frame); });
        });
  };
  return all;
}

ExportedView viewsTogether(std::function<std::vector<const ExportedView*>()> parts) {
  ExportedView view;
  view.name = "Views together";
  view.isThere = [parts] { return together(parts()).size() >= 2; };
  view.fileName = [parts] {
    const auto shown = together(parts());
    return (shown.empty() ? QString("views") : shown.front()->fileName() + "_views");
  };
  view.size = [parts] { return arranged(together(parts()), false).size; };
  view.proportions = [parts] { return arranged(together(parts()), true).size; };
  const auto groundOf = [](const ExportedView& part) {
    return part.widget->window()->palette().color(QPalette::Window);
  };
  view.paint = [parts, groundOf](QPainter& painter, const PictureLook& look) {
    const auto shown = together(parts());
    if (shown.empty()) return;
    const std::vector<QRectF> places = arranged(shown, look.onPaper()).places;
    painter.fillRect(QRectF(QPointF(), look.size),
                     look.forPrint ? QColor(Qt::white) : groundOf(*shown.front()));
    for (std::size_t i = 0; i < shown.size(); ++i)
      paintPart(painter, look.size, places[i], [&] {
        shown[i]->paint(painter, partLook(look, places[i], shown, i, [](const ExportedView* each) {
                          return each->hasColorBar;
                        }));
      });
  };
  view.framePictures = [parts, groundOf]() -> std::optional<FramePictures> {
    const auto shown = together(parts());
    std::vector<FramePictures> pictures;
    for (const ExportedView* part : shown) {
      auto own = part->framePart ? part->framePart() : part->framePicturesNow();
      if (!own) return std::nullopt;
      pictures.push_back(std::move(*own));
    }
    if (pictures.size() < 2) return std::nullopt;
    const QColor ground = groundOf(*shown.front());
    FramePictures all = framesTogether(pictures, arranged(shown, false).places, ground);
    all.painter = [screen = all.painter,
                   paper = framesTogether(pictures, arranged(shown, true).places, ground).painter](
                      const PictureLook& look) {
      return look.onPaper() ? paper(look) : screen(look);
    };
    all.fileName += "_views";
    return all;
  };
  return view;
}

}  // namespace palpate::gui
