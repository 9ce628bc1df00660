#include "commands/window_commands.h"

#include <stdexcept>
#include <string_view>
#include <utility>

namespace palpate::commands {

int runWindowCommand(const std::string& name, const Arguments& words) {
  using Function = int (*)(const Arguments&);
  static constexpr std::pair<std::string_view, Function> kCommands[] = {
      {"", &windowCommand},
      {"adapt", &adaptCommand},
      {"calibrate", &calibrateCommand},
      {"classify", &classifyCommand},
      {"compare", &compareCommand},
      {"contact", &contactCommand},
      {"demo", &demoCommand},
      {"derive", &deriveCommand},
      {"emulate", &emulateCommand},
      {"evaluate", &evaluateCommand},
      {"grasp", &graspCommand},
      {"help", &columnsCommand},  // columns, commands
      {"import", &importCommand},
      {"record", &recordCommand},
      {"render", &renderCommand},
      {"spectrum", &spectrumCommand},
      {"step-benchmark", &stepBenchmarkCommand},
      {"stream", &streamCommand},
      {"train", &trainCommand},
  };
  for (const auto& [known, function] : kCommands)
    if (name == known) return function(words);
  throw std::logic_error("no program has the command " + name);
}

}  // namespace palpate::commands
