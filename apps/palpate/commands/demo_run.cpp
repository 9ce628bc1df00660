#include "commands/demo_run.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/output_file.h"
#include "palpate/core/text_file.h"
#include "palpate/core/time.h"
#include "palpate/emulator/truth.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/characteristic_signals.h"
#include "palpate/slip/slip_rows.h"

#include "commands/commands.h"
#include "commands/demo_pictures.h"
#include "gui/shell/run_window.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

constexpr const char* kDemoModel = "emulated_objects.json";

// A summary of a recording as JSON.
Json demoRecordingJson(const fs::path& file, const Profile& profile, const SignalTable& table) {
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

double secondsIn(const Profile& profile, std::size_t frame) {
  return static_cast<double>(profile.frameTimeUs(frame) - profile.frameTimeUs(0)) / kUsPerS;
}

void writeDemoFile(const fs::path& path, const std::string& text) {
  OutputFile out(path);
  out.write(text);
  out.commit();
}

// The content of a file; empty when it does not exist.
std::string bytesOfDemoFile(const fs::path& path) {
  constexpr std::uint64_t kMostBytes = 64U << 20;
  std::error_code failure;
  return fs::exists(path, failure) ? readTextFile(path, kMostBytes) : std::string();
}

}  // namespace

DemoRun::DemoRun(fs::path folder, DemoContinue goOn)
    : folder_(std::move(folder)), continue_(std::move(goOn)), tour_(continue_) {}

void DemoRun::next(const std::string& name,
                   const std::string& what,
                   const std::function<std::string()>& work) {
  tour_.stepIf(recorded_, "there is no recording", name, what, work);
}

void DemoRun::graspAndRecord() {
  std::optional<DemoGrasps> grasps;
  tour_.step(
      "emulate",
      "Seven emulated hands are switched on, each on two serial ports of its own, and connected "
      "as real ones are.",
      [&] {
        grasps.emplace(dataFolder() / "scenes", folder_, continue_);
        return grasps->emulate();
      });
  const char* why = "a step before it failed";
  tour_.stepIf(
      !failed(),
      why,
      "grasp",
      "Six hands get commands over their ports to close on a ball, a bottle, a box, a foam ball, a "
      "pen and a handle, hold them and open again; between the fingers of the seventh a smooth pen "
      "is pulled upwards.",
      [&] { return grasps->grasp(); });
  tour_.stepIf(!failed(),
               why,
               "record",
               "What they measured is on disk: frames, joint angles, temperatures.",
               [&] { return grasps->finishRecordings(); });
  if (failed()) return;
  recorded_ = true;
  held_ = grasps->held();
  slipFile_ = grasps->slipFile();
  pull_ = grasps->pullTimes();
  truth_ = grasps->truth();
  for (std::size_t i = 0; i < held_.size(); ++i)
    facts_.things.push_back(
        {.object = held_[i].object, .grip = grasps->grips()[i], .picturePng = {}});
}

void DemoRun::lookAtTheBall() {
  const fs::path file = folder_ / "grasp.palpate";
  std::optional<Profile> profile;
  next("replay", "The recording of the ball is played as if it were a hand, and compared.", [&] {
    profile = openRecording(file);
    return replayAndCompare(*profile);
  });
  next("export", "The same recording as a .dsa, the format of the prior program.", [&] {
    if (!profile) profile = openRecording(file);
    const fs::path dsa = folder_ / "grasp.dsa";
    saveRecording(*profile, readEvents(file).events, dsa);
    return std::to_string(openRecording(dsa).numFrames()) + " frames in grasp.dsa";
  });
  next("signals", "Mean, maximum, sum and contact area of every matrix in every frame.", [&] {
    if (!profile) profile = openRecording(file);
    const SignalTable table = SignalTable::of(*profile);
    ballJson_ = demoRecordingJson(file, *profile, table);
    const std::size_t frame = table.frameOfLargestSum();
    double sum = 0.0;
    for (std::size_t m = 0; m < table.numMatrices(); ++m) sum += table.at(frame, m).sum;
    return "the ball is pressed most in frame " + std::to_string(frame) + ", at " +
           fixedText(secondsIn(*profile, frame), 2) + " s: " + fixedText(sum, 0) +
           " counts in all taxels";
  });
}

std::string DemoRun::compareSlip() {
  {
    TruthWriter writer(folder_ / "slip_truth.csv");
    for (const DemoTruthFrame& frame : truth_) writer.add(frame.hostUs, frame.matrices);
    writer.finish();
  }
  const Profile profile = openRecording(slipFile_);
  const SlipSeries series = slipSeries(profile);
  {
    OutputFile out(folder_ / "slip.csv");
    out.write(std::string(kSlipColumns) + "\n");
    SlipRunOptions pass;
    pass.detector = detectorOptions(series.options);
    forEachSlipRow(
        profile, pass, std::nullopt, [&](const std::string& row) { out.write(row + "\n"); });
    out.commit();
  }
  const auto motion = demoMotion(truth_, pull_.pullS, pull_.releaseS);
  if (!motion) throw Error("the pen did not slip through the fingers");
  facts_.pitchMm = profile.layout().matrix(motion->matrix).pitchMm;
  facts_.slip = demoSlip(series, truth_, pull_.pullS, *motion);
  slipJson_ = demoSlipJson(*facts_.slip, facts_.pitchMm);
  const std::string text = demoSlipText(*facts_.slip, facts_.pitchMm);
  if (!facts_.slip->alarm) throw Error(text);
  return text;
}

void DemoRun::findSlip() {
  next("slip",
       "Where the recording of the pulled pen says that it slips, beside what the emulator knows "
       "of the pen.",
       [&] { return compareSlip(); });
}

std::string DemoRun::askWhatWasHeld() {
  const TrainedModel model = loadModel(dataFolder() / kDemoModel);
  facts_.recognition = askModel(model, held_);
  recognitionJson_ = demoRecognitionJson(*facts_.recognition, model, kDemoModel);
  writeDemoFile(folder_ / "recognition.json", recognitionJson_.text() + "\n");
  return demoRecognitionText(*facts_.recognition);
}

void DemoRun::recognise() {
  next("recognition",
       "The model that comes with the program names what was held, from the recordings alone; its "
       "names are compared with what was there.",
       [&] { return askWhatWasHeld(); });
}

std::string DemoRun::drawAll() {
  const DemoPictures pictures;
  pictures.drawWindow(held_.front().file, std::nullopt, {}, folder_ / "window.png");
  std::optional<std::size_t> slipFrame;
  if (facts_.slip && facts_.slip->alarm)
    slipFrame = (facts_.slip->alarm->frame + facts_.slip->alarm->furthestFrame) / 2;
  pictures.drawWindow(slipFile_, slipFrame, {"Slip"}, folder_ / "slip.png");
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const Profile profile = openRecording(held_[i].file);
    facts_.things[i].picturePng =
        pictures.handPng(profile, SignalTable::of(profile).frameOfLargestSum());
  }
  return "window.png and slip.png, " + std::to_string(gui::ScreenshotOptions().size.width()) +
         " x " + std::to_string(gui::ScreenshotOptions().size.height()) +
         " pixels each; the hand in 3-D " + std::to_string(held_.size()) + " times for the page";
}

void DemoRun::draw() {
  next("window",
       "The real window is drawn without a display, on the ball and on the slip; and the hand in "
       "space for each object that was held.",
       [&] { return drawAll(); });
}

std::vector<DemoFile> DemoRun::files() const {
  std::vector<std::pair<std::string, std::string>> known = {
      {"window.png", "the window on the recording of the ball"},
      {"slip.png", "the window on the recording of the slip"},
      {"grasp.palpate", "the recording of the ball"},
      {"grasp.dsa", "the same in the prior program's format"},
      {"grasp.dsa.notes.json", "what was noted in it"}};
  for (const KnownGrasp& recording : held_)
    if (&recording != &held_.front())
      known.emplace_back(recording.file.filename().string(),
                         "the recording of the " + recording.object);
  known.insert(known.end(),
               {{"slip.palpate", "the recording of the pen that slips"},
                {"slip.csv", "how its contacts move, as palpate slip prints it"},
                {"slip_truth.csv", "how the pen moved, as the emulator knows it"},
                {"recognition.json", "what each object was recognised as"},
                {"report.json", "all figures of this page, for programs"}});
  std::vector<DemoFile> there;
  for (const auto& [name, what] : known) {
    std::error_code failure;
    const std::uintmax_t bytes = fs::file_size(folder_ / name, failure);
    if (!failure || name == "report.json") there.push_back({name, what, failure ? 0 : bytes});
  }
  return there;
}

std::string DemoRun::writePage() {
  facts_.version = PALPATE_VERSION;
  facts_.madeAt = utcText(HostTime().nowUs()).substr(0, std::string("2014-11-27 10:31").size());
  facts_.steps = tour_.steps();
  facts_.windowPng = bytesOfDemoFile(folder_ / "window.png");
  facts_.slipPng = bytesOfDemoFile(folder_ / "slip.png");
  facts_.files = files();
  const std::string page = demoPage(facts_);
  writeDemoFile(folder_ / "report.html", page);
  return "report.html, " + fixedText(static_cast<double>(page.size()) / 1e6, 1) +
         " MB with its pictures";
}

void DemoRun::report() {
  tour_.step("report", "This page.", [&] { return writePage(); });
  Json report = Json::object();
  if (!ballJson_.isNull()) report.set("recording", ballJson_);
  if (!slipJson_.isNull()) report.set("slip", slipJson_);
  if (!recognitionJson_.isNull()) report.set("recognition", recognitionJson_);
  Json held = Json::array();
  for (const DemoThing& thing : facts_.things)
    if (thing.grip)
      held.push(Json::object()
                    .set("object", thing.object)
                    .set("fingers", thing.grip->fingers)
                    .set("force_n", thing.grip->forceN));
  report.set("held", held)
      .set("version", PALPATE_VERSION)
      .set("steps", demoStepsJson(tour_.steps()));
  writeDemoFile(folder_ / "report.json", report.text() + "\n");
}

}  // namespace palpate::commands
