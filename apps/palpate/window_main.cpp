// palpate_window: the window and all commands; palpate starts it. It moves hands, so it stops them
// when it dies.
#include <filesystem>
#include <system_error>

#include <palpate/device/last_stop.h>

#include "commands/commands.h"
#include "commands/window_commands.h"

int main(int argc, char** argv) {
  std::error_code ignored;
  palpate::stopHandsInACrash();
  palpate::stopHandsWhenKilled(
      std::filesystem::read_symlink("/proc/self/exe", ignored).replace_filename("palpate_stop"));
  return palpate::commands::run(argc, argv, &palpate::commands::runWindowCommand);
}
