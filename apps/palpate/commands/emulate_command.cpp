// The command `palpate emulate` runs the emulated hand on two ports until it is interrupted.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/emulator/replayed_hand.h"
#include "palpate/emulator/scene.h"
#include "palpate/emulator/truth.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

void setRate(const std::string& text, EmulatedHandOptions& options) {
  if (text == "real") {
    options.rate = EmulationRate::kReal;
  } else if (text == "max") {
    options.rate = EmulationRate::kMax;
  } else {
    const auto hz = parseDouble(text);
    if (!hz || *hz < 0.1 || *hz > 1000.0)
      throw UsageError("--rate must be real, max or a number 0.1..1000, not '" + text + "'");
    options.rate = EmulationRate::kFixed;
    options.hz = *hz;
  }
}

EmulatedHandOptions emulateOptionsOf(const CommandLine& given) {
  EmulatedHandOptions options;
  options.dsaPort = given.text("dsa").value_or("");
  options.sdhPort = given.text("sdh").value_or("");
  if (!options.dsaPort.empty() && options.dsaPort == options.sdhPort &&
      !options.dsaPort.starts_with("tcp:"))
    throw UsageError("--dsa and --sdh need different names");
  if (const auto rate = given.text("rate")) setRate(*rate, options);
  options.seed = static_cast<std::uint64_t>(given.integer("seed", 0, UINT32_MAX).value_or(1));
  options.dsa.firmware =
      static_cast<std::uint16_t>(given.integer("dsa-firmware", 1, 0xFFFF).value_or(0x2900));
  if (const auto firmware = given.text("sdh-firmware")) options.sdh.firmware = *firmware;
  try {
    options.faults = parseFaults(given.text("faults").value_or(""));
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--faults: ") + error.what());
  }
  return options;
}

std::unique_ptr<HandModel> modelOf(const CommandLine& given, std::uint64_t seed) {
  if (const auto recording = given.text("replay"))
    return std::make_unique<ReplayedHand>(openRecording(*recording));
  const Scene scene = loadScene(given.text("scene").value_or("empty"), dataFolder() / "scenes");
  PhysicalHandOptions options;
  options.seed = seed;
  return std::make_unique<PhysicalHand>(scene, options);
}

CommandSpec emulateSpec() {
  return {.synopsis = "palpate emulate [--dsa LINK] [--sdh LINK] [--scene NAME|FILE.json] ..",
          .purpose =
              "An emulated hand: both controllers speak their protocols on two pseudo-terminals "
              "(or TCP ports of this\nmachine). Prints one line 'dsa=PATH sdh=PATH' when it is "
              "ready, and runs until it is interrupted.",
          .options =
              {{"dsa", "LINK", "name for the tactile port; tcp:127.0.0.1:PORT for TCP (0: any)"},
               {"sdh", "LINK", "name for the motion port"},
               {"scene", "NAME|FILE.json", "objects and events around the hand; default empty"},
               {"replay", "FILE", "plays a recording: each frame once, then nothing"},
               {"faults",
                "SPEC",
                "faults to simulate: crc=RATE,drop=RATE,insert=RATE,stall=S@AT,unplug=S@AT,"
                "junk_start=BYTES,boot=S"},
               {"truth", "OUT.csv", "write true contacts, forces and slip of each frame"},
               {"rate",
                "real|max|HZ",
                "real: a serial line at 115200 baud (default); HZ: frames per second, "
                "0.1..1000; max: as fast as the client reads"},
               {"seed", "N", "seed of noise and faults, default 1"},
               {"dsa-firmware", "N", "firmware of the tactile controller, default 10496 (2.9.0.0)"},
               {"sdh-firmware", "TEXT", "firmware of the motion controller, default 0.0.3.3"},
               {"force", "", "replace OUT.csv"}},
          .example = "palpate emulate --dsa /tmp/dsa --sdh /tmp/sdh --scene ball",
          .maxArguments = 0};
}

// Waits for a signal. Throws when the emulated hand stops by itself.
void waitForEnd(const EmulatedHand& hand, Interruption& interruption) {
  constexpr int kLookMs = 200;
  while (!interruption.waitForSignal(kLookMs))
    if (const std::string failure = hand.counts().failure; !failure.empty())
      throw std::runtime_error("the emulated hand has stopped: " + failure);
}

}  // namespace

int emulateCommand(const Arguments& words) {
  const CommandLine given(emulateSpec(), words);
  if (given.helpShown()) return kDone;
  if (given.has("replay") && given.has("scene"))
    throw UsageError("--replay and --scene can't be used together");
  if (given.has("replay") && given.has("truth"))
    throw UsageError("--truth needs a scene: a recording has no known truth");
  const EmulatedHandOptions options = emulateOptionsOf(given);
  std::unique_ptr<HandModel> model = modelOf(given, options.seed);
  std::unique_ptr<TruthWriter> truth;
  if (const auto path = given.text("truth"))
    truth = std::make_unique<TruthWriter>(
        *path, given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse);
  FrameObserver observer;
  if (truth)
    observer = [&truth](const EmulatedFrame& frame) {
      truth->add(frame.hostUs, frame.model.truth());
    };
  Interruption interruption;
  try {
    EmulatedHand hand(std::move(model), options, observer);
    std::printf("dsa=%s sdh=%s\n", hand.dsaPort().c_str(), hand.sdhPort().c_str());
    if (std::fflush(stdout) != 0) throw std::runtime_error("standard output can't be written");
    waitForEnd(hand, interruption);
  } catch (const std::invalid_argument& error) {
    // A port of another machine, or an invalid firmware.
    throw UsageError(error.what());
  }
  if (truth) truth->finish();
  return kDone;
}

}  // namespace palpate::commands
