#include "gui/recognise/feature_scatter.h"

#include <QListWidget>
#include <QPainter>
#include <QPixmap>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"
#include "gui/chart/plot.h"
#include "gui/recognise/grasp_table_model.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr double kScatterPoint = 6.0;    // [px]
constexpr double kScatterNear = 9.0;     // [px]
constexpr double kScatterFaint = 0.15;   // of points of other objects
constexpr int kScatterNamesWidth = 136;  // [px]
constexpr int kScatterIcon = 14;         // [px]

constexpr std::array kScatterForms = {QCPScatterStyle::ssDisc,
                                      QCPScatterStyle::ssSquare,
                                      QCPScatterStyle::ssTriangle,
                                      QCPScatterStyle::ssDiamond,
                                      QCPScatterStyle::ssTriangleInverted};

QCPScatterStyle scatterStyle(int object, const QColor& color, bool hollow) {
  const auto form = kScatterForms.at(static_cast<std::size_t>(object) % kScatterForms.size());
  if (hollow) return {QCPScatterStyle::ssCross, color, kScatterPoint};
  return {form, color, color, kScatterPoint};
}

QIcon scatterIcon(int object, const QColor& color) {
  QPixmap pixmap(kScatterIcon, kScatterIcon);
  pixmap.fill(Qt::transparent);
  QCPPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  const QCPScatterStyle style = scatterStyle(object, color, false);
  style.applyTo(&painter, QPen(color));
  style.drawShape(&painter, kScatterIcon / 2.0, kScatterIcon / 2.0);
  return QIcon(pixmap);
}

QCPRange scatterRange(const QCPRange& range) {
  const double air = range.size() > 0.0 ? 0.06 * range.size() : 0.5;
  return {range.lower - air, range.upper + air};
}

}  // namespace

QColor objectColor(int object, int count, Theme theme) {
  // Neighbours in the list differ in lightness, too.
  const double hue = static_cast<double>(object) / std::max(1, count);
  const bool bright = object % 2 == 0;
  if (theme == Theme::kDark) return QColor::fromHsvF(hue, bright ? 0.55 : 0.85, bright ? 1.0 : 0.8);
  return QColor::fromHsvF(hue, bright ? 0.9 : 1.0, bright ? 0.75 : 0.5);
}

FeatureScatter::FeatureScatter(QWidget* parent)
    : QWidget(parent), plot_(new QCustomPlot(this)), names_(new QListWidget(this)) {
  plot_->setObjectName("scatterPlot");
  plot_->setAccessibleName("Scatter plot of two features");
  plot_->setMinimumSize(180, 120);
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->setMouseTracking(true);
  arrangeChart(*plot_);
  names_->setObjectName("scatterObjects");
  names_->setAccessibleName("Objects of the scatter plot");
  names_->setToolTip("Click an object to highlight it; click again to show all");
  names_->setFrameShape(QFrame::NoFrame);
  // Longer names are shortened; their tool tips have them in full.
  names_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  names_->setTextElideMode(Qt::ElideRight);
  names_->setFixedWidth(kScatterNamesWidth);
  names_->setIconSize(QSize(kScatterIcon, kScatterIcon));
  names_->setSelectionMode(QAbstractItemView::SingleSelection);
  setLayout(inRow({{plot_, 1}, names_}));
  connect(plot_, &QCustomPlot::mousePress, this, [this](QMouseEvent* event) {
    pressed_ = event->position();
  });
  connect(plot_, &QCustomPlot::mouseRelease, this, [this](QMouseEvent* event) {
    // After a drag nothing is chosen.
    if ((event->position() - pressed_).manhattanLength() > kScatterPoint) return;
    if (const auto at = rowAt(event->position())) emit rowChosen(*at);
  });
  connect(plot_, &QCustomPlot::mouseDoubleClick, this, [this] { fit(); });
  connect(plot_, &QCustomPlot::mouseMove, this, &FeatureScatter::hover);
  connect(names_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
    const bool again = item->data(Qt::UserRole).toBool();
    for (int i = 0; i < names_->count(); ++i) names_->item(i)->setData(Qt::UserRole, false);
    item->setData(Qt::UserRole, !again);
    if (again) names_->setCurrentItem(nullptr);
  });
  connect(names_, &QListWidget::itemSelectionChanged, this, [this] { rebuild(); });
  fitToTheme(*this, [this] {
    styleChart(*plot_);
    rebuild();
  });
}

void FeatureScatter::setTable(const std::shared_ptr<const FeatureTable>& table,
                              std::vector<bool> leftOut) {
  table_ = table;
  leftOut_ = std::move(leftOut);
  chosen_ = -1;
  const QSignalBlocker blocker(names_);
  names_->clear();
  if (table_)
    for (const std::string& name : table_->classes()) {
      auto* item = new QListWidgetItem(QString::fromStdString(name), names_);
      item->setToolTip(item->text());
    }
  rebuild();
  fit();
}

void FeatureScatter::setLeftOut(std::vector<bool> leftOut) {
  leftOut_ = std::move(leftOut);
  rebuild();
}

void FeatureScatter::setAxes(std::size_t x, std::size_t y) {
  x_ = x;
  y_ = y;
  rebuild();
  fit();
}

void FeatureScatter::choose(int row) {
  chosen_ = row;
  showChosen();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void FeatureScatter::rebuild(Theme theme) {
  plot_->clearGraphs();
  const int count = names_->count();
  const QListWidgetItem* alone =
      names_->selectedItems().isEmpty() ? nullptr : names_->selectedItems().front();
  const bool drawn = table_ && x_ < table_->names.size() && y_ < table_->names.size();
  for (int object = 0; object < count; ++object) {
    const QColor full = objectColor(object, count, theme);
    names_->item(object)->setIcon(scatterIcon(object, full));
    if (!drawn) continue;
    QColor color = full;
    if (alone && alone != names_->item(object)) color.setAlphaF(kScatterFaint);
    const std::string name = names_->item(object)->text().toStdString();
    for (const bool out : {false, true}) {
      QCPGraph* graph = plot_->addGraph();
      graph->setLineStyle(QCPGraph::lsNone);
      graph->setAdaptiveSampling(false);
      graph->setScatterStyle(scatterStyle(object, color, out));
      for (std::size_t i = 0; i < table_->rows.size(); ++i) {
        const FeatureRow& row = table_->rows[i];
        if (row.className == name && leftOut_.at(i) == out)
          graph->addData(row.values[x_], row.values[y_]);
      }
    }
  }
  if (drawn) {
    plot_->xAxis->setLabel(featureLabel(table_->set, table_->names[x_]));
    plot_->yAxis->setLabel(featureLabel(table_->set, table_->names[y_]));
  }
  showChosen();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void FeatureScatter::showChosen() {
  plot_->clearItems();
  if (!table_ || chosen_ < 0 || chosen_ >= static_cast<int>(table_->rows.size()) ||
      x_ >= table_->names.size() || y_ >= table_->names.size())
    return;
  const FeatureRow& row = table_->rows[static_cast<std::size_t>(chosen_)];
  auto* mark = new QCPItemTracer(plot_);
  mark->position->setCoords(row.values[x_], row.values[y_]);
  mark->setStyle(QCPItemTracer::tsCircle);
  mark->setSize(2.0 * kScatterPoint);
  mark->setPen(QPen(colorsOf().text, 2.0));
}

void FeatureScatter::fit() {
  if (!table_ || table_->rows.empty() || x_ >= table_->names.size() || y_ >= table_->names.size())
    return;
  const auto span = [&](std::size_t column) {
    QCPRange range(table_->rows.front().values[column], table_->rows.front().values[column]);
    for (const FeatureRow& row : table_->rows) range.expand(row.values[column]);
    return scatterRange(range);
  };
  plot_->xAxis->setRange(span(x_));
  plot_->yAxis->setRange(span(y_));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

QPointF FeatureScatter::pointOf(int row) const {
  const FeatureRow& grasp = table_->rows.at(static_cast<std::size_t>(row));
  return {plot_->xAxis->coordToPixel(grasp.values.at(x_)),
          plot_->yAxis->coordToPixel(grasp.values.at(y_))};
}

std::optional<int> FeatureScatter::rowAt(const QPointF& at) const {
  std::optional<int> nearest;
  if (!table_ || x_ >= table_->names.size() || y_ >= table_->names.size()) return nearest;
  double least = kScatterNear;
  for (int row = 0; row < static_cast<int>(table_->rows.size()); ++row) {
    const QPointF between = pointOf(row) - at;
    const double distance = std::hypot(between.x(), between.y());
    if (distance >= least) continue;
    least = distance;
    nearest = row;
  }
  return nearest;
}

QString FeatureScatter::tipOf(int row) const {
  const FeatureRow& grasp = table_->rows.at(static_cast<std::size_t>(row));
  const auto line = [&](std::size_t column) {
    return QString::fromStdString(table_->names[column]) + " " +
           QString::number(grasp.values[column], 'g', 4);
  };
  return QString::fromStdString(grasp.className) + ": " + pathText(grasp.file.filename()) +
         ", grasp " + QString::number(grasp.number) + "\n" + line(x_) + ", " + line(y_) +
         (leftOut_.at(static_cast<std::size_t>(row)) ? "\nleft out" : "");
}

void FeatureScatter::paintPicture(QPainter& painter, const PictureLook& look) {
  const Theme theme = look.forPrint ? Theme::kLight : shownTheme();
  if (look.forPrint) rebuild(theme);
  ChartPictureOptions options{.title = look.titled ? "grasps" : ""};
  for (int object = 0; object < names_->count(); ++object) {
    const QColor color = objectColor(object, names_->count(), theme);
    options.legend.push_back(
        {names_->item(object)->text(), QPen(color), scatterStyle(object, color, false)});
  }
  if (std::find(leftOut_.begin(), leftOut_.end(), true) != leftOut_.end()) {
    const QColor color = colorsOf().text;
    options.legend.push_back({"left out", QPen(color), scatterStyle(0, color, true)});
  }
  paintChart(painter, look, *plot_, options);
  if (look.forPrint) rebuild();
}

void FeatureScatter::hover(QMouseEvent* event) {
  const auto at = rowAt(event->position());
  if (at)
    QToolTip::showText(event->globalPosition().toPoint(), tipOf(*at), plot_);
  else
    QToolTip::hideText();
}

}  // namespace palpate::gui
