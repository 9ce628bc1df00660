// R1: `palpate record` is killed at random moments, while a hand outside of it counts what it sent.
#pragma once

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <random>
#include <thread>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "emulator/numbered_hand.h"
#include "testing/background_program.h"

namespace palpate::testing {

// Waits until an unfinished recording holds so many frames.
inline bool awaitFrames(const std::filesystem::path& path, std::size_t frames) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end) {
    try {
      if (openRecording(path).numFrames() >= frames) return true;
    } catch (const Error&) {  // not there yet
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

inline std::size_t killsToDo(std::size_t usual) {
  const char* given = std::getenv("PALPATE_KILLS");
  return given ? static_cast<std::size_t>(parseInteger(given).value_or(0)) : usual;
}

struct KillReport {
  std::size_t kills = 0;
  std::size_t opened = 0;       // as one file with its journal, without repair
  std::size_t wrongFrames = 0;  // values that were never sent
  std::size_t doubledOrMissing = 0;
  std::size_t strayFiles = 0;
  double mostLostMs = 0.0;  // between the last recorded frame's sending and the kill, at most
};

inline void judgeKilled(const std::filesystem::path& folder,
                        const EmulatedHand& hand,
                        std::int64_t killedUs,
                        KillReport& report) {
  ++report.kills;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != "k.palpate" && name != "k.palpate-journal" && name != "k.palpate.lock")
      ++report.strayFiles;
  }
  std::optional<std::uint64_t> last;
  try {
    const Profile profile = openRecording(folder / "k.palpate");
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      const auto number = NumberedHand::numberOf(profile.frame(i).values);
      if (!number)
        ++report.wrongFrames;
      else if (last && *number != *last + 1)
        ++report.doubledOrMissing;
      if (number) last = number;
    }
    if (verifyRecording(folder / "k.palpate").state == VerifyReport::State::kSound) ++report.opened;
  } catch (const Error&) {
    return;  // not opened
  }
  // The oldest frame that left the hand whole before the kill and isn't in the recording.
  for (const SentFrame& frame : hand.sentFrames()) {
    if (!frame.whole || frame.hostUs >= killedUs || (last && frame.number <= *last)) continue;
    const double lostMs = static_cast<double>(killedUs - frame.hostUs) / 1000.0;
    report.mostLostMs = std::max(report.mostLostMs, lostMs);
    return;
  }
}

// Half of them at 30, half at 300 frames/s.
inline KillReport killRecordings(std::size_t kills, unsigned seed = 20261121) {
  KillReport report;
  std::mt19937 random(seed);
  for (const double hz : {30.0, 300.0}) {
    EmulatedHandOptions options;
    options.rate = EmulationRate::kHz;
    options.hz = hz;
    const EmulatedHand hand(std::make_unique<NumberedHand>(), options);
    for (std::size_t i = 0; i < kills / 2; ++i) {
      const TemporaryFolder folder;
      BackgroundProgram program(
          PALPATE_PROGRAM,
          {"record", "--dsa", hand.dsaPort(), "--sdh", hand.sdhPort(), "-o", folder / "k.palpate"});
      if (!awaitFrames(folder / "k.palpate", 1)) {
        ++report.kills;  // and not opened
        continue;
      }
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 400'000));
      const std::int64_t killedUs = systemClock().wallUs();
      program.signal(SIGKILL);
      program.wait();
      judgeKilled(folder.path(), hand, killedUs, report);
    }
  }
  return report;
}

}  // namespace palpate::testing
