#include "python/data_folder.h"

#include <cstdlib>
#include <system_error>

#include <dlfcn.h>

namespace palpate::python {
namespace fs = std::filesystem;

fs::path dataFolder() {
  if (const char* given = std::getenv("PALPATE_DATA"); given && *given) return given;
  Dl_info self{};
  if (dladdr(reinterpret_cast<const void*>(&dataFolder), &self) != 0 && self.dli_fname) {
    std::error_code ignored;
    const fs::path module = fs::canonical(self.dli_fname, ignored);
    const fs::path prefix = module.parent_path().parent_path().parent_path().parent_path();
    const fs::path installed = prefix / PALPATE_INSTALLED_DATA;
    if (fs::is_directory(installed, ignored)) return installed;
  }
  return PALPATE_BUILD_DATA;
}

}  // namespace palpate::python
