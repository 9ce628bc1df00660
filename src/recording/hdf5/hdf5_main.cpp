// palpate_hdf5: reads one HDF5 file for another program of Palpate, which has started it
// (hdf5_process.h) and passes a socket and the open file.
#include <unistd.h>

#include "palpate/core/child_program.h"
#include "palpate/core/number_text.h"

#include "recording/hdf5/hdf5_answers.h"

int main(int argc, char** argv) {
  const auto requestCpuMs = palpate::parseInteger(argc == 2 ? argv[1] : "");
  if (!requestCpuMs || *requestCpuMs < 1) return 2;
  const int code = palpate::serveHdf5(palpate::ChildProgram::kPassedAs,
                                      palpate::ChildProgram::kPassedAs + 1,
                                      std::chrono::milliseconds(*requestCpuMs));
  // Without closing the file: that would be the library's work once more.
  ::_exit(code);
}
