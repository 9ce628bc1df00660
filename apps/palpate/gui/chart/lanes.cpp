#include "gui/chart/lanes.h"

#include <QSharedPointer>
#include <algorithm>
#include <set>

#include "gui/appearance/captions.h"
#include "gui/chart/plot.h"

namespace palpate::gui {
namespace {

constexpr double kPartOfLane = 0.85;  // the rest is the space to the lane above
constexpr int kNoFinger = 1'000'000;  // the palm, and the whole hand: below all fingers

int fingerOfCurve(const PlottedCurve& curve, const HandDescription& hand) {
  const std::size_t matrix = curve.choice.index;
  if (matrix >= hand.matrices.size() || hand.matrices[matrix].finger < 0) return kNoFinger;
  return hand.matrices[matrix].finger;
}

}  // namespace

void Lanes::set(const std::vector<PlottedCurve>& curves, const HandDescription* hand) {
  using Kind = SeriesChoice::Kind;
  numLanes_ = 0;
  laneOf_.assign(curves.size(), -1);
  unit_.clear();
  if (!hand) return;
  std::set<int> fingers;
  const auto isOfMatrix = [](const PlottedCurve& curve) {
    return curve.choice.kind == Kind::kMatrix || curve.choice.kind == Kind::kForce;
  };
  const auto first = std::find_if(curves.begin(), curves.end(), isOfMatrix);
  if (first == curves.end()) return;
  unit_ = first->unit;
  const auto laneOf = [&](const PlottedCurve& curve) {
    return isOfMatrix(curve) ? fingerOfCurve(curve, *hand) : kNoFinger;
  };
  for (const PlottedCurve& curve : curves)
    if (curve.unit == unit_) fingers.insert(laneOf(curve));
  numLanes_ = fingers.size();
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (curves[i].unit == unit_)
      laneOf_[i] =
          static_cast<int>(std::distance(fingers.find(laneOf(curves[i])), fingers.end())) - 1;
}

double Lanes::placed(std::size_t curve, double value) const {
  if (!any() || laneOf_.at(curve) < 0) return value;
  return laneOf_[curve] + kPartOfLane * (value - range_.from) / (range_.to - range_.from);
}

void Lanes::scale(QCPAxis& axis) const {
  QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
  for (std::size_t lane = 0; lane < numLanes_; ++lane) {
    const auto low = static_cast<double>(lane);
    ticker->addTick(low, QString::fromStdString(numberText(range_.from)));
    ticker->addTick(low + kPartOfLane, QString::fromStdString(numberText(range_.to)));
  }
  axis.setScaleType(QCPAxis::stLinear);
  axis.setTicker(ticker);
  axis.setRange(0.0, static_cast<double>(numLanes_));
}

}  // namespace palpate::gui
