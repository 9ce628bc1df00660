// palpate_window: the window and all commands; palpate starts it.
#include "commands/commands.h"
#include "commands/window_commands.h"

int main(int argc, char** argv) {
  return palpate::commands::run(argc, argv, &palpate::commands::runWindowCommand);
}
