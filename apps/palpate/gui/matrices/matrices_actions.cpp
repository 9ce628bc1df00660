#include "gui/matrices/matrices_actions.h"

#include "gui/appearance/color_map.h"
#include "gui/appearance/icons.h"
#include "gui/appearance/window_settings.h"

namespace palpate::gui {

MatricesActions::MatricesActions(ActionRegistry& book) {
  interpolated = book.make("interpolated", "View", "&Smooth", {key("I")}, true);
  interpolated->setToolTip("Smooth between taxels (I)");
  values = book.make("values", "View", "&Values", {key("V")}, true);
  values->setToolTip("Print the value of each active taxel (V)");
  nextMap = book.make("nextMap", "View", "Next &colour map", {key("M")});
  nextRange = book.make("nextRange", "View", "Next colour &range", {key("R")});
  scanOnly = book.make("scanOnly", "Hand", "Scan &only the chosen taxels", {});
  scanWithout = book.make("scanWithout", "Hand", "&Leave the chosen taxels out", {});
  scanAlso = book.make("scanAlso", "Hand", "Scan the chosen taxels, &too", {});
  scanAll = book.make("scanAll", "Hand", "Scan &all taxels", {});
  chooseNone = book.make("chooseNone", "Hand", "Choose no ta&xel", {key("Ctrl+Shift+A")});
  QStringList names;
  for (const ColorMapName map : kAllColorMaps) names.append(nameOf(map));
  maps = book.choices("maps", names);
  names.clear();
  for (const RangeMode mode : kAllRangeModes) names.append(nameOf(mode));
  ranges = book.choices("ranges", names);
  interpolated->setIconText(" " + plainText(*interpolated));
  values->setIconText(" " + plainText(*values));
  book.setIcon(interpolated, IconShape::kInterpolated);
  book.setIcon(values, IconShape::kValues);
}

}  // namespace palpate::gui
