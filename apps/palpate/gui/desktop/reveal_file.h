// Shows a file in the file manager of the desktop.
#pragma once

#include <QString>

namespace palpate::gui {

// Opens the file manager with the file selected; if it can't select a file, opens the folder.
void revealInFileManager(const QString& path);

}  // namespace palpate::gui
