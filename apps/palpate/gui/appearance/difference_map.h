// The colours of a comparison: of A, of B, and the map of A - B between them. Orange where A is
// larger, blue where B is: told apart by colour-blind eyes; in the middle the colour of a taxel at
// rest.
#pragma once

#include <QColor>
#include <QString>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"

namespace palpate::gui {

enum class CompareSide { kA, kB };
// Of names and curves.
QColor sideColor(CompareSide side, Theme theme);

// From "B is larger" over 0 (the two entries in the middle) to "A is larger"; equal steps look
// equal (Oklab, Björn Ottosson 2020), and equal ones on both sides are equally far from the middle.
const ColorTable& differenceTable(Theme theme);

// "+12", "−7", "0": with so many decimals, always with its sign.
QString signedText(double value, int decimals);

}  // namespace palpate::gui
