// Where the program palpate_hdf5 lies, which alone reads HDF5 files (docs/architecture.md, "Three
// executables").
#pragma once

#include <filesystem>

namespace palpate {

// hdf5ProgramOf() this program, or this module of Python.
std::filesystem::path hdf5Program();
// Beside `binary`, in the folder of the build that it lies in, or in libexec of the installation
// whose bin or Python folder it lies in. Where there is none, the place beside it. No other folder
// is searched, since anybody could have put a program there.
std::filesystem::path hdf5ProgramOf(const std::filesystem::path& binary);
// Lets another program take its place, for tests; empty: none does. Not while files are opened.
void setHdf5Program(const std::filesystem::path& program);

}  // namespace palpate
