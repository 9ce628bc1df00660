// The trash of the desktop.
#pragma once

#include <QString>

namespace palpate::gui {

// Moves a file into the trash; false: there is none for this file, and nothing was moved. The trash
// of the user is made when it does not exist yet.
bool moveFileToTrash(const QString& path);

}  // namespace palpate::gui
