#include "commands/start_window_program.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate::commands {
namespace fs = std::filesystem;

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
