// Checks the layout of docks that QMainWindow::saveState() made and the settings kept.
// QMainWindow::restoreState() trusts it: a side that doesn't exist, for example, is written to
// memory that isn't its own.
#pragma once

#include <QByteArray>

namespace palpate::gui {

// Whether these bytes are a layout of docks without toolbars, as Qt 6 writes it, whole and with
// sizes that a screen can have.
bool isDockLayout(const QByteArray& bytes);

}  // namespace palpate::gui
