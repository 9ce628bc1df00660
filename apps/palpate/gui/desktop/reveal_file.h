// The desktop's file manager.
#pragma once

#include <QString>

namespace palpate::gui {

// Shows a file in the file manager of the desktop; where that can't mark one, its folder.
void revealInFileManager(const QString& path);

}  // namespace palpate::gui
