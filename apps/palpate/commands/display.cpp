#include "commands/display.h"

#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include <dlfcn.h>

namespace palpate::commands {
namespace {

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

// Asks the X server named by DISPLAY. libxcb is what Qt itself connects with; without it there is no
// X window either.
bool xServerAnswers() {
  if (!isSet("DISPLAY")) return false;
  void* library = dlopen("libxcb.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (!library) return false;
  using Connect = void* (*)(const char*, int*);
  using HasError = int (*)(void*);
  using Disconnect = void (*)(void*);
  const auto connect = reinterpret_cast<Connect>(dlsym(library, "xcb_connect"));
  const auto hasError = reinterpret_cast<HasError>(dlsym(library, "xcb_connection_has_error"));
  const auto disconnect = reinterpret_cast<Disconnect>(dlsym(library, "xcb_disconnect"));
  if (!connect || !hasError || !disconnect) return false;
  void* connection = connect(nullptr, nullptr);
  const bool answers = connection && hasError(connection) == 0;
  if (connection) disconnect(connection);
  return answers;
}

}  // namespace

bool hasDisplay() {
  if (const char* platform = std::getenv("QT_QPA_PLATFORM"); platform && *platform) {
    const std::string_view name(platform);
    if (!name.starts_with("xcb") && !name.starts_with("wayland")) return true;
  }
  return isSet("WAYLAND_DISPLAY") || xServerAnswers();
}

void drawWithoutDisplay(bool evenWithDisplay) {
  if (isSet("QT_QPA_PLATFORM") && hasDisplay()) return;
  if (evenWithDisplay || !hasDisplay()) ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
}

RuntimeFolder::RuntimeFolder() {
  if (isSet("XDG_RUNTIME_DIR")) return;
  std::error_code failure;
  std::string pattern = std::filesystem::temp_directory_path(failure) / "palpate-runtime-XXXXXX";
  if (failure || !mkdtemp(pattern.data())) return;  // then Qt's warning stays
  path_ = pattern;
  ::setenv("XDG_RUNTIME_DIR", path_.c_str(), 1);
}

RuntimeFolder::~RuntimeFolder() {
  if (path_.empty()) return;
  ::unsetenv("XDG_RUNTIME_DIR");
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace palpate::commands
