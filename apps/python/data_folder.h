// Where the module finds the files that come with Palpate.
#pragma once

#include <filesystem>

namespace palpate::python {

// The folder data: that of $PALPATE_DATA, else that beside the installed module
// (PREFIX/lib/python3/dist-packages), else that of the source tree.
std::filesystem::path dataFolder();

}  // namespace palpate::python
