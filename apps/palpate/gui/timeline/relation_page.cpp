#include "gui/timeline/relation_page.h"

#include <QComboBox>
#include <QLabel>
#include <cmath>

#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_style.h"
#include "gui/chart/plot.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

// More points than a screen has are thinned out evenly.
constexpr std::size_t kMaxPoints = 20'000;

std::string relationCell(double value) {
  return std::isfinite(value) ? numberText(value) : std::string();
}

void includeIn(QCPRange& range, bool& any, double value) {
  if (!any) range = QCPRange(value, value);
  range.expand(value);
  any = true;
}

QCPRange withAir(const QCPRange& range) {
  const double air = range.size() > 0.0 ? 0.04 * range.size() : 0.5;
  return {range.lower - air, range.upper + air};
}

}  // namespace

RelationPage::RelationPage(const SelectedCurves& selected, QWidget* parent)
    : QWidget(parent), timeS_(selected.timeS) {
  for (const SelectedCurves::Curve& curve : selected.curves) {
    values_.push_back(curve.values);
    names_.push_back(curve.name + " in " + curve.unit);
  }
  const auto field = [this](const char* name, const char* accessible) {
    auto* box = named(new QComboBox(this), name, {}, accessible);
    for (const QString& curve : names_) box->addItem(curve);
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(14);
    return box;
  };
  x_ = field("relationX", "Curve along x");
  y_ = field("relationY", "Curve along y");
  if (names_.size() > 1) y_->setCurrentIndex(1);
  words_ = makeLines(this, "relationWords");
  plot_ = new QCustomPlot(this);
  plot_->setMinimumSize(240, 140);
  plot_->setAccessibleName("XY plot");
  arrangeChart(*plot_);
  styleChart(*plot_);
  const ThemeColors& colors = colorsOf();
  points_ = new QCPCurve(plot_->xAxis, plot_->yAxis);
  points_->setLineStyle(QCPCurve::lsNone);
  points_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, colors.accent, 3));
  line_ = plot_->addGraph();
  line_->setPen(QPen(colors.text, 1.2, Qt::DashLine));
  setLayout(inColumn(
      {inRow({makeTitle("&x", x_), {x_, 1}, makeTitle("&y", y_), {y_, 1}}), {plot_, 1}, words_},
      kPageEdges));
  for (QComboBox* box : {x_, y_})
    connect(box, &QComboBox::currentIndexChanged, this, &RelationPage::show);
  show();
}

void RelationPage::show() {
  if (x_->currentIndex() < 0 || y_->currentIndex() < 0) return;
  const auto& x = values_[static_cast<std::size_t>(x_->currentIndex())];
  const auto& y = values_[static_cast<std::size_t>(y_->currentIndex())];
  relation_ = linearRelation(x, y);
  QVector<QCPCurveData> points;
  QCPRange rangeX(0.0, 1.0), rangeY(0.0, 1.0);
  bool anyX = false, anyY = false;
  const std::size_t step = x.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    includeIn(rangeX, anyX, x[i]);
    includeIn(rangeY, anyY, y[i]);
    if (i % step == 0) points.append({static_cast<double>(i), x[i], y[i]});
  }
  points_->data()->set(points, true);
  line_->data()->clear();
  if (std::isfinite(relation_.slope))
    for (const double at : {rangeX.lower, rangeX.upper})
      line_->addData(at, relation_.intercept + relation_.slope * at);
  plot_->xAxis->setRange(withAir(rangeX));
  plot_->yAxis->setRange(withAir(rangeY));
  plot_->xAxis->setLabel(x_->currentText());
  plot_->yAxis->setLabel(y_->currentText());
  const auto number = [](double value) { return QString::number(value, 'g', 5); };
  if (relation_.count < 2)
    words_->setText("Fewer than two frames have both values.");
  else if (!std::isfinite(relation_.slope))
    words_->setText("x doesn't change.");
  else
    words_->setText(
        numberOf(relation_.count, "frame") + "; correlation " +
        (std::isfinite(relation_.correlation) ? QString::number(relation_.correlation, 'f', 4)
                                              : QString("–")) +
        "; y = " + number(relation_.intercept) + (relation_.slope < 0.0 ? " − " : " + ") +
        number(std::abs(relation_.slope)) + " x" +
        (std::isfinite(relation_.residualSd) ? "; residuals ± " + number(relation_.residualSd)
                                             : QString()));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

TextTable RelationPage::table() const {
  if (x_->currentIndex() < 0 || y_->currentIndex() < 0) return {};
  const auto x = static_cast<std::size_t>(x_->currentIndex());
  const auto y = static_cast<std::size_t>(y_->currentIndex());
  return {.header = {"time_s", names_[x].toStdString(), names_[y].toStdString()},
          .numRows = timeS_.size(),
          .row = [timeS = timeS_, xs = values_[x], ys = values_[y]](std::size_t row) {
            return std::vector<std::string>{
                numberText(timeS[row]), relationCell(xs[row]), relationCell(ys[row])};
          }};
}

}  // namespace palpate::gui
