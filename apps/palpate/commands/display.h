// Finds out whether a window can be shown before Qt is started, because Qt aborts the process when
// it cannot.
#pragma once

#include <filesystem>

namespace palpate::commands {

// True when an X server or a Wayland compositor answers, or when QT_QPA_PLATFORM names an installed
// platform that needs neither.
bool hasDisplay();
// Makes Qt draw without a display (platform "offscreen"), which is enough for pictures.
void drawWithoutDisplay();

// A temporary folder for XDG_RUNTIME_DIR where no user is logged in (a server, a container);
// without it Qt prints a warning on standard error. The destructor removes it.
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
