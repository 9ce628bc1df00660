#include "gui/chart/plotted_curve.h"

#include <QApplication>

#include "palpate/device/sdh2.h"
#include <palpate/model/hand_description.h>

#include "gui/chart/chart_style.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::gui::plotted_curve_test {
namespace {

// O-A17: curves of the same colour have other lines, so that the legend tells them apart.
TEST(PlottedCurve, KindsOfTheSameColourHaveOtherLines) {
  const HandDescription& hand = sdh2();
  TaxelSelection taxels(*hand.layout);
  taxels.addAll(0);
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    applyTheme(*qApp, theme);
    std::vector<PlottedCurve> curves;
    for (std::size_t row = 0; row <= hand.layout->numMatrices(); ++row)
      curves.push_back(matrixCurve(hand, row, SignalKind::kMean));
    for (std::size_t place = 0; place < 5; ++place)
      curves.push_back(taxelCurve(hand, taxels, "group", place));
    for (std::size_t axis = 0; axis < hand.axes.size(); ++axis)
      curves.push_back(angleCurve(hand, axis));
    for (std::size_t sensor = 0; sensor < hand.temperatureSensors.size(); ++sensor)
      curves.push_back(temperatureCurve(hand, sensor));
    for (std::size_t column = 0; column < 3; ++column)
      curves.push_back(columnCurve(testing::wristSeries(), column, column));
    for (const PlottedCurve& a : curves)
      for (const PlottedCurve& b : curves) {
        if (a.choice.kind == b.choice.kind) continue;
        EXPECT_FALSE(a.pen.color() == b.pen.color() && a.pen.style() == b.pen.style())
            << a.name.toStdString() << ", " << b.name.toStdString();
      }
  }
}

// The chosen taxels are drawn first, and are seen through the gaps of a group of the same ones.
TEST(PlottedCurve, AGroupOfTheChosenTaxelsDoesNotCoverThem) {
  TaxelSelection taxels(*sdh2().layout);
  taxels.addAll(0);
  EXPECT_EQ(taxelCurve(sdh2(), taxels, "chosen", 0).pen.style(), Qt::SolidLine);
  EXPECT_NE(taxelCurve(sdh2(), taxels, "group", 1).pen.style(), Qt::SolidLine);
}

TEST(PlottedCurve, AFormulaLooksLikeNoCurveThatIsShown) {
  const HandDescription& hand = sdh2();
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    applyTheme(*qApp, theme);
    std::vector<PlottedCurve> curves;
    for (std::size_t row = 0; row <= hand.layout->numMatrices(); ++row)
      curves.push_back(matrixCurve(hand, row, SignalKind::kMean));
    constexpr std::size_t kFormulas = 12;
    for (std::size_t place = 0; place < kFormulas; ++place) {
      PlottedCurve formula = formulaCurve({}, "f", "counts", place);
      distinguish(formula, place, curves);
      for (const PlottedCurve& other : curves)
        EXPECT_FALSE(other.pen.color() == formula.pen.color() &&
                     other.pen.style() == formula.pen.style() &&
                     other.pen.dashPattern() == formula.pen.dashPattern())
            << place << ", " << other.name.toStdString();
      curves.push_back(formula);
    }
  }
  // Where its colour is free its line is solid.
  PlottedCurve alone = formulaCurve({}, "f", "counts", 0);
  distinguish(alone, 0, {});
  EXPECT_EQ(alone.pen, formulaCurve({}, "f", "counts", 0).pen);
}

TEST(PlottedCurve, AColumnIsNamedWithItsSeriesAndItsUnit) {
  const SeriesDescription wrist = testing::wristSeries();
  const PlottedCurve fz = columnCurve(wrist, 1, 1);
  EXPECT_EQ(fz.name, "wrist fz");
  EXPECT_EQ(fz.unit, "N");
  EXPECT_EQ(fz.baseUnit, "N");
  EXPECT_EQ(fz.axis, "wrist in N");
  EXPECT_EQ(fz.choice,
            (SeriesChoice{.kind = SeriesChoice::Kind::kColumn, .series = "wrist", .column = "fz"}));
  EXPECT_EQ(readingOf(fz, -0.000125), "-0.000125 N");
  EXPECT_EQ(readingOf(fz, std::nullopt), "–");
  EXPECT_NE(columnCurve(wrist, 0, 0).pen.color(), fz.pen.color());
  const PlottedCurve plain = columnCurve({"imu", "", {{"x", ""}, {"roll", "deg"}}, ""}, 0, 0);
  EXPECT_EQ(plain.axis, "imu");
  EXPECT_EQ(readingOf(plain, 2.5), "2.5");
  EXPECT_EQ(columnCurve({"imu", "", {{"x", ""}, {"roll", "deg"}}, ""}, 1, 0).unit, "°")
      << "on the axis of the joint angles";
}

TEST(PlottedCurve, ColumnsDifferInColourOrDashes) {
  SeriesDescription series{"skin", "", {}, ""};
  for (int i = 0; i < 24; ++i) series.columns.push_back({std::to_string(i), ""});
  std::vector<QPen> pens;
  for (std::size_t i = 0; i < series.columns.size(); ++i) {
    const QPen pen = columnCurve(series, i, i).pen;
    for (const QPen& other : pens)
      EXPECT_FALSE(other.color() == pen.color() && other.dashPattern() == pen.dashPattern()) << i;
    pens.push_back(pen);
    // One period fills the line of the legend.
    const QPen inLegend = legendPen(pen, 18.0);
    double lengthPx = 0.0;
    for (const qreal dash : inLegend.dashPattern()) lengthPx += dash * inLegend.widthF();
    EXPECT_NEAR(lengthPx, 18.0, 1e-9);
  }
  EXPECT_EQ(legendPen(QPen(Qt::red, 2.0, Qt::DashLine), 18.0), QPen(Qt::red, 2.0, Qt::DashLine));
}

}  // namespace
}  // namespace palpate::gui::plotted_curve_test
