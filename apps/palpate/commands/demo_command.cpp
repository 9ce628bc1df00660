// palpate demo -o DIR: a headless tour over what the program can do, a line per step.
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/output_file.h"
#include "palpate/filter/characteristic_signals.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/demo_hand.h"
#include "commands/display.h"
#include "gui/workbench.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

// DIR, else DIR-2, DIR-3, ..: a tour never writes into a folder that exists.
fs::path makeFolder(fs::path wanted) {
  if (!wanted.has_filename()) wanted = wanted.parent_path();  // "tour/" is "tour"
  fs::path folder = wanted;
  for (int number = 2;; ++number) {
    std::error_code failure;
    if (fs::create_directory(folder, failure)) return folder;
    if (failure && failure != std::errc::file_exists)
      throw FileError(folder, "can't be made: " + failure.message());
    folder = wanted.string() + "-" + std::to_string(number);
  }
}

// Runs steps, prints `step: ok|skipped|failed, figure` and keeps the lines for the report.
class Tour {
 public:
  // A step returns its figure; what it throws makes it failed.
  void step(const std::string& name, const std::function<std::string()>& work) {
    try {
      say(name, "ok", work());
    } catch (const std::exception& error) {
      failed_ = true;
      say(name, "failed", error.what());
    }
  }
  void skip(const std::string& name, const std::string& why) { say(name, "skipped", why); }
  bool failed() const noexcept { return failed_; }
  const Json& steps() const noexcept { return steps_; }

 private:
  void say(const std::string& name, const std::string& outcome, const std::string& figure) {
    std::printf("%s: %s, %s\n", name.c_str(), outcome.c_str(), figure.c_str());
    std::fflush(stdout);
    steps_.push(Json::object().set("step", name).set("outcome", outcome).set("figure", figure));
  }

  Json steps_ = Json::array();
  bool failed_ = false;
};

// What the recording holds, in numbers.
Json recordingReport(const fs::path& file, const Profile& profile, const SignalTable& table) {
  const TimingReport timing = timingOf(profile);
  Json matrices = Json::array();
  for (std::size_t m = 0; m < table.numMatrices(); ++m) {
    double maximum = 0.0;
    int active = 0;
    for (std::size_t i = 0; i < table.numFrames(); ++i) {
      maximum = std::max(maximum, table.at(i, m).maximum);
      active = std::max(active, table.at(i, m).active);
    }
    matrices.push(Json::object()
                      .set("name", profile.hand().matrixName(m))
                      .set("max_value", maximum)
                      .set("most_active_taxels", active));
  }
  return Json::object()
      .set("file", file.filename().string())
      .set("frames", profile.numFrames())
      .set("duration_s", timing.durationS)
      .set("rate_hz", timing.rateHz)
      .set("gaps", timing.gaps.size())
      .set("joint_angles", profile.numAngles())
      .set("temperatures", profile.numTemperatures())
      .set("frame_of_largest_sum", table.frameOfLargestSum())
      .set("matrices", matrices);
}

}  // namespace

int demoCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate demo -o DIR",
       .purpose = "A headless tour: starts an emulated hand, connects to its ports, records while "
                  "it grasps "
                  "a ball,\nreplays and exports the recording, reports what is in it and draws the "
                  "window, "
                  "into DIR\n(DIR-2, DIR-3, .. when it exists). A line per step: ok, skipped or "
                  "failed, and "
                  "a figure.\nSteps that this version does not have yet are skipped.",
       .options = {{"output,o", "DIR", "folder to make, default palpate-demo"}},
       .example = "palpate demo -o tour",
       .mostWords = 0},
      words);
  if (given.helpShown()) return kDone;
  const fs::path folder = makeFolder(given.text("output").value_or("palpate-demo"));
  const fs::path file = folder / "grasp.palpate";

  Tour tour;
  std::optional<Profile> profile;
  std::optional<SignalTable> table;
  Json report = Json::object();
  {
    std::unique_ptr<DemoHand> hand;
    tour.step("emulate", [&] {
      hand = std::make_unique<DemoHand>(dataFolder() / "scenes");
      return hand->connect();
    });
    // Each step needs the one before.
    const auto next = [&](const std::string& name, const std::function<std::string()>& work) {
      if (tour.failed()) return tour.skip(name, "a step before it failed");
      tour.step(name, work);
    };
    next("grasp", [&] {
      hand->startRecording(file);
      return hand->grasp();
    });
    next("record", [&] { return hand->finishRecording(); });
  }
  const auto next = [&](const std::string& name, const std::function<std::string()>& work) {
    if (!fs::exists(file) || (name != "replay" && !profile))
      return tour.skip(name, "there is no recording");
    tour.step(name, work);
  };
  next("replay", [&] {
    profile = openRecording(file);
    return replayAndCompare(*profile);
  });
  next("export", [&] {
    const fs::path dsa = folder / "grasp.dsa";
    saveRecording(*profile, readEvents(file).events, dsa);
    return std::to_string(openRecording(dsa).numFrames()) + " frames in grasp.dsa";
  });
  next("signals", [&] {
    table = SignalTable::of(*profile);
    report.set("recording", recordingReport(file, *profile, *table));
    const std::size_t frame = table->frameOfLargestSum();
    return "largest sum in frame " + std::to_string(frame);
  });
  next("window", [&] {
    gui::ScreenshotOptions options;
    options.out = folder / "window.png";
    options.file = file;
    options.dataFolder = dataFolder();
    const RuntimeFolder runtime;
    drawWithoutDisplay();
    std::string name = "palpate";
    char* arguments[] = {name.data(), nullptr};
    int count = 1;
    if (gui::takeScreenshot(count, arguments, options) != kDone) throw Error("no picture");
    return std::to_string(fs::file_size(options.out)) + " bytes of window.png";
  });
  for (const char* step : {"slip", "recognition"}) tour.skip(step, "comes in a later version");

  report.set("version", PALPATE_VERSION).set("steps", tour.steps());
  OutputFile out(folder / "report.json");
  out.write(report.text() + "\n");
  out.commit();
  if (!given.quiet()) std::printf("written to %s\n", folder.c_str());
  return tour.failed() ? kFailed : kDone;
}

}  // namespace palpate::commands
