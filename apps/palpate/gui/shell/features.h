// Creates all features of the window.
#pragma once

#include <memory>
#include <vector>

#include "gui/window_state/feature.h"

namespace palpate::gui {

// In the order in which the menu View lists their docks and the export dialogue offers their views.
std::vector<std::unique_ptr<Feature>> allFeatures(WindowState& windowState, QWidget* window);

}  // namespace palpate::gui
