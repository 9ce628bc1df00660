#include "commands/display.h"

#include <QLibraryInfo>
#include <QString>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "palpate/core/file_descriptor.h"

namespace palpate::commands {
namespace {

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

// Connects to the X server named by DISPLAY with libxcb, which Qt uses too; without that library
// there can be no X window.
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

// Connects to the socket of the Wayland compositor.
bool waylandAnswers() {
  if (!isSet("WAYLAND_DISPLAY")) return false;
  std::string path = std::getenv("WAYLAND_DISPLAY");
  if (path.front() != '/') {
    if (!isSet("XDG_RUNTIME_DIR")) return false;
    path = std::string(std::getenv("XDG_RUNTIME_DIR")) + "/" + path;
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) return false;
  path.copy(address.sun_path, path.size());
  const FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  return socket.get() >= 0 &&
         ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

// The platform in QT_QPA_PLATFORM without its options: "offscreen" of "offscreen:size=..".
std::string chosenPlatform() {
  if (!isSet("QT_QPA_PLATFORM")) return {};
  const std::string_view chosen(std::getenv("QT_QPA_PLATFORM"));
  return std::string(chosen.substr(0, chosen.find_first_of(":;")));
}

// Checked because Qt ends the process when it finds no plug-in for a platform.
bool hasPlugin(const std::string& platform) {
  const std::string name = platform == "wayland" ? "libqwayland-" : "libq" + platform;
  std::error_code failure;
  const std::filesystem::path folder =
      QLibraryInfo::path(QLibraryInfo::PluginsPath).toStdString() + "/platforms";
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    if (entry.path().filename().string().starts_with(name)) return true;
  return false;
}

}  // namespace

bool hasDisplay() {
  const std::string platform = chosenPlatform();
  if (platform == "xcb") return xServerAnswers();
  if (platform == "wayland" || platform == "wayland-egl")
    return waylandAnswers() && hasPlugin(platform);
  if (!platform.empty()) return hasPlugin(platform);
  return xServerAnswers() || (waylandAnswers() && hasPlugin("wayland"));
}

void drawWithoutDisplay() {
  ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
  // The platform "offscreen" does not support size limits of windows, and Qt prints a warning for
  // each dialog. That warning does not matter for pictures and is suppressed.
  static QtMessageHandler usual = nullptr;
  static const bool once = [] {
    usual = qInstallMessageHandler(
        [](QtMsgType type, const QMessageLogContext& context, const QString& message) {
          if (usual && !message.contains(QLatin1String("propagateSizeHints")))
            usual(type, context, message);
        });
    return true;
  }();
  static_cast<void>(once);
}

RuntimeFolder::RuntimeFolder() {
  if (isSet("XDG_RUNTIME_DIR")) return;
  std::error_code failure;
  std::string pattern = std::filesystem::temp_directory_path(failure) / "palpate-runtime-XXXXXX";
  if (failure || !mkdtemp(pattern.data())) return;  // then Qt prints its warning
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
