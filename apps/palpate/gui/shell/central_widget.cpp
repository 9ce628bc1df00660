#include "gui/shell/central_widget.h"

#include <QPainter>
#include <algorithm>

#include "gui/appearance/settings_file.h"
#include "gui/widgets/fitting_pages.h"

namespace palpate::gui {
namespace {

constexpr int kViewsBorder = 2;  // [px]
constexpr const char* kViewsKey = "window/views";

QVBoxLayout* centreColumn(QWidget* parent) {
  auto* column = new QVBoxLayout(parent);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  return column;
}

}  // namespace

// What is shown of a source.
class CentralWidget::BorderedPage : public QWidget {
 public:
  using QWidget::QWidget;
  void setBorder(const QColor& color) {
    if (color == color_) return;
    color_ = color;
    const int width = color.isValid() ? kViewsBorder : 0;
    layout()->setContentsMargins(width, width, width, width);
    update(QRegion(rect()).subtracted(
        rect().adjusted(kViewsBorder, kViewsBorder, -kViewsBorder, -kViewsBorder)));
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    if (!color_.isValid()) return;
    QPainter painter(this);
    painter.setClipRegion(QRegion(rect()).subtracted(
        rect().adjusted(kViewsBorder, kViewsBorder, -kViewsBorder, -kViewsBorder)));
    painter.fillRect(rect(), color_);
  }

 private:
  QColor color_;
};

CentralWidget::CentralWidget(QSettings& settings, QWidget* parent)
    : QWidget(parent), settings_(settings) {
  lines_ = centreColumn(this);
  pages_ = new FittingPages(this);
  page_ = new BorderedPage(pages_);
  column_ = centreColumn(page_);
  work_ = new FittingPages(page_);
  views_ = new ViewSplitter(work_);
  views_->setObjectName("views");
  // When the window is closed, a view may be hidden.
  connect(views_, &QSplitter::splitterMoved, this, &CentralWidget::remember);
  work_->addWidget(views_);
  column_->addWidget(work_, 1);
  pages_->addWidget(page_);
}

void CentralWidget::add(const CentralViewSpec& offer) {
  switch (offer.where) {
    case CentralViewSpec::Where::kStart:
      pages_->insertWidget(0, offer.widget);
      break;
    case CentralViewSpec::Where::kBeside:
      views_->addWidget(offer.widget);
      views_->setStretchFactor(views_->count() - 1, 1);
      break;
    case CentralViewSpec::Where::kInstead:
      work_->addWidget(offer.widget);
      break;
    case CentralViewSpec::Where::kBelow:
      column_->addWidget(offer.widget);
      below_.push_back(offer.widget);
      break;
  }
}

void CentralWidget::add(std::vector<BannerSpec> strips) {
  std::stable_sort(strips.begin(), strips.end(), [](const BannerSpec& a, const BannerSpec& b) {
    return a.order < b.order;
  });
  for (const BannerSpec& strip : strips) lines_->addWidget(strip.widget);
}

void CentralWidget::begin() {
  constexpr int kAlike = 1000;
  lines_->addWidget(pages_, 1);
  if (!restoreParts(*views_, settings_, kViewsKey))
    views_->setSizes(QList<int>(views_->count(), kAlike));
  setPlace(DisplayedSource::Kind::kNothing);
}

void CentralWidget::setPlace(DisplayedSource::Kind place) {
  pages_->setCurrentIndex(place == DisplayedSource::Kind::kNothing ? 0 : 1);
  for (QWidget* widget : below_) widget->setVisible(place == DisplayedSource::Kind::kRecording);
}

void CentralWidget::setComparing(bool on) { work_->setCurrentIndex(on ? 1 : 0); }

void CentralWidget::setBorder(const QColor& color) { page_->setBorder(color); }

void CentralWidget::remember() { storeParts(*views_, settings_, kViewsKey); }

}  // namespace palpate::gui
