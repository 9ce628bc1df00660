#include "gui/matrices/taxel_text.h"

#include <algorithm>
#include <cmath>

#include <palpate/model/touch.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"

namespace palpate::gui {
namespace {

QString pressureText(const HandDescription& hand,
                     const TaxelPlace& place,
                     const PressureFrame* pressure,
                     const DisplayUnits& units) {
  const auto [m, y, x] = place;
  if (!pressure || pressure->kpa.size() != hand.layout->numCells()) return {};
  const std::size_t at =
      hand.layout->offset(m) + static_cast<std::size_t>(y * hand.layout->matrix(m).columns + x);
  const double forceN = taxelForceN(*pressure, *hand.layout, m, y, x);
  const bool isLimit = !pressure->areaKnown && forceN > 0.0;
  return " · " + shownUnit(units.pressure).text(static_cast<double>(pressure->kpa[at]), 1) + " · " +
         (isLimit ? "≤ " : "") + figure(forceN, 3) + " N" +
         (pressure->matrices[m].inRange ? "" : ", outside the measured range");
}

QString numberOf(const HandDescription& hand, float value) {
  return value == std::round(value)
             ? QString::number(std::lround(value))
             : QString::number(static_cast<double>(value), 'f', std::max(2, decimalsOf(hand)));
}

// "-5", with three components "x 3, y -2, z 60".
QString readingText(const HandDescription& hand,
                    const TaxelPlace& place,
                    const TactileFrame& frame) {
  const auto [x, y, z] = forceAt(frame, place);
  if (hand.layout->matrix(place.matrix).touch.components == 1) return numberOf(hand, z);
  return "x " + numberOf(hand, x) + ", y " + numberOf(hand, y) + ", z " + numberOf(hand, z);
}

}  // namespace

QString taxelText(const HandDescription& hand,
                  const TaxelPlace& place,
                  const std::optional<TactileFrame>& frame,
                  const PressureFrame* pressure,
                  const DisplayUnits& units) {
  const auto [m, y, x] = place;
  const MatrixLayout& layout = hand.layout->matrix(m);
  const QString where = QString::fromStdString(hand.matrixName(m)) + " · x " + QString::number(x) +
                        ", y " + QString::number(y) + " · ";
  if (!layout.enabled(y, x)) return where + "masked: not scanned";
  if (!frame) return where + "no frame yet";
  const float value = frame->allValues(m)(y, x);
  const bool ofReadings = !frame->readings.empty();
  if (!ofReadings && !isTouched(value)) return where + "0 " + unitOf(hand) + ", at rest";
  const QString number = ofReadings ? readingText(hand, place, *frame) : numberOf(hand, value);
  if (ofReadings && !isTouched(frame->matrix(m)(y, x)))
    return where + number + " " + unitOf(hand) + ", at rest";
  return where + number + " " + unitOf(hand) +
         (value >= hand.saturationOf(m) ? ", saturated" : "") +
         pressureText(hand, place, pressure, units);
}

}  // namespace palpate::gui
