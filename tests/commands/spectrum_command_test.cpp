#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_writer.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::spectrum_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

struct Row {
  double segment = 0.0, timeS = 0.0, frequencyHz = 0.0, psd = 0.0, magnitude = 0.0;
};

std::vector<Row> rowsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "segment,time_s,frequency_hz,psd,magnitude");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::vector<double> values;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      values.push_back(parseDouble(cell).value());
    EXPECT_EQ(values.size(), 5u);
    rows.push_back({values.at(0), values.at(1), values.at(2), values.at(3), values.at(4)});
  }
  return rows;
}

// 4 s at 50 frames/s: taxel (2, 7) of matrix 1 swings by 400 counts at 6.25 Hz (bin 4 of 32) around
// 1000, from frame 100 on; taxel (3, 7) rests at 500.
void writeTone(const std::filesystem::path& path, std::size_t frames = 200) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < frames; ++i) {
    TactileFrame frame(sdh2().layout);
    const double swing =
        i < 100 ? 0.0 : 400.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / 8.0);
    frame.matrix(1)(7, 2) = static_cast<float>(std::round(1000.0 + swing));
    frame.matrix(1)(7, 3) = 500.0F;
    builder.addFrame(1'400'000'000'000'000 + static_cast<std::int64_t>(i) * 20'000, frame.values);
  }
  writeDsa(builder.finish({}), path, Overwrite::kReplace);
}

// 20 s at 50 frames/s that arrive ten at once, with the sender's times: the same tone throughout.
void writeBursts(const std::filesystem::path& path) {
  ProfileBuilder builder(sdh2().layout);
  for (std::int64_t i = 0; i < 1000; ++i) {
    TactileFrame frame(sdh2().layout);
    const double turns = static_cast<double>(i) / 8.0;
    frame.matrix(1)(7, 2) =
        static_cast<float>(std::round(1000.0 + 400.0 * std::cos(2.0 * std::numbers::pi * turns)));
    builder.addFrame(
        1'400'000'000'000'000 + (i / 10 * 10 + 9) * 20'000 + i % 10, frame.values, i * 20'000);
  }
  saveRecording(builder.finish({}), {}, path, Overwrite::kReplace);
}

TEST(SpectrumCommand, TakesTheSendersClockByChoice) {
  const testing::TemporaryFolder folder;
  const std::string file = folder / "bursts.palpate";
  writeBursts(file);
  const auto strongest = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "spectrum", file, "--matrix", "1", "--x", "2", "--y", "7", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return Json::parse(result.out).at("strongest");
  };
  EXPECT_LT(strongest({}).at("frequency_hz").asDouble(), 5.0);
  EXPECT_EQ(strongest({}).text(), strongest({"--time", "arrival"}).text());
  const Json fitted = strongest({"--time", "fitted"});
  EXPECT_NEAR(fitted.at("frequency_hz").asDouble(), 6.25, 1e-3);
  EXPECT_NEAR(fitted.at("magnitude").asDouble(), 400.0, 1.0);
  const auto info = palpate({"info", file});
  EXPECT_NE(info.out.find("frames: drift 0.0 ppm, delays vary by 180.0 ms, 0 restarts"),
            std::string::npos)
      << info.out;
  EXPECT_EQ(Json::parse(palpate({"info", file, "--json"}).out).at("clocks").size(), 1u);
  const auto times = palpate({"signals", file, "--matrix", "1", "--time", "fitted"}).out;
  EXPECT_NE(times.find("\n1,1400000000020,1,"), std::string::npos) << times.substr(0, 300);
  const std::string out = folder / "fitted.palpate";
  const auto converted = palpate({"convert", file, out, "--time", "fitted"});
  EXPECT_EQ(converted.exitCode, 0) << converted.err;
  EXPECT_NE(converted.err.find("frames: drift 0.0 ppm"), std::string::npos) << converted.err;
  EXPECT_NE(palpate({"info", out}).out.find("times fitted to the sender's clock"),
            std::string::npos);
  writeTone(folder / "tone.dsa");
  expectOneLineError(
      palpate({"signals", folder / "tone.dsa", "--time", "fitted"}), 1, {"no times of the sender"});
}

TEST(SpectrumCommand, ReadsTheAmplitudeOfATone) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "tone.dsa");
  const auto result =
      palpate({"spectrum", folder / "tone.dsa", "--matrix", "1", "--x", "2", "--y", "7"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = rowsOf(result.out);
  ASSERT_EQ(rows.size(), 169u * 17u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t segment = i / 17, bin = i % 17;
    EXPECT_EQ(rows[i].segment, static_cast<double>(segment));
    EXPECT_NEAR(rows[i].timeS, 0.02 * static_cast<double>(segment + 16), 1e-9);
    EXPECT_NEAR(rows[i].frequencyHz, 50.0 / 32.0 * static_cast<double>(bin), 1e-9);
    if (segment + 32 <= 100) {
      EXPECT_NEAR(rows[i].magnitude, 0.0, 1e-9);
    }
    if (segment >= 100 && bin == 4) {
      EXPECT_NEAR(rows[i].magnitude, 400.0, 1.0);  // values are whole counts
      // A^2 / 2 in a bin whose noise bandwidth is 1.5 bins.
      EXPECT_NEAR(rows[i].psd, 400.0 * 400.0 / 2.0 / (1.5 * 50.0 / 32.0), 300.0);
    }
  }
  EXPECT_NE(result.err.find("25.00 Hz"), std::string::npos) << result.err;
}

TEST(SpectrumCommand, TellsRateNyquistAndTheStrongestLine) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "tone.dsa");
  const auto result =
      palpate({"spectrum", folder / "tone.dsa", "--matrix", "1", "--x", "2", "--y", "7", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_NEAR(report.at("rate_hz").asDouble(), 50.0, 1e-9);
  EXPECT_NEAR(report.at("nyquist_hz").asDouble(), 25.0, 1e-9);
  EXPECT_NEAR(report.at("jitter").asDouble(), 0.0, 1e-9);
  EXPECT_EQ(report.at("samples").asInteger(), 200);
  EXPECT_EQ(report.at("segments").asInteger(), 169);
  EXPECT_EQ(report.at("stretches").size(), 1u);
  EXPECT_NEAR(report.at("strongest").at("frequency_hz").asDouble(), 6.25, 1e-9);
  EXPECT_GE(report.at("strongest").at("time_s").asDouble(), 2.0);
  const Json still = Json::parse(
      palpate({"spectrum", folder / "tone.dsa", "--matrix", "1", "--x", "3", "--y", "7", "--json"})
          .out);
  EXPECT_TRUE(still.at("strongest").isNull());
}

TEST(SpectrumCommand, TakesSignalsFramesAndWindowsAsAsked) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "tone.dsa");
  const auto rows = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"spectrum", folder / "tone.dsa"});
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return rowsOf(result.out);
  };
  // The mean of two taxels swings by half as much; so it does in the whole hand.
  for (const auto& words : {std::vector<std::string>{"--signal", "mean", "--matrix", "1"},
                            std::vector<std::string>{"--signal", "mean"}})
    EXPECT_NEAR(rows(words).at(150 * 17 + 4).magnitude, 200.0, 1.0);
  const auto part = rows(
      {"--matrix", "1", "--x", "2", "--y", "7", "--from", "110", "--to", "149", "--window", "40"});
  ASSERT_EQ(part.size(), 21u);
  EXPECT_NEAR(part[5].frequencyHz, 6.25, 1e-9);
  EXPECT_NEAR(part[5].magnitude, 400.0, 1.0);
  EXPECT_NEAR(part[5].timeS, 0.02 * (110 + 20), 1e-9);
  const auto kept =
      rows({"--matrix", "1", "--x", "3", "--y", "7", "--detrend", "none", "--overlap", "0"});
  ASSERT_EQ(kept.size(), 6u * 17u);
  EXPECT_NEAR(kept[0].magnitude, 500.0, 1e-6);
}

// The centroid moves between column 3 and the taxel that swings.
TEST(SpectrumCommand, ComputedSeriesAreSignals) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "tone.dsa");
  const std::string file = folder / "tone.dsa";
  const auto result =
      palpate({"spectrum", file, "--signal", "m1_centroid_x_mm", "--from", "100", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NEAR(Json::parse(result.out).at("strongest").at("frequency_hz").asDouble(), 6.25, 1e-9);
  EXPECT_EQ(palpate({"spectrum", file, "--coherence", "m1_centroid_x_mm,m1_mean", "--window", "16"})
                .exitCode,
            0);
  expectOneLineError(palpate({"spectrum", file, "--signal", "m1_force_n"}),
                     1,
                     {"has no m1_force_n: needs a calibration: --calibration C.json"});
  expectOneLineError(palpate({"spectrum", file, "--signal", "m1_slip_mm", "--no-tare"}),
                     2,
                     {"--no-tare needs --calibration"});
  for (const char* named : {"m1_slip_mm", "m3_sum*2"})
    expectOneLineError(
        palpate({"spectrum", file, "--matrix", "1", "--signal", named}), 2, {"leave out --matrix"});
}

TEST(SpectrumCommand, SaysWhichTaxelsThereAre) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "tone.dsa", 40);
  const auto with = [&](const char* matrix, const char* x, const char* y) {
    return palpate({"spectrum", folder / "tone.dsa", "--matrix", matrix, "--x", x, "--y", y});
  };
  // The corners of a fingertip are cut: row 0 of a distal matrix has its two (four) middle taxels.
  expectOneLineError(with("1", "0", "0"), 1, {"matrix 1, x 0, y 0", "row 0 has x"});
  expectOneLineError(with("1", "6", "3"), 1, {"no such taxel", "row 3 has x"});
  expectOneLineError(with("1", "0", "13"), 1, {"no such taxel", "y 0..12"});
  expectOneLineError(with("6", "0", "0"), 1, {"no matrix 6", "0..5"});
}

TEST(SpectrumCommand, RefusesWrongUsageAndTooLittle) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "short.dsa", 20);
  const std::string file = folder / "short.dsa";
  const std::vector<std::string> taxel = {
      "spectrum", file, "--matrix", "1", "--x", "2", "--y", "7"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), taxel.begin(), taxel.end());
    return palpate(more);
  };
  expectOneLineError(with({}), 1, {"20 samples", "32", "--window"});
  EXPECT_EQ(with({"--window", "16"}).exitCode, 0) << "the overlap follows the window";
  expectOneLineError(with({"--window", "1"}), 2, {"window"});
  expectOneLineError(with({"--window", "16", "--overlap", "16"}), 2, {"overlap", "15"});
  expectOneLineError(with({"--signal", "mean"}), 2, {"--signal"});
  expectOneLineError(with({"--from", "20"}), 1, {"no frame 20", "only 0..19"});
  expectOneLineError(with({"--from", "5", "--to", "4"}), 2, {"--from"});
  expectOneLineError(palpate({"spectrum", file}), 2, {"--matrix", "--signal"});
  expectOneLineError(palpate({"spectrum", file, "--matrix", "1", "--x", "2"}), 2, {"--y"});
  expectOneLineError(palpate({"spectrum", file, "--signal", "hum"}), 2, {"mean", "sum"});
  writeTone(folder / "one.dsa", 1);
  expectOneLineError(
      palpate({"spectrum", folder / "one.dsa", "--signal", "sum"}), 1, {"1 samples"});
}

// Two taxels at about 74 frames/s. Numbers from the stamps in the XML, by a few lines of Python:
// 3235 intervals in 43.289 s, population sd 2.4713 ms at a mean of 13.3815 ms.
TEST(SpectrumCommand, SaysWhatRealRecordingsCannotShow) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const std::string file = *folder / "frequency_analysis" / "roughness_test_rough.dsa";
  const auto result =
      palpate({"spectrum", file, "--matrix", "5", "--x", "2", "--y", "9", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_EQ(report.at("samples").asInteger(), 3236);
  EXPECT_EQ(report.at("segments").asInteger(), 3236 - 31);
  EXPECT_NEAR(report.at("rate_hz").asDouble(), 3235 / 43.289, 1e-3);
  EXPECT_NEAR(report.at("nyquist_hz").asDouble(), 37.4, 0.05);
  EXPECT_NEAR(report.at("jitter").asDouble(), 2.471306 / 13.381453, 1e-5);
  expectOneLineError(palpate({"spectrum", file, "--matrix", "5", "--x", "1", "--y", "9"}),
                     1,
                     {"masked", "x 2 y 9; x 3 y 9"});
  expectOneLineError(palpate({"spectrum", file, "--matrix", "0", "--x", "1", "--y", "9"}),
                     1,
                     {"masked", "no taxel of this matrix is scanned"});
}

TEST(SpectrumCommand, OneLineWithItsPeaks) {
  const testing::TemporaryFolder folder;
  writeTone(folder / "tone.dsa", 1000);
  const std::vector<std::string> taxel = {
      "spectrum", folder / "tone.dsa", "--matrix", "1", "--x", "2", "--y", "7", "--from", "100"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> words = taxel;
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words);
  };
  const auto line = with({"--welch", "--window", "64"});
  ASSERT_EQ(line.exitCode, 0) << line.err;
  EXPECT_EQ(line.out.substr(0, 27), "frequency_hz,psd,magnitude\n");
  EXPECT_EQ(std::count(line.out.begin(), line.out.end(), '\n'), 34);  // 33 bins
  const auto peaks = with({"--peaks", "--window", "64", "--quiet"});
  ASSERT_EQ(peaks.exitCode, 0) << peaks.err;
  std::istringstream lines(peaks.out);
  std::string text;
  std::getline(lines, text);
  EXPECT_EQ(text, "frequency_hz,psd,amplitude,width_hz,prominence_db");
  std::getline(lines, text);
  EXPECT_NEAR(parseDouble(text.substr(0, text.find(','))).value(), 6.25, 0.01);
  const Json json = Json::parse(with({"--welch", "--window", "64", "--json"}).out);
  EXPECT_NEAR(json.at("peaks").at(0).at("frequency_hz").asDouble(), 6.25, 0.01);
  EXPECT_NEAR(json.at("peaks").at(0).at("amplitude").asDouble(), 400.0, 2.0);
  EXPECT_EQ(json.at("psd").size(), 33u);
  expectOneLineError(with({"--welch", "--window", "2000"}), 1, {"smaller --window"});
  expectOneLineError(
      with({"--welch", "--coherence", "1:mean,2:mean"}), 2, {"--coherence doesn't go with"});
}

TEST(SpectrumCommand, CoherenceOfTwoSignals) {
  const testing::TemporaryFolder folder;
  const std::string file = folder / "tone.dsa";
  writeTone(file, 1000);
  const auto with = [&](const std::string& both, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"spectrum", file, "--coherence", both, "--from", "100"};
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words);
  };
  const auto found = with("1:2:7,1:max", {"--window", "64"});
  ASSERT_EQ(found.exitCode, 0) << found.err;
  EXPECT_EQ(found.out.substr(0, 44), "frequency_hz,coherence,phase_deg,psd_a,psd_b");
  const Json json = Json::parse(with("1:2:7,hand:max", {"--window", "64", "--json"}).out);
  EXPECT_NEAR(json.at("coherence").at(8).asDouble(), 1.0, 1e-6);  // 6.25 Hz
  // Both spellings of names mean the same; formulas count, too.
  EXPECT_EQ(with("m1_x2_y7,m1_max", {"--window", "64"}).out, found.out);
  EXPECT_EQ(with("1*m1_x2_y7,max(m1_max,m1_max)", {"--window", "64"}).out, found.out);
  expectOneLineError(with("1:mean,2*m9_mean"), 1, {"no signal \"m9_mean\""});
  expectOneLineError(with("1:mean,2*"), 2, {"as a formula"});
  // A signal at rest has no power: no coherence.
  const Json rest = Json::parse(with("1:2:7,1:3:7", {"--window", "64", "--json"}).out);
  EXPECT_TRUE(rest.at("coherence").at(8).isNull());
  expectOneLineError(with("1:mean"), 2, {"two signals A,B"});
  expectOneLineError(with("1:mean,1:width"), 2, {"\"1:width\" is not a signal"});
  expectOneLineError(with("1:mean,9:mean"), 1, {"has no matrix 9"});
  expectOneLineError(with("1:mean,1:99:2"), 1, {"no such taxel"});
  expectOneLineError(with("1:mean,angle9"), 1, {"has no angle9"});
  expectOneLineError(with("1:mean,2:mean", {"--window", "800"}), 1, {"two segments"});
  expectOneLineError(with("1:mean,2:mean", {"--matrix", "1"}), 2, {"leave out --matrix"});
}

}  // namespace
}  // namespace palpate::spectrum_command_test
