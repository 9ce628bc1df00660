// Runs all parts of `palpate demo` and writes their results into a new folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "palpate/core/json.h"

#include "commands/demo_grasps.h"
#include "commands/demo_page.h"
#include "commands/demo_tour.h"

namespace palpate::commands {

// Call the parts in this order. Each runs its steps and skips those whose input is missing. They
// throw Cancelled when the demo does not continue; report() also throws FileError.
class DemoRun {
 public:
  DemoRun(std::filesystem::path folder, DemoContinue goOn);

  void graspAndRecord();
  void lookAtTheBall();
  void findSlip();
  void recognise();
  void draw();
  void report();
  bool failed() const noexcept { return tour_.failed(); }

 private:
  void next(const std::string& name,
            const std::string& what,
            const std::function<std::string()>& work);
  std::string compareSlip();
  std::string askWhatWasHeld();
  std::string drawAll();
  std::string writePage();
  std::vector<DemoFile> files() const;

  const std::filesystem::path folder_;
  const DemoContinue continue_;
  DemoTour tour_;
  DemoFacts facts_;
  bool recorded_ = false;
  // The held objects; the ball is the first.
  std::vector<KnownGrasp> held_;
  std::filesystem::path slipFile_;
  PullTimes pull_;
  // The emulator's true values of the slipping pen.
  std::vector<DemoTruthFrame> truth_;
  Json ballJson_, slipJson_, recognitionJson_;
};

}  // namespace palpate::commands
