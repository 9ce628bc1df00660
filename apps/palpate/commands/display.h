// Whether a window can be shown at all: asked before Qt is, because Qt aborts where it can't.
#pragma once

#include <filesystem>

namespace palpate::commands {

// True when an X server or a Wayland compositor answers, or QT_QPA_PLATFORM names a platform that
// is installed and needs none of them.
bool hasDisplay();
// Makes Qt draw without a display (platform "offscreen"): pictures need none.
void drawWithoutDisplay();

// A folder for XDG_RUNTIME_DIR where nobody is logged in (a server, a container): without one Qt
// says so on standard error. Removed at the end.
class RuntimeFolder {
 public:
  RuntimeFolder();
  ~RuntimeFolder();
  RuntimeFolder(const RuntimeFolder&) = delete;
  RuntimeFolder& operator=(const RuntimeFolder&) = delete;

 private:
  std::filesystem::path path_;
};

}  // namespace palpate::commands
