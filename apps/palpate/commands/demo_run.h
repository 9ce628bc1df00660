// The whole tour of `palpate demo`, in a folder of its own.
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

// The parts in their order; each runs its steps, and skips those that have nothing to work on. They
// throw Cancelled when the tour shall not go on, report() FileError as well.
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
  std::vector<KnownGrasp> held_;  // the ball first
  std::filesystem::path slipFile_;
  PullTimes pull_;
  std::vector<DemoTruthFrame> truth_;  // of the pen that slips
  Json ballJson_, slipJson_, recognitionJson_;
};

}  // namespace palpate::commands
