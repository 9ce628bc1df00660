// `palpate record` killed at random moments, and what its file then holds against a counter outside
// the process: the emulated hand's own list of frames that have left (reliability R1).
#pragma once

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/time.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "commands/numbered_series.h"
#include "emulator/numbered_hand.h"
#include "testing/awaited.h"
#include "testing/background_program.h"
#include "testing/testing.h"

namespace palpate::testing {

struct KillFigures {
  int kills = 0;
  int opened = 0;
  std::uint64_t frames = 0;   // in all files
  std::uint64_t samples = 0;  // of the series, in all files
  // from the first frame that left the hand and isn't in the file to the kill
  double mostLostMs = 0.0;
  int withJournal = 0;  // killed inside of a commit
};

// One emulated hand, many recorders one after another.
class KilledRecordings {
 public:
  // `series`: of how many senders rows are recorded beside the hand, up to three.
  KilledRecordings(const std::string& program,
                   EmulatedHandOptions options,
                   unsigned seed,
                   std::size_t series = 0)
      : program_(program), hand_(std::make_unique<NumberedHand>(), options), random_(seed) {
    constexpr std::pair<const char*, double> kSenders[] = {
        {"cell", 1000.0}, {"imu", 200.0}, {"wrist", 20.0}};
    for (std::size_t i = 0; i < series; ++i)
      series_.push_back(std::make_unique<NumberedSeries>(kSenders[i].first, kSenders[i].second));
  }

  void round() {
    const TemporaryFolder folder;
    const auto file = folder / "killed.palpate";
    std::vector<std::string> arguments{
        "record", "--dsa", hand_.dsaPort(), "--sdh", hand_.sdhPort(), "-o", file, "--quiet"};
    for (const auto& each : series_)
      arguments.insert(arguments.end(), {"--series", each->option()});
    BackgroundProgram recorder(program_, arguments);
    // Streams left over by the one killed before are stopped first: a file tells that this one
    // records.
    ASSERT_TRUE(awaited([&] { return std::filesystem::exists(file); })) << recorder.err();
    const std::int64_t madeUs = systemClock().wallUs();
    std::this_thread::sleep_for(std::chrono::microseconds(random_() % 700'000));
    const std::int64_t killUs = systemClock().wallUs();
    recorder.signal(SIGKILL);
    ASSERT_EQ(recorder.wait(), 128 + SIGKILL);
    ++figures_.kills;
    check(folder.path(), file, madeUs, killUs);
  }

  const KillFigures& figures() const noexcept { return figures_; }

 private:
  void check(const std::filesystem::path& folder,
             const std::filesystem::path& file,
             std::int64_t madeUs,
             std::int64_t killUs) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename();
      EXPECT_TRUE(name == "killed.palpate" || name == "killed.palpate-journal" ||
                  name == "killed.palpate.lock")
          << name;
      // The journal of a finished commit begins with zeros.
      if (name == "killed.palpate-journal" && !readFile(entry.path()).empty() &&
          readFile(entry.path()).front() != 0)
        ++figures_.withJournal;
    }
    const Profile profile = openRecording(file);
    ++figures_.opened;
    figures_.frames += profile.numFrames();
    std::int64_t lastNumber = -1;
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      const TactileFrame frame = profile.frame(i);
      const std::optional<std::uint64_t> number = NumberedHand::numberOf(frame.values);
      ASSERT_TRUE(number) << "a wrong frame";
      ASSERT_GT(static_cast<std::int64_t>(*number), lastNumber) << "a frame twice, or out of order";
      if (lastNumber >= 0) {
        ASSERT_EQ(static_cast<std::int64_t>(*number), lastNumber + 1)
            << "a frame is missing inside";
      }
      lastNumber = static_cast<std::int64_t>(*number);
    }
    // The first frame that had left the hand before the kill and isn't in the file. The file is
    // made when the first frame comes, so in an empty one all are missing that were sent since.
    for (const SentFrame& sent : hand_.sentFrames()) {
      if (static_cast<std::int64_t>(sent.number) <= lastNumber || sent.hostUs > killUs) continue;
      if (lastNumber < 0 && sent.hostUs < madeUs) continue;
      figures_.mostLostMs =
          std::max(figures_.mostLostMs, static_cast<double>(killUs - sent.hostUs) / 1000.0);
      break;
    }
    if (!series_.empty()) checkSeries(folder, file, profile, killUs);
  }

  // Each series has its rows from the first one on, none is missing inside; recovery gives as many
  // of each stream.
  void checkSeries(const std::filesystem::path& folder,
                   const std::filesystem::path& file,
                   const Profile& profile,
                   std::int64_t killUs) {
    const Profile recovered = [&] {
      recoverRecording(file, folder / "recovered.palpate");
      return openRecording(folder / "recovered.palpate");
    }();
    EXPECT_EQ(recovered.numFrames(), profile.numFrames());
    ASSERT_EQ(recovered.series(), profile.series());
    for (std::size_t s = 0; s < profile.series().size(); ++s)
      EXPECT_EQ(recovered.numSamples(s), profile.numSamples(s)) << profile.series()[s].name;
    for (std::size_t s = kHandSeries; s < profile.series().size(); ++s) {
      SCOPED_TRACE(profile.series()[s].name);
      EXPECT_EQ(profile.series()[s].columns, (std::vector<Column>{{"n", ""}, {"m", "N"}}));
      std::int64_t lastUs = 0;
      double first = 0.0;
      for (std::size_t i = 0; i < profile.numSamples(s); ++i) {
        const Sample sample = profile.sample(s, i);
        ASSERT_GT(sample.hostUs, lastUs);
        lastUs = sample.hostUs;
        if (i == 0) first = sample.values[0];
        const double n = first + static_cast<double>(i);
        ASSERT_EQ(sample.values, (std::vector<double>{n, -2.0 * n}));
      }
      figures_.samples += profile.numSamples(s);
      const auto sender = std::find_if(series_.begin(), series_.end(), [&](const auto& each) {
        return each->name() == profile.series()[s].name;
      });
      ASSERT_NE(sender, series_.end());
      const std::vector<std::int64_t> sentUs = (*sender)->sentUs();
      const auto next = static_cast<std::size_t>(first) + profile.numSamples(s) - 1;  // not saved
      if (profile.numSamples(s) > 0 && next < sentUs.size() && sentUs[next] < killUs)
        figures_.mostLostMs =
            std::max(figures_.mostLostMs, static_cast<double>(killUs - sentUs[next]) / 1000.0);
    }
  }

  std::string program_;
  EmulatedHand hand_;
  std::vector<std::unique_ptr<NumberedSeries>> series_;
  std::mt19937 random_;
  KillFigures figures_;
};

// `kills` over four hands at a time, half of them at 300 frames/s, each with `series` senders.
inline KillFigures killRecordings(const std::string& program,
                                  int kills,
                                  int hands,
                                  std::size_t series = 0) {
  std::vector<KillFigures> figures(static_cast<std::size_t>(hands));
  std::vector<std::jthread> workers;
  for (int h = 0; h < hands; ++h)
    workers.emplace_back([&, h] {
      EmulatedHandOptions options;
      if (h % 2 == 1) {
        options.rate = EmulationRate::kFixed;
        options.hz = 300.0;
      }
      KilledRecordings recordings(program, options, static_cast<unsigned>(h) + 1, series);
      for (int k = h; k < kills && !::testing::Test::HasFatalFailure(); k += hands)
        recordings.round();
      figures[static_cast<std::size_t>(h)] = recordings.figures();
    });
  workers.clear();
  KillFigures all;
  for (const KillFigures& one : figures) {
    all.kills += one.kills;
    all.opened += one.opened;
    all.frames += one.frames;
    all.samples += one.samples;
    all.withJournal += one.withJournal;
    all.mostLostMs = std::max(all.mostLostMs, one.mostLostMs);
  }
  std::printf(
      "%d kills, %d files open, %llu frames, %llu samples, %d journals, at most %.0f ms lost\n",
      all.kills,
      all.opened,
      static_cast<unsigned long long>(all.frames),
      static_cast<unsigned long long>(all.samples),
      all.withJournal,
      all.mostLostMs);
  return all;
}

}  // namespace palpate::testing
