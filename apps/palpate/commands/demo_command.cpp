// The command `palpate demo -o DIR` shows without a window what the program can do; it prints one
// line for each step.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/core/output_file.h"
#include "palpate/core/parallel.h"
#include "palpate/emulator/simulated_recording.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/demo_hand.h"
#include "commands/demo_truth.h"
#include "commands/display.h"
#include "gui/shell/run_window.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

struct HeldObject {
  const char* scene;  // of data/scenes
  const char* object;
  const char* recording;
  double closingDegPerS;  // as in the script of the scene
};
// The five objects that the model was trained with, and a handle that it does not know.
constexpr std::array<HeldObject, 6> kHeldObjects = {{
    {"ball", "ball", "grasp", 30.0},
    {"bottle", "bottle", "bottle", 25.0},
    {"box", "box", "box", 30.0},
    {"foam_ball", "foam ball", "foam_ball", 30.0},
    {"pen", "pen", "pen", 30.0},
    {"slipping_handle", "handle", "handle", 30.0},
}};
// Seed of the object placements; scripts/make_emulated_model uses other seeds.
constexpr std::uint64_t kFirstPlacement = 900;
constexpr double kOpenS = 1.2;

// Creates a new folder: `wanted`, or wanted-2, wanted-3, .. if that exists.
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

// The steps; each returns its figure, and an exception of it marks it as failed. Prints "NAME:
// ok|skipped|failed, FIGURE" for each.
class DemoTour {
 public:
  DemoTour(fs::path folder, DemoContinue goOn)
      : folder_(std::move(folder)), continue_(std::move(goOn)) {}

  // Runs all steps and writes report.json; returns whether all succeeded. Throws Cancelled when the
  // tour does not continue, and FileError.
  bool run() {
    const std::string before = "a step before it failed";
    step("emulate", "Seven emulated hands are connected as real ones.", &DemoTour::emulate, before);
    step("grasp", "Six close on an object; the seventh's pen is pulled.", &DemoTour::grasp, before);
    step("record", "What they measured is on disk.", &DemoTour::record, "there is no recording");
    hands_.clear();
    step("replay", "The ball's recording is played as a hand and compared.", &DemoTour::replay);
    step("export", "The same recording as a .dsa.", &DemoTour::exportBall);
    step("slip",
         "Where the recorded pen slips, compared with its true motion.",
         &DemoTour::findSlip);
    step("recognition", "A model names the objects from the recordings.", &DemoTour::recognise);
    step("window", "The window is drawn without a display, on the ball.", &DemoTour::drawWindow);
    report_.set("held", grips_).set("version", PALPATE_VERSION).set("steps", steps_);
    OutputFile out(folder_ / "report.json");
    out.write(report_.text() + "\n");
    out.commit();
    return !failed_;
  }

 private:
  void step(const std::string& name,
            const std::string& what,
            std::string (DemoTour::*work)(),
            const std::string& elseSkipped = {}) {
    std::string outcome = "skipped", figure = skipped_;
    if (skipped_.empty()) {
      if (!continue_()) throw Cancelled();
      try {
        figure = (this->*work)();
        outcome = "ok";
      } catch (const Cancelled&) {
        throw;
      } catch (const std::exception& error) {
        figure = error.what();
        outcome = "failed";
        failed_ = true;
      }
    }
    figure = escapedLine(figure);
    std::printf("%s: %s, %s\n", name.c_str(), outcome.c_str(), figure.c_str());
    std::fflush(stdout);
    steps_.push(Json::object()
                    .set("step", name)
                    .set("what", what)
                    .set("outcome", outcome)
                    .set("figure", figure));
    if (failed_ && !elseSkipped.empty()) skipped_ = elseSkipped;
    if (!continue_()) throw Cancelled();
  }

  void onEachHand(const std::function<void(std::size_t index)>& work) const {
    forEachInParallel(hands_.size(), work, {}, hands_.size());
  }

  std::string emulate() {
    const fs::path scenes = dataFolder() / "scenes";
    std::uint64_t placement = kFirstPlacement;
    for (const HeldObject& each : kHeldObjects) {
      Scene scene = variedScene(loadScene(each.scene, scenes), {}, placement++);
      scene.script.clear();  // this hand is moved over its port instead
      held_.push_back({folder_ / (std::string(each.recording) + ".palpate"), each.object});
      hands_.push_back(std::make_unique<DemoHand>(scene, each.object, continue_));
    }
    // Its script: grasp, pull, no pull, release.
    const Scene slipping = loadScene("slipping_pen", scenes);
    pullS_ = slipping.script.at(1).atS;
    releaseS_ = slipping.script.at(3).atS;
    hands_.push_back(std::make_unique<DemoHand>(slipping, "pen that slips", continue_));
    std::vector<DeviceInfo> infos(hands_.size());
    onEachHand([&](std::size_t i) {
      infos[i] = hands_[i]->record(i < held_.size() ? held_[i].file : folder_ / "slip.palpate");
    });
    return std::to_string(hands_.size()) + " hands answer on " + std::to_string(2 * hands_.size()) +
           " ports, tactile firmware " + infos.front().firmware + ", motion firmware " +
           infos.front().motionFirmware;
  }

  std::string grasp() {
    std::vector<Json> grips(held_.size());
    onEachHand([&](std::size_t i) {
      if (i < grips.size())
        grips[i] = hands_[i]->grasp(kHeldObjects[i].closingDegPerS);
      else
        hands_[i]->playScript(releaseS_ + kOpenS);
    });
    grips_ = jsonList(grips);
    std::string text = std::to_string(grips.size()) + " objects held:";
    for (std::size_t i = 0; i < grips.size(); ++i)
      text += (i == 0 ? " " : ", ") + held_[i].object + " " +
              fixedText(grips[i].at("force_n").asDouble(), 0) + " N";
    return text + "; another pen was pulled at";
  }

  std::string record() {
    std::vector<RecordingReport> reports(hands_.size());
    onEachHand([&](std::size_t i) { reports[i] = hands_[i]->finishRecording(); });
    truth_ = hands_.back()->truth();
    std::int64_t frames = 0, angles = 0, lost = 0;
    for (const RecordingReport& each : reports) {
      frames += each.frames;
      angles += each.angles;
      lost += each.counter("lost") + each.lost;
    }
    const auto [slowest, fastest] =
        std::ranges::minmax_element(reports, {}, &RecordingReport::meanRateHz);
    const std::string least = fixedText(slowest->meanRateHz, 1);
    const std::string most = fixedText(fastest->meanRateHz, 1);
    return std::to_string(reports.size()) + " recordings, " + std::to_string(frames) +
           " frames at " + (least == most ? least : least + " to " + most) + " Hz, " +
           std::to_string(angles) + " samples of the joint angles, " + std::to_string(lost) +
           " frames lost";
  }

  std::string replay() {
    const Profile profile = openRecording(held_.front().file);
    const TimingReport timing = timingOf(profile);
    report_.set("recording",
                Json::object()
                    .set("frames", profile.numFrames())
                    .set("duration_s", timing.durationS)
                    .set("rate_hz", timing.rateHz));
    return replayAndCompare(profile);
  }

  std::string exportBall() {
    const fs::path file = held_.front().file, dsa = folder_ / "grasp.dsa";
    const Recording recording = readRecording(file);
    recording.requireEvents();
    saveRecording(recording.profile, recording.events, dsa);
    return std::to_string(openRecording(dsa).numFrames()) + " frames in grasp.dsa";
  }

  std::string findSlip() {
    const Profile profile = openRecording(folder_ / "slip.palpate");
    const DemoFinding slip =
        compareSlip(slipSeries(profile), profile.layout(), truth_, pullS_, releaseS_);
    report_.set("slip", slip.json);
    if (!slip.json.at("seen").asBool()) throw Error(slip.text);
    return slip.text;
  }

  std::string recognise() {
    const DemoFinding asked = askModel(loadModel(dataFolder() / "emulated_objects.json"), held_);
    report_.set("recognition", asked.json);
    return asked.text;
  }

  std::string drawWindow() {
    const RuntimeFolder runtime;
    drawWithoutDisplay();
    gui::ScreenshotOptions options;
    options.out = folder_ / "window.png";
    options.file = held_.front().file;
    options.dataFolder = dataFolder();
    std::string name = "palpate";
    char* arguments[] = {name.data(), nullptr};
    int count = 1;
    gui::takeScreenshot(count, arguments, options);
    return "window.png, " + std::to_string(options.size.width()) + " x " +
           std::to_string(options.size.height()) + " pixels";
  }

  const fs::path folder_;
  const DemoContinue continue_;
  bool failed_ = false;
  // Why the next steps are skipped; empty: they are not.
  std::string skipped_;
  Json report_ = Json::object(), steps_ = Json::array(), grips_ = Json::array();
  // The ball is the first.
  std::vector<KnownGrasp> held_;
  // One for each held object, and one between whose fingers a pen slips.
  std::vector<std::unique_ptr<DemoHand>> hands_;
  // When the script pulls at the pen and opens the fingers [s since the hand was switched on].
  double pullS_ = 0.0, releaseS_ = 0.0;
  // The emulator's true values of the slipping pen.
  std::vector<DemoTruthFrame> truth_;
};

void sayWhatIsNext(const fs::path& folder, bool failed) {
  const std::string in = escapedLine(folder.string());
  const std::string text =
      failed
          ? "A step failed; the results so far are in " + in + ", see " + in + "/report.json."
          : "\nLook at next:\n  " + in + "/report.json    all figures, for programs\n  " + in +
                "/window.png     the window on the grasp of the ball\nOn a display, 'palpate " +
                in + "/grasp.palpate' opens that window, 'palpate --demo' one on an emulated hand.";
  std::puts(text.c_str());
}

}  // namespace

int demoCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate demo -o DIR",
       .purpose = "Runs a tour on emulated hands without a window, in about 15 seconds. Six hands "
                  "grasp an object each, and a pen slips between the fingers of a seventh. The "
                  "tour records them over their ports, replays and exports the recordings, detects "
                  "the slip, recognises the objects and compares the answers with the truth, draws "
                  "the window, and writes all figures to report.json. It writes into DIR, or into "
                  "DIR-2, DIR-3, .. if DIR exists, and prints a line per step: ok, skipped or "
                  "failed, and a figure. Ctrl-C ends the tour and removes the folder that it made.",
       .options = {{"output,o", "DIR", "folder to make, default palpate-demo"}},
       .example = "palpate demo -o tour",
       .maxArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  const fs::path folder = makeDemoFolder(given.text("output").value_or("palpate-demo"));
  Interruption interruption;  // before the first thread starts
  std::atomic<bool> interrupted = false;
  const DemoContinue goOn = [&] {
    if (interruption.waitForSignal(0)) interrupted = true;
    return !interrupted.load();
  };
  bool failed = false;
  try {
    if (!given.quiet()) {
      std::puts("A tour on emulated hands: no real one is touched.");
      std::fflush(stdout);
    }
    failed = !DemoTour(folder, goOn).run();
  } catch (const Cancelled&) {
    // The tour created this folder, so that everything in it can be removed.
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw Error("interrupted: the files of the tour were removed");
  }
  if (!given.quiet()) sayWhatIsNext(folder, failed);
  return failed ? kFailed : kDone;
}

}  // namespace palpate::commands
