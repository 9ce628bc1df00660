#include "commands/demo_tour.h"

#include <cstdio>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate::commands {
namespace fs = std::filesystem;

fs::path makeDemoFolder(fs::path wanted) {
  // "tour/" means "tour".
  if (!wanted.has_filename()) wanted = wanted.parent_path();
  fs::path folder = wanted;
  for (int number = 2;; ++number) {
    std::error_code failure;
    if (fs::create_directory(folder, failure)) return folder;
    if (failure && failure != std::errc::file_exists)
      throw FileError(folder, "can't be created: " + failure.message());
    folder = wanted.string() + "-" + std::to_string(number);
  }
}

void DemoTour::say(DemoStep step) {
  step.figure = escapedLine(step.figure);
  std::printf("%s: %s, %s\n", step.name.c_str(), step.outcome.c_str(), step.figure.c_str());
  std::fflush(stdout);
  steps_.push_back(std::move(step));
}

void DemoTour::step(const std::string& name,
                    const std::string& what,
                    const std::function<std::string()>& work) {
  if (!continue_()) throw Cancelled();
  try {
    say({name, what, "ok", work()});
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    failed_ = true;
    say({name, what, "failed", error.what()});
  }
  if (!continue_()) throw Cancelled();
}

void DemoTour::stepIf(bool ready,
                      const std::string& why,
                      const std::string& name,
                      const std::string& what,
                      const std::function<std::string()>& work) {
  if (ready)
    step(name, what, work);
  else
    say({name, what, "skipped", why});
}

Json demoStepsJson(const std::vector<DemoStep>& steps) {
  return jsonList(steps, [](const DemoStep& step) {
    return Json::object()
        .set("step", step.name)
        .set("what", step.what)
        .set("outcome", step.outcome)
        .set("figure", step.figure);
  });
}

}  // namespace palpate::commands
