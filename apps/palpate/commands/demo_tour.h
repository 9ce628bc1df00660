// The steps of `palpate demo`: each runs, prints its line, and is kept for the report.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "palpate/core/json.h"

#include "commands/demo_hand.h"
#include "commands/demo_page.h"

namespace palpate::commands {

// A folder that did not exist: `wanted`, else wanted-2, wanted-3, .. Throws FileError: it can't be
// made.
std::filesystem::path makeDemoFolder(std::filesystem::path wanted);

// Prints "NAME: ok|skipped|failed, FIGURE" for each step.
class DemoTour {
 public:
  explicit DemoTour(DemoContinue goOn) : continue_(std::move(goOn)) {}

  // `work` returns the figure; what it throws makes the step failed. Throws Cancelled when the tour
  // shall not go on.
  void step(const std::string& name,
            const std::string& what,
            const std::function<std::string()>& work);
  // Only where `ready`; else the step is skipped, because `why`.
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
