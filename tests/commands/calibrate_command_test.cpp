#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "palpate/calibration/noise_floor.h"
#include "palpate/calibration/step_model.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::calibrate_command_test {
namespace {
namespace fs = std::filesystem;

using testing::expectOneLineError;
using testing::palpate;
using testing::TemporaryFolder;

// A recording of an SDH-2 whose matrix 1 answers a step of so many counts; all its taxels alike.
void writeStep(const fs::path& path, double gain, double degC, int frames = 350) {
  ProfileBuilder builder(sdh2().layout);
  const StepParameters p = StepParameters::ofTimes(gain, 0.02 * gain, 0.5, 0.08);
  builder.addTemperatures(1'000'000'000, std::vector<double>(9, degC));
  builder.addAngles(1'000'000'000, std::vector<double>(7, 0.0));
  const std::size_t offset = sdh2().layout->offset(1);
  for (int i = 0; i < frames; ++i) {
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    const auto counts = static_cast<float>(std::round(10.0 * stepResponse(p, 0.032 * (i - 10))));
    for (std::size_t place = 36; place < 48; ++place) values[offset + place] = counts;
    builder.addFrame(1'000'000'000 + 32'000 * i, values);
  }
  saveRecording(builder.finish({}), {}, path);
}

// Nine recordings and their table: P = 20 - .4 T + .05 gain.
void writeTable(const TemporaryFolder& folder) {
  std::string table = "file,pressure_kpa\n";
  int i = 0;
  for (const double degC : {28.0, 36.0, 44.0})
    for (const double gain : {20.0, 45.0, 70.0}) {
      const std::string name = "step" + std::to_string(i++) + ".dsa";
      writeStep(folder / name, gain, degC);
      table += name + "," +
               numberText(20.0 - 0.4 * degC + 0.05 * gain + (i % 2 == 0 ? 0.3 : -0.3)) + "\n";
    }
  testing::writeFile(folder / "table.csv", table);
}

TEST(CalibrateCommand, StepPrintsWhatTheInterfacePromises) {
  const TemporaryFolder folder;
  writeStep(folder / "a.dsa", 40.0, 30.0);
  const auto result = palpate({"calibrate", "step", folder / "a.dsa", "--matrix", "1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  ASSERT_EQ(json.at("steps").size(), 1u);
  const Json step = json.at("steps").at(0);
  EXPECT_EQ(step.at("begin").asInteger(), 10);
  EXPECT_NEAR(step.at("T1").asDouble(), 0.5, 0.02);
  EXPECT_NEAR(step.at("m").asDouble() / step.at("K").asDouble(), 0.02, 0.001);
  for (const char* key : {"end", "K", "T2", "T", "d", "rmse"})
    EXPECT_TRUE(step.at(key).isNumber()) << key;
  EXPECT_TRUE(step.at("converged").asBool());
  EXPECT_TRUE(step.at("identifiable").isBool());
  EXPECT_EQ(step.at("covariance").size(), 4u);
  EXPECT_EQ(json.at("sha256").asString().size(), 64u);
  EXPECT_EQ(palpate({"calibrate",
                     "step",
                     folder / "a.dsa",
                     "--matrix",
                     "1",
                     "--loss",
                     "huber",
                     "--damping",
                     "any"})
                .exitCode,
            0);
}

TEST(CalibrateCommand, StepSaysThatThereIsNone) {
  const TemporaryFolder folder;
  writeStep(folder / "a.dsa", 40.0, 30.0);
  const auto result = palpate({"calibrate", "step", folder / "a.dsa", "--matrix", "0"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(Json::parse(result.out).at("notes").text().find("never loaded"), std::string::npos);
  expectOneLineError(
      palpate({"calibrate", "step", folder / "a.dsa", "--matrix", "6"}), 1, {"no matrix 6"});
  expectOneLineError(palpate({"calibrate", "step", folder / "a.dsa"}), 2, {"--matrix"});
  expectOneLineError(
      palpate({"calibrate", "step", folder / "b.dsa", "--matrix", "0"}), 1, {"b.dsa"});
}

TEST(CalibrateCommand, NoiseWritesJsonAndXml) {
  const TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 400; ++i) {
    const double degC = 25.0 + 0.05 * i;
    builder.addTemperatures(1'000'000 + 1'000'000 * i, std::vector<double>(9, degC));
    const auto counts = static_cast<float>(std::round(30.0 + 0.5 * degC + (i * 7 % 5) - 2));
    builder.addFrame(1'000'000 + 1'000'000 * i,
                     std::vector<float>(sdh2().layout->numCells(), counts));
  }
  saveRecording(builder.finish({}), {}, folder / "noise.dsa");
  const auto result = palpate({"calibrate", "noise", folder / "noise.dsa", "-o", folder / "n.xml"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json matrices = Json::parse(result.out).at("matrices");
  ASSERT_EQ(matrices.size(), 6u);
  for (const char* key : {"index", "slope", "intercept", "rmse", "rmse_true"})
    EXPECT_TRUE(matrices.at(2).at(key).isNumber()) << key;
  EXPECT_EQ(matrices.at(2).at("bins").size(), 20u);
  EXPECT_NEAR(matrices.at(2).at("slope").asDouble(), 0.5, 0.02);
  const NoiseFloor xml = parseNoiseXml(testing::readFile(folder / "n.xml"), "n.xml");
  EXPECT_EQ(xml.lines.at(5).slope, matrices.at(5).at("slope").asDouble());
  expectOneLineError(
      palpate({"calibrate", "noise", folder / "noise.dsa", "-o", folder / "n.xml"}), 1, {"n.xml"});
  EXPECT_EQ(palpate({"calibrate", "noise", folder / "noise.dsa", "-o", folder / "n.json"}).exitCode,
            0);
  EXPECT_EQ(Json::parse(testing::readFile(folder / "n.json")).at("matrices").size(), 6u);
}

TEST(CalibrateCommand, NoiseOfATouchedHandIsSaid) {
  const TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 400; ++i) {
    builder.addTemperatures(1'000'000 + 100'000 * i, std::vector<double>(9, 25.0 + 0.005 * i));
    TactileFrame frame(sdh2().layout);
    frame.matrix(1)(7, 2) = i < 200 ? 40.0F + static_cast<float>(i % 3) : 900.0F;
    builder.addFrame(1'000'000 + 100'000 * i, frame.values);
  }
  saveRecording(builder.finish({}), {}, folder / "touched.dsa");
  const auto result = palpate({"calibrate", "noise", folder / "touched.dsa"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("touched or moved in 50 % of the time"), std::string::npos)
      << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_NE(json.at("not_at_rest").asString(), "");
  EXPECT_FALSE(json.at("matrices").at(1).at("at_rest").asBool());
  EXPECT_TRUE(json.at("matrices").at(0).at("at_rest").asBool());
}

TEST(CalibrateCommand, PressureIsMadeAndApplied) {
  const TemporaryFolder folder;
  writeTable(folder);
  // Half of the 12 taxels that are active, 11.56 mm^2 each.
  const auto made = palpate(
      {"calibrate", "pressure", folder / "table.csv", "--area", "69.36", "-o", folder / "c.json"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const Json json = Json::parse(testing::readFile(folder / "c.json"));
  for (const char* surface : {"K", "m"}) {
    EXPECT_EQ(json.at(surface).at("c").size(), std::string(surface) == "K" ? 4u : 9u);
    EXPECT_TRUE(json.at(surface).at("rmse_kpa").isNumber());
    EXPECT_TRUE(json.at(surface).at("loo_rmse_kpa").isNumber());
  }
  EXPECT_EQ(json.at("matrix").asInteger(), 1) << "the one that was loaded";
  EXPECT_EQ(json.at("samples").size(), 9u);
  EXPECT_EQ(json.at("samples").at(0).at("sha256").asString().size(), 64u);

  // A weight of the table, read back: 20 - .4 * 36 + .05 * 45 = 7.85 kPa on 12 taxels.
  const auto applied =
      palpate({"calibrate", "apply", folder / "step4.dsa", "--calibration", folder / "c.json"});
  ASSERT_EQ(applied.exitCode, 0) << applied.err;
  EXPECT_EQ(applied.out.substr(0, applied.out.find('\n')),
            "frame,time_ms,matrix,active,K,pressure_kpa,pressure_sd_kpa,force_n,force_sd_n,in_"
            "range,temperature_known,"
            "saturated");
  EXPECT_NE(applied.err.find("assumed"), std::string::npos) << "assumptions are said";
  std::string last;
  std::istringstream lines(applied.out);
  for (std::string line; std::getline(lines, line);) last = line;
  std::vector<double> cells;
  std::istringstream row(last);
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(parseDouble(cell).value());
  ASSERT_EQ(cells.size(), 12u);
  EXPECT_EQ(cells[3], 12.0);
  EXPECT_NEAR(cells[5], 7.85, 2.0 * cells[6]);
  EXPECT_NEAR(cells[7], cells[5] * 6 * 11.56e-3, 1e-6);

  // contact fills force_n with the same.
  const auto contact =
      palpate({"contact", folder / "step4.dsa", "--calibration", folder / "c.json"});
  EXPECT_EQ(contact.exitCode, 0) << "while the load rises it is only lighter than measured";
  const std::string end = contact.out.substr(contact.out.rfind(',') + 1);
  EXPECT_NEAR(parseDouble(end.substr(0, end.size() - 1)).value(), cells[7], 1e-9);
  EXPECT_NE(contact.err.find("lighter than all that the calibration measured"), std::string::npos)
      << contact.err;

  const auto written = palpate({"calibrate",
                                "apply",
                                folder / "step4.dsa",
                                "--calibration",
                                folder / "c.json",
                                "-o",
                                folder / "kpa.palpate"});
  ASSERT_EQ(written.exitCode, 0) << written.err;
  const Profile kpa = openRecording(folder / "kpa.palpate");
  EXPECT_EQ(kpa.info().valueType, ValueType::kFloat);
  EXPECT_NEAR(
      static_cast<double>(std::as_const(kpa).frame(349).matrix(1).sum()) / 12.0, cells[5], 1e-3);
  expectOneLineError(
      palpate({"calibrate", "apply", folder / "kpa.palpate", "--calibration", folder / "c.json"}),
      1,
      {"needs counts"});
}

// analyst M5
TEST(CalibrateCommand, ForcesAreNotKnownWithoutTheAreaOfTheIndenter) {
  const TemporaryFolder folder;
  writeTable(folder);
  ASSERT_EQ(
      palpate({"calibrate", "pressure", folder / "table.csv", "-o", folder / "c.json"}).exitCode,
      0);
  const std::string said = "the area of the indenter is not known (calibrate pressure --area MM2)";
  const auto applied = palpate(
      {"calibrate", "apply", folder / "step4.dsa", "--calibration", folder / "c.json", "--quiet"});
  EXPECT_EQ(applied.exitCode, 3);
  EXPECT_EQ(applied.err.find("palpate: " + said), 0u) << applied.err;
  EXPECT_EQ(std::count(applied.err.begin(), applied.err.end(), '\n'), 1) << applied.err;
  // frame,time_ms,matrix,active,K,pressure_kpa,pressure_sd_kpa,,,in_range,..
  const std::string row = applied.out.substr(applied.out.find("\n349,") + 1);
  EXPECT_NE(row.find(",,,1,"), std::string::npos) << row;
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), 11) << row;

  const auto contact =
      palpate({"contact", folder / "step4.dsa", "--calibration", folder / "c.json", "--quiet"});
  EXPECT_EQ(contact.exitCode, 3);
  EXPECT_NE(contact.err.find("have no force_n: " + said), std::string::npos) << contact.err;
  EXPECT_EQ(contact.out.substr(contact.out.size() - 2), ",\n");

  // Pressures need no area.
  const auto written = palpate({"calibrate",
                                "apply",
                                folder / "step4.dsa",
                                "--calibration",
                                folder / "c.json",
                                "-o",
                                folder / "kpa.palpate"});
  EXPECT_EQ(written.exitCode, 0) << written.err;
}

// analyst M5: what is outside of the measured range is not a force of the hand.
TEST(CalibrateCommand, ContactHasNoForceOutsideTheMeasuredRange) {
  const TemporaryFolder folder;
  writeTable(folder);
  ASSERT_EQ(palpate({"calibrate",
                     "pressure",
                     folder / "table.csv",
                     "--area",
                     "69.36",
                     "-o",
                     folder / "c.json"})
                .exitCode,
            0);
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 3; ++i) {
    TactileFrame frame(sdh2().layout);
    if (i == 1) frame.matrix(1).block(3, 1, 4, 3).setConstant(4000.0F);
    builder.addFrame(1'000'000 + 30'000 * i, frame.values);
    builder.addAngles(1'000'000 + 30'000 * i, std::vector<double>(7, 0.0));
  }
  saveRecording(builder.finish({}), {}, folder / "strong.dsa");
  const auto contact =
      palpate({"contact", folder / "strong.dsa", "--calibration", folder / "c.json"});
  EXPECT_EQ(contact.exitCode, 3);
  EXPECT_NE(contact.err.find("1 of 3 frames have no force_n: a contact is outside the measured "
                             "range of the calibration"),
            std::string::npos)
      << contact.err;
  std::istringstream lines(contact.out);
  std::vector<std::string> ends;
  for (std::string line; std::getline(lines, line);) ends.push_back(line.substr(line.rfind(',')));
  EXPECT_EQ(ends, (std::vector<std::string>{",force_n", ",0", ",", ",0"}));
}

// core F8
TEST(CalibrateCommand, AThresholdIsBoundedByTheFullScaleOfTheHand) {
  const TemporaryFolder folder;
  for (const float fullScale : {4095.0F, 65535.0F}) {
    const HandDescription hand =
        parseHand(R"({"format":"palpate-hand","version":1,"name":"pad","full_scale":)" +
                      numberText(fullScale) +
                      R"(,"matrices":[{"name":"m","rows":2,"columns":2,"pitch_mm":1}]})",
                  "",
                  "hand.json");
    ProfileBuilder builder(hand);
    for (int i = 0; i < 100; ++i)
      builder.addFrame(i * 30'000, std::vector<float>{5000.5F, 0.0F, 0.0F, 0.0F});
    const std::string file = folder / (numberText(fullScale) + ".palpate");
    saveRecording(builder.finish({}), {}, file);
    const auto tare = palpate({"calibrate", "tare", file, "--most", "6000"});
    if (fullScale > 6000.0F) {
      EXPECT_EQ(tare.exitCode, 0) << tare.err;
    } else {
      expectOneLineError(tare, 2, {"--most 6000 is above the full scale of pad, 4095 counts"});
    }
  }
}

TEST(CalibrateCommand, SettingsThatTheRecordingNotesAreTaken) {
  const TemporaryFolder folder;
  writeTable(folder);
  ASSERT_EQ(palpate({"calibrate",
                     "pressure",
                     folder / "table.csv",
                     "--area",
                     "69.36",
                     "-o",
                     folder / "c.json"})
                .exitCode,
            0);
  const std::vector<std::string> apply = {
      "calibrate", "apply", folder / "step4.dsa", "--calibration", folder / "c.json"};
  const auto note = [&](const std::string& json) {
    const EventsReport before = readEvents(folder / "step4.dsa");
    Event event;
    event.tUs = event.t1Us = 1'000'000;
    event.kind = "sensor_settings";
    event.json = json;
    saveEvents(folder / "step4.dsa", before, std::vector{event});
  };
  note(R"({"sensitivity":0.5,"threshold_counts":100})");
  const auto noted = palpate(apply);
  ASSERT_EQ(noted.exitCode, 0) << noted.err;
  EXPECT_NE(noted.err.find("sensitivity 0.5"), std::string::npos) << noted.err;
  auto told = apply;
  told.insert(told.end(), {"--sensor-sensitivity", "1"});
  EXPECT_EQ(palpate(told).err.find("sensitivity 0.5"), std::string::npos) << "goes before it";
  note(R"({"sensitivity":7})");
  expectOneLineError(palpate(apply), 1, {"sensor_settings"});
  EXPECT_EQ(palpate(told).exitCode, 0);
  // Notes that can't be read: only who wants the settings or the tare of them fails.
  testing::writeFile(folder / "step4.dsa.notes.json", "{");
  expectOneLineError(palpate(apply), 1, {"step4.dsa.notes.json"});
  expectOneLineError(palpate(told), 1, {"step4.dsa.notes.json"});
  told.emplace_back("--no-tare");
  const auto given = palpate(told);
  EXPECT_EQ(given.exitCode, 0) << given.err;
}

TEST(CalibrateCommand, PressureSaysWhichRowsAreLeftOut) {
  const TemporaryFolder folder;
  writeTable(folder);
  writeStep(folder / "short.dsa", 50.0, 30.0, 30);
  testing::writeFile(
      folder / "more.csv",
      testing::readFile(folder / "table.csv") + "missing.dsa,5\nshort.dsa,6\nstep0.dsa,heavy\n");
  const auto result = palpate({"calibrate", "pressure", folder / "more.csv"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
  EXPECT_NE(result.err.find("missing.dsa"), std::string::npos);
  EXPECT_NE(result.err.find("heavy"), std::string::npos);
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("samples").size(), 12u);
  EXPECT_EQ(json.at("K").at("points").asInteger(), 9) << "the rest is still valid";
  testing::writeFile(folder / "none.csv", "file,pressure_kpa\nmissing.dsa,5\n");
  EXPECT_EQ(palpate({"calibrate", "pressure", folder / "none.csv"}).exitCode, 1);
  expectOneLineError(
      palpate({"calibrate", "pressure", folder / "nothing.csv"}), 1, {"nothing.csv"});
  testing::writeFile(folder / "bad.csv", "a,b\n1,2\n");
  expectOneLineError(palpate({"calibrate", "pressure", folder / "bad.csv"}), 1, {"pressure_kpa"});
}

// stranger S14: 12 taxels of 11.56 mm^2 are active, 138.72 mm^2.
TEST(CalibrateCommand, TheAreaOfTheIndenterIsOneThatWasLoaded) {
  const TemporaryFolder folder;
  writeTable(folder);
  const auto make = [&](const char* area) {
    return palpate({"calibrate",
                    "pressure",
                    folder / "table.csv",
                    "--area",
                    area,
                    "--force",
                    "-o",
                    folder / "c.json",
                    "--quiet"});
  };
  expectOneLineError(make("1.5"), 1, {"(--area), 1.50 mm^2, is less than one taxel, 11.56 mm^2"});
  expectOneLineError(make("160"), 1, {"160.00 mm^2, is more than was loaded: at most 138.72 mm^2"});
  ASSERT_EQ(make("138.72").exitCode, 0);
  const auto applied = palpate(
      {"calibrate", "apply", folder / "step4.dsa", "--calibration", folder / "c.json", "--quiet"});
  EXPECT_EQ(applied.err.find("is not known"), std::string::npos) << applied.err;
  const std::string row = applied.out.substr(applied.out.find("\n349,") + 1);
  EXPECT_EQ(row.find(",,"), std::string::npos) << "the force is known: " << row;
}

// stranger S14.
TEST(CalibrateCommand, ARecordingHasOnePressure) {
  const TemporaryFolder folder;
  writeTable(folder);
  testing::writeFile(folder / "table.csv",
                     testing::readFile(folder / "table.csv") + "step0.dsa,80\n");
  const auto result = palpate({"calibrate", "pressure", folder / "table.csv", "--quiet"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("kPa, line 11 80 kPa: a recording has one pressure"), std::string::npos)
      << result.err;
  EXPECT_EQ(Json::parse(result.out).at("K").at("points").asInteger(), 8);
}

TEST(CalibrateCommand, TareIsNotedAppliedAndTakenAway) {
  const TemporaryFolder folder;
  for (const char* name : {"a.dsa", "a.palpate"}) {
    ProfileBuilder builder(sdh2().layout);
    for (int i = 0; i < 100; ++i) {
      std::vector<float> values(sdh2().layout->numCells(), 0.0F);
      values[3] = 25.0F;
      builder.addFrame(1'000'000 + 32'000 * i, values);
    }
    saveRecording(builder.finish({}), {}, folder / name);
    const auto found = palpate({"calibrate", "tare", folder / name});
    ASSERT_EQ(found.exitCode, 0) << found.err;
    EXPECT_EQ(Json::parse(found.out).at("matrices").at(0).at("zero").at(3).asDouble(), 25.0);
    EXPECT_TRUE(readEvents(folder / name).events.empty()) << "only proposed";
    ASSERT_EQ(palpate({"calibrate", "tare", folder / name, "--apply"}).exitCode, 0);
    ASSERT_EQ(palpate({"calibrate", "tare", folder / name, "--apply"}).exitCode, 0);
    const auto events = readEvents(folder / name).events;
    ASSERT_EQ(events.size(), 1u) << "the newer one takes the older one's place";
    EXPECT_EQ(events[0].kind, "tare");
    EXPECT_EQ(openRecording(folder / name).frame(50).values[3], 25.0F) << "raw stays raw";
    ASSERT_EQ(palpate({"calibrate", "tare", folder / name, "--remove"}).exitCode, 0);
    EXPECT_TRUE(readEvents(folder / name).events.empty());
    expectOneLineError(palpate({"calibrate", "tare", folder / name, "--remove"}), 1, {"no tare"});
  }
}

TEST(CalibrateCommand, SensitivityIsALineOverItsSteps) {
  const TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  int frame = 0;
  for (const double sensitivity : {0.25, 0.5, 1.0}) {
    const StepParameters p = StepParameters::ofTimes(400.0 * sensitivity - 10.0, 2.0, 0.4, 0.05);
    for (int i = 0; i < 250; ++i) {
      const auto counts = static_cast<float>(i < 30 ? 0.0 : stepResponse(p, 0.032 * (i - 29)));
      std::vector<float> values(sdh2().layout->numCells(), 0.0F);
      std::fill(values.begin() + 84, values.begin() + 162, 0.0F);
      const auto& layout = sdh2().layout->matrix(1);
      for (std::size_t p2 = 0; p2 < layout.numCells(); ++p2)
        if (layout.staticMask[p2] != 0) values[84 + p2] = counts;
      builder.addFrame(1'000'000 + 32'000 * frame++, values);
    }
  }
  saveRecording(builder.finish({}), {}, folder / "s.palpate");
  const auto result = palpate({"calibrate",
                               "sensitivity",
                               folder / "s.palpate",
                               "--matrix",
                               "1",
                               "--sensitivities",
                               "0.25,0.5,1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("points").size(), 3u);
  EXPECT_NEAR(json.at("slope").asDouble(), 400.0, 0.5);
  EXPECT_NEAR(json.at("offset").asDouble(), -10.0, 0.5);
  EXPECT_GT(json.at("r2").asDouble(), 0.9999);
  expectOneLineError(palpate({"calibrate",
                              "sensitivity",
                              folder / "s.palpate",
                              "--matrix",
                              "1",
                              "--sensitivities",
                              "0.5,1"}),
                     1,
                     {"3 steps"});
}

TEST(CalibrateCommand, KnowsItsKinds) {
  EXPECT_NE(palpate({"calibrate", "--help"}).out.find("sensitivity"), std::string::npos);
  expectOneLineError(
      palpate({"calibrate"}), 2, {"noise", "step", "pressure", "sensitivity", "tare", "apply"});
  expectOneLineError(palpate({"calibrate", "weight"}), 2, {"'weight'"});
  for (const char* kind : {"noise", "step", "pressure", "sensitivity", "tare", "apply"})
    EXPECT_EQ(palpate({"calibrate", kind, "--help"}).exitCode, 0) << kind;
}

TEST(CalibrateCommand, ACalibrationThatIsNoneIsRefused) {
  const TemporaryFolder folder;
  writeStep(folder / "a.dsa", 40.0, 30.0, 60);
  testing::writeFile(folder / "c.json", "{}");
  expectOneLineError(
      palpate({"calibrate", "apply", folder / "a.dsa", "--calibration", folder / "c.json"}),
      1,
      {"isn't a calibration"});
  expectOneLineError(palpate({"calibrate", "apply", folder / "a.dsa"}), 2, {"--calibration"});
  expectOneLineError(
      palpate({"contact", folder / "a.dsa", "--sensor-sensitivity", "0.5"}), 2, {"--calibration"});
}

}  // namespace
}  // namespace palpate::calibrate_command_test
