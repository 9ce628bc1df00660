// The unit of a hand's values, and how precisely they are shown.
#pragma once

#include <QString>

#include <palpate/model/hand_description.h>

namespace palpate::gui {

// "counts", "kPa", ..
QString unitOf(const HandDescription& hand);
// The number of decimals of shown values, 0..6: so many that full scale has three digits or more.
// 0 for 4095 counts, 1 for 40 kPa, 2 for 1 N.
int decimalsOf(const HandDescription& hand);

}  // namespace palpate::gui
