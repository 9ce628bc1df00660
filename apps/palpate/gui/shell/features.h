// The features of the window, each made in one line.
#pragma once

#include <memory>
#include <vector>

#include "gui/window_state/feature.h"

namespace palpate::gui {

// In the order in which the menu View names their docks, and views are offered to be taken away.
std::vector<std::unique_ptr<Feature>> allFeatures(WindowState& windowState, QWidget* window);

}  // namespace palpate::gui
