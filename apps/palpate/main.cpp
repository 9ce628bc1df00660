// palpate: one program for the window and the commands. What needs a window, OpenCV, Ceres or HDF5
// is in palpate_window, which this process becomes then.
#include "commands/commands.h"
#include "commands/start_window_program.h"

int main(int argc, char** argv) {
  return palpate::commands::run(
      argc, argv, &palpate::commands::startWindowProgram, &palpate::commands::needsHdf5);
}
