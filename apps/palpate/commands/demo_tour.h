// The list of steps of `palpate demo`: each step runs, prints its line, and is stored for the
// report.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "palpate/core/json.h"

#include "commands/demo_hand.h"
#include "commands/demo_page.h"

namespace palpate::commands {

// Creates a new folder: `wanted`, or wanted-2, wanted-3, .. if that exists. Throws FileError when
// it cannot be created.
std::filesystem::path makeDemoFolder(std::filesystem::path wanted);

// Prints "NAME: ok|skipped|failed, FIGURE" for each step.
class DemoTour {
 public:
  explicit DemoTour(DemoContinue goOn) : continue_(std::move(goOn)) {}

  // Runs a step. `work` returns the text of the result; an exception of it marks the step as
  // failed. Throws Cancelled when the demo does not continue.
  void step(const std::string& name,
            const std::string& what,
            const std::function<std::string()>& work);
  // Runs the step if `ready`; otherwise the step is skipped with the reason `why`.
  void stepIf(bool ready,
              const std::string& why,
              const std::string& name,
              const std::string& what,
              const std::function<std::string()>& work);
  bool failed() const noexcept { return failed_; }
  const std::vector<DemoStep>& steps() const noexcept { return steps_; }

 private:
  void say(DemoStep step);

  DemoContinue continue_;
  std::vector<DemoStep> steps_;
  bool failed_ = false;
};

Json demoStepsJson(const std::vector<DemoStep>& steps);

}  // namespace palpate::commands
