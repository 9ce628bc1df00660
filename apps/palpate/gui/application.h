// The one QApplication, set up the same way for window, pictures and tests.
#pragma once

#include <QApplication>
#include <memory>

namespace palpate::gui {

// Null when there is one already. Numbers stay the same in every locale.
std::unique_ptr<QApplication> makeApplication(int& argc, char** argv);

}  // namespace palpate::gui
