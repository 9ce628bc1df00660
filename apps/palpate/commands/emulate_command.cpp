// The command `palpate emulate` runs an emulated hand until it is interrupted: the SDH-2 on two
// ports, or any hand as a stream.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/emulator/default_scene.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/emulated_stream.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/emulator/replayed_hand.h"
#include "palpate/emulator/scene.h"
#include "palpate/emulator/truth.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"

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

std::uint64_t seedOf(const CommandLine& given) {
  return static_cast<std::uint64_t>(given.integer("seed", kSeedOption).value_or(1));
}

Faults faultsOf(const CommandLine& given) {
  try {
    return parseFaults(given.text("faults").value_or(""));
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--faults: ") + error.what());
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
  options.seed = seedOf(given);
  options.dsa.firmware = static_cast<std::uint16_t>(
      given.integer("dsa-firmware", DsaServerOptions::kFirmware).value_or(options.dsa.firmware));
  if (const auto firmware = given.text("sdh-firmware")) options.sdh.firmware = *firmware;
  options.faults = faultsOf(given);
  return options;
}

// Without a seed, another one for each emulated hand that is started: a window that waits for one
// of them takes no other in its place. `--seed` keeps what the window stores for a serial number.
std::uint32_t serialOfThisProcess() {
  constexpr int kProcessBits = 22;
  const auto us = static_cast<std::uint64_t>(systemClock().wallUs());
  return emulatedSerial((us << kProcessBits) ^ static_cast<std::uint64_t>(::getpid()));
}

EmulatedStreamOptions streamedOptionsOf(const CommandLine& given) {
  EmulatedStreamOptions options;
  options.where = *given.text("stream");
  options.format = given.chosen("format", kEmulatedStreamWords).value_or(options.format);
  if (const auto rate = given.text("rate")) {
    const auto hz = parseDouble(*rate);
    if (*rate == "max")
      options.asFastAsRead = true;
    else if (!hz || !options.kRateHz.contains(*hz))
      throw UsageError("--rate of a stream must be max or a number " +
                       numberText(options.kRateHz.minimum) + ".." +
                       numberText(options.kRateHz.maximum) + ", not '" + *rate + "'");
    else
      options.rateHz = *hz;
  }
  options.seed = seedOf(given);
  options.faults = faultsOf(given);
  return options;
}

std::unique_ptr<PhysicalHand> streamedHandOf(const CommandLine& given, std::uint64_t seed) {
  PhysicalHandOptions options;
  options.seed = seed;
  options.hand = *handOf(given);
  const auto scene = given.text("scene");
  return std::make_unique<PhysicalHand>(
      scene ? loadScene(*scene, dataFolder() / "scenes", options.hand) : defaultScene(options.hand),
      options);
}

std::unique_ptr<HandModel> modelOf(const CommandLine& given, std::uint64_t seed) {
  if (const auto recording = given.text("replay")) {
    ProgressLine line("reading " + *recording, given.quiet());
    Profile profile = openReported(*recording, line, given.quiet()).profile;
    return std::make_unique<ReplayedHand>(std::move(profile));
  }
  const Scene scene = loadScene(given.text("scene").value_or("empty"), dataFolder() / "scenes");
  PhysicalHandOptions options;
  options.seed = seed;
  return std::make_unique<PhysicalHand>(scene, options);
}

std::string joinedSceneNames() {
  std::string joined;
  for (const std::string& name : sceneNames(dataFolder() / "scenes"))
    joined += (joined.empty() ? "" : ", ") + name;
  return joined;
}

CommandSpec emulateSpec() {
  return {
      .synopsis = "palpate emulate [--dsa LINK] [--sdh LINK] [--scene NAME|FILE.json] ..",
      .purpose =
          "Runs an emulated hand: both controllers speak their protocols on two pseudo-terminals "
          "(or TCP ports of this machine). Prints one line 'dsa=PATH sdh=PATH' when it is ready, "
          "then one 'serial=HEX sdh_serial=N' with the serial numbers of its controllers, "
          "and runs until it is interrupted (Ctrl-C). With --hand and --stream it emulates any "
          "hand, with contact physics on its surfaces, and sends packets or lines to every program "
          "that connects to a TCP port; the line is then 'stream=tcp:ADDRESS:PORT'.",
      .options =
          {{"dsa", "LINK", "name for the tactile port; tcp:127.0.0.1:PORT for TCP (0: any)"},
           {"sdh", "LINK", "name for the motion port"},
           handOption(),
           {"stream",
            "PORT",
            "send the frames of --hand at this TCP port of this machine (0: any); ADDRESS:PORT "
            "opens it to other machines"},
           worded("format", "FORMAT", "form of the stream", kEmulatedStreamWords, "binary"),
           {"scene",
            "NAME|FILE.json",
            "objects and events around the hand: " + joinedSceneNames() +
                " (default empty), or a file; for a stream the default touches every matrix"},
           {"replay", "FILE", "play a recording: each frame once, then nothing"},
           {"faults",
            "SPEC",
            "faults to simulate, with commas and without blanks between them: crc=RATE drop=RATE "
            "insert=RATE stall=S@AT unplug=S@AT junk_start=BYTES boot=S. RATE: part of the packets "
            "(crc) or bytes, 0..1; S@AT: for S seconds, AT seconds after the start"},
           {"truth", "OUT.csv", "write true contacts, forces and slip of each frame"},
           {"rate",
            "real|max|HZ",
            "real: a serial line at 115200 baud (default); HZ: frames per second, "
            "0.1..1000; max: as fast as the client reads. For a stream HZ, 0.1..5000 (default "
            "100), or max"},
           rangedWhole("seed",
                       "N",
                       "seed of noise and faults, and of the serial numbers; without it each start "
                       "has others, a replay those of its recording",
                       kSeedOption,
                       "1"),
           rangedWhole("dsa-firmware",
                       "N",
                       "firmware of the tactile controller",
                       DsaServerOptions::kFirmware,
                       std::to_string(DsaServerOptions{}.firmware) + " (2.9.0.0)"),
           {"sdh-firmware", "TEXT", "firmware of the motion controller, default 0.0.3.3"},
           {"force", "", "replace OUT.csv"}},
      .example = "palpate emulate --dsa /tmp/dsa --sdh /tmp/sdh --scene ball",
      .maxArguments = 0};
}

// Waits for a signal. Throws when the emulated hand stops by itself.
template <typename Hand>
void waitForEnd(const Hand& hand, Interruption& interruption) {
  constexpr int kLookMs = 200;
  while (!interruption.waitForSignal(kLookMs))
    if (const std::string failure = hand.counts().failure; !failure.empty())
      throw std::runtime_error("the emulated hand has stopped: " + failure);
}

void printReady(const std::string& line) {
  std::printf("%s\n", line.c_str());
  if (std::fflush(stdout) != 0) throw std::runtime_error("standard output can't be written");
}

// The file of --truth; null without the option.
std::unique_ptr<TruthWriter> truthOf(const CommandLine& given, bool hasShear = false) {
  const auto path = given.text("truth");
  if (!path) return nullptr;
  return std::make_unique<TruthWriter>(
      *path, given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse, hasShear);
}

void emulatePorts(const CommandLine& given, Interruption& interruption) {
  EmulatedHandOptions options = emulateOptionsOf(given);
  std::unique_ptr<HandModel> model = modelOf(given, options.seed);
  if (!given.has("seed") && !model->serial()) options.serial = serialOfThisProcess();
  const std::unique_ptr<TruthWriter> truth = truthOf(given);
  FrameObserver observer;
  if (truth)
    observer = [&truth](const EmulatedFrame& frame) {
      truth->add(frame.hostUs, frame.model.truth());
    };
  {
    EmulatedHand hand(std::move(model), options, observer);
    printReady("dsa=" + hand.dsaPort() + " sdh=" + hand.sdhPort() + "\nserial=" + hand.dsaSerial() +
               " sdh_serial=" + hand.sdhSerial());
    waitForEnd(hand, interruption);
  }
  if (truth) truth->finish();
}

void emulateStream(const CommandLine& given, Interruption& interruption) {
  if (!given.has("hand")) throw UsageError("--stream needs --hand NAME|FOLDER");
  for (const char* other : {"dsa", "sdh", "replay", "dsa-firmware", "sdh-firmware"})
    if (given.has(other))
      throw UsageError("--stream and --" + std::string(other) + " can't be used together");
  const EmulatedStreamOptions options = streamedOptionsOf(given);
  std::unique_ptr<PhysicalHand> model = streamedHandOf(given, options.seed);
  const SensorLayout& layout = *model->hand().layout;
  const std::unique_ptr<TruthWriter> truth =
      truthOf(given, layout.numReadings() != layout.numCells());
  EmulatedStreamObserver observer;
  if (truth)
    observer = [&truth](const EmulatedStreamFrame& frame) {
      truth->add(frame.hostUs, frame.model.truth());
    };
  {
    EmulatedStream stream(std::move(model), options, observer);
    if (stream.isOpenToOthers())
      sayLine("any machine that reaches this address can connect to " + stream.name());
    printReady("stream=" + stream.name());
    waitForEnd(stream, interruption);
  }
  if (truth) truth->finish();
}

}  // namespace

int emulateCommand(const Arguments& words) {
  const CommandLine given(emulateSpec(), words);
  if (given.helpShown()) return kDone;
  if (given.has("replay") && given.has("scene"))
    throw UsageError("--replay and --scene can't be used together");
  if (given.has("replay") && given.has("truth"))
    throw UsageError("--truth needs a scene: a recording has no known truth");
  Interruption interruption;
  try {
    if (given.has("stream")) {
      emulateStream(given, interruption);
    } else {
      if (given.has("hand"))
        throw UsageError("--hand needs --stream PORT: only the SDH-2 has the two ports");
      if (given.has("format")) throw UsageError("--format needs --stream PORT");
      emulatePorts(given, interruption);
    }
  } catch (const std::invalid_argument& error) {
    // A port of another machine, or an invalid firmware.
    throw UsageError(error.what());
  }
  return kDone;
}

}  // namespace palpate::commands
