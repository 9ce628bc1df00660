// Where the program palpate_hdf5 lies, which alone reads HDF5 files (docs/architecture.md, "Three
// executables").
#pragma once

#include <filesystem>

namespace palpate {

// Beside this program or this module of Python, in the folder of a build that they lie in, or in
// libexec of their installation. Where there is none, the place beside this program.
std::filesystem::path hdf5Program();
// Lets another program take its place, for tests; empty: none does. Not while files are opened.
void setHdf5Program(const std::filesystem::path& program);

}  // namespace palpate
