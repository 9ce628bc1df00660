#include "commands/start_window_program.h"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate::commands {
namespace fs = std::filesystem;

bool needsHdf5(const Arguments& words) {
  for (const std::string& word : words) {
    std::string last = word.substr(word.find('=') + 1);
    std::transform(last.begin(), last.end(), last.begin(), [](unsigned char letter) {
      return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a')
                                            : static_cast<char>(letter);
    });
    if (last == "h5" || last == "hdf5" || last.ends_with(".h5") || last.ends_with(".hdf5"))
      return true;
  }
  return false;
}

fs::path windowProgramOf(const fs::path& program) {
  const fs::path folder = program.parent_path();
  const fs::path installed = fs::path(PALPATE_INSTALLED_WINDOW);
  const fs::path built = folder / installed.filename();
  std::error_code ignored;
  return fs::exists(built, ignored) ? built : folder.parent_path() / installed;
}

int startWindowProgram(const std::string& name, const Arguments& words) {
  std::error_code ignored;
  const fs::path program = windowProgramOf(fs::read_symlink("/proc/self/exe", ignored));
  Arguments all = {"palpate"};
  if (!name.empty()) all.push_back(name);
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  throw FileError(program,
                  "the part of palpate with the window and this command can't be started: " +
                      std::generic_category().message(errno) + "; install palpate again");
}

}  // namespace palpate::commands
