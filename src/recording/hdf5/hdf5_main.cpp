// palpate_hdf5: reads one HDF5 file for another program of Palpate, which has started it
// (hdf5_process.h) and passes a socket and the open file.
#include <unistd.h>

#include "palpate/core/child_program.h"

#include "recording/hdf5/hdf5_answers.h"

int main() {
  const int code =
      palpate::serveHdf5(palpate::ChildProgram::kPassedAs, palpate::ChildProgram::kPassedAs + 1);
  // Without closing the file: that would be the library's work once more.
  ::_exit(code);
}
