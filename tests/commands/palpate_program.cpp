#include "commands/palpate_program.h"

#include <memory>
#include <utility>

#include "commands/commands.h"
#include "commands/window_commands.h"
#include "testing/warm_program.h"

namespace palpate::testing {
namespace {

std::unique_ptr<WarmProgram> warmPalpate;

int palpateMain(int argc, char** argv) {
  return commands::run(argc, argv, &commands::runWindowCommand);
}

class WarmPalpate : public ::testing::Environment {
 public:
  void SetUp() override { warmPalpate = std::make_unique<WarmProgram>("palpate", &palpateMain); }
  void TearDown() override { warmPalpate.reset(); }
};

[[maybe_unused]] const auto* const kEnvironment =
    ::testing::AddGlobalTestEnvironment(new WarmPalpate);

template <typename Run>
ProgramResult withOwnFolders(std::map<std::string, std::string> environment, const Run& run) {
  const TemporaryFolder home;  // the user's own settings are never touched
  for (const char* variable : {"XDG_CONFIG_HOME",
                               "XDG_DATA_HOME",
                               "XDG_STATE_HOME",
                               "XDG_CACHE_HOME",
                               "XDG_RUNTIME_DIR",
                               "HOME"})
    environment.try_emplace(variable, home.path().string());
  return run(environment);
}

}  // namespace

ProgramResult startedPalpate(const std::vector<std::string>& arguments,
                             std::map<std::string, std::string> environment) {
  return withOwnFolders(std::move(environment), [&](const auto& all) {
    return runProgram(PALPATE_PROGRAM, arguments, all);
  });
}

ProgramResult palpate(const std::vector<std::string>& arguments,
                      std::map<std::string, std::string> environment) {
#ifdef __SANITIZE_ADDRESS__
  return startedPalpate(arguments, std::move(environment));  // leaks are looked for at its end
#else
  return withOwnFolders(std::move(environment),
                        [&](const auto& all) { return warmPalpate->run(arguments, all); });
#endif
}

}  // namespace palpate::testing
