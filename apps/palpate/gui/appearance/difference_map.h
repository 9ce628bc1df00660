// Colours for the comparison of two recordings: those of A and B, and the colour map of A - B.
// Orange where A is larger, blue where B is larger, which colour-blind people can tell apart; the
// middle has the colour of a taxel at rest.
#pragma once

#include <QColor>
#include <QString>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"

namespace palpate::gui {

enum class CompareSide { kA, kB };
// Colour of the names and curves of A or B.
QColor sideColor(CompareSide side, Theme theme = shownTheme());

// The colour map from "B is larger" over 0 (the two entries in the middle) to "A is larger". Equal
// steps look equal (Oklab, Björn Ottosson 2020), and equal differences on both sides are equally
// far from the middle.
const ColorTable& differenceTable(Theme theme);

// The value with so many decimals and its sign: "+12", "−7", "0".
QString signedText(double value, int decimals);

}  // namespace palpate::gui
