// palpate_window: the window and all commands; palpate starts it. It moves hands, so it stops them
// when it dies.
#include <filesystem>
#include <system_error>

#include <palpate/device/last_stop.h>

#include "commands/commands.h"
#include "commands/window_commands.h"

int main(int argc, char** argv) {
  std::error_code failed;
  palpate::stopHandsInACrash();
  // Without /proc the path can't be known; one that doesn't exist is reported as such.
  std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) self = "/palpate_window";
  palpate::stopHandsWhenKilled(self.replace_filename("palpate_stop"));
  return palpate::commands::run(argc, argv, &palpate::commands::runWindowCommand);
}
