#include <algorithm>
#include <sstream>

#include <fcntl.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "recording/palpate_damage.h"

namespace palpate::info_command_test {
namespace {

namespace fs = std::filesystem;
using testing::expectOneLineError;
using testing::palpate;

Json infoOf(const fs::path& file) {
  const auto result = palpate({"info", file.string(), "--json"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return Json::parse(result.out);
}

TEST(InfoCommand, ReportsASmallHandWrittenFile) {
  // The example of docs/notes/dsa_format.md: one matrix 2 x 3, two frames 32 ms apart, the second
  // with a value of 1000; one sample of angles and of temperatures.
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "small.dsa",
                     "<?xml version=\"1.0\" encoding=\"utf-8\"?><root><sensor name=\"\">"
                     "<serial_nr>00000001</serial_nr><num_matrices>1</num_matrices>"
                     "<matrix index=\"0\"><cells_x>3</cells_x><cells_y>2</cells_y>"
                     "<texel_width>3.4</texel_width><texel_height>3.4</texel_height>"
                     "<static_mask>111 011</static_mask><dynamic_mask>111 111</dynamic_mask>"
                     "</matrix></sensor><data><frame_count>2</frame_count>"
                     "<frame index=\"0\"><time_stamp>1400000000000</time_stamp>"
                     "<frame_data>C0C00000</frame_data></frame>"
                     "<frame index=\"1\"><time_stamp>1400000000032</time_stamp>"
                     "<frame_data>C0000000 42C80000 BF800000 447A0000 BF800000</frame_data></frame>"
                     "</data><temperatures><temp_count>1</temp_count><temp index=\"0\">"
                     "<time_stamp>1400000000010</time_stamp><temp_data>35.50, 35.00</temp_data>"
                     "</temp></temperatures><joint_angles><angle_count>1</angle_count>"
                     "<angle index=\"0\"><time_stamp>1400000000001</time_stamp>"
                     "<angle_data>60.0, -10.0, 10.0</angle_data></angle></joint_angles></root>");
  const Json info = infoOf(folder / "small.dsa");
  EXPECT_EQ(info.at("format").asString(), "dsa");
  EXPECT_EQ(info.at("value_type").asString(), "counts");
  EXPECT_EQ(info.at("frames").asInteger(), 2);
  EXPECT_DOUBLE_EQ(info.at("duration_s").asDouble(), 0.032);
  EXPECT_DOUBLE_EQ(info.at("rate_hz").asDouble(), 31.25);
  EXPECT_DOUBLE_EQ(info.at("mean_rate_hz").asDouble(), 31.25);
  EXPECT_EQ(info.at("gaps").asInteger(), 0);
  EXPECT_EQ(info.at("temperatures").asInteger(), 1);
  EXPECT_EQ(info.at("joint_angles").asInteger(), 1);
  EXPECT_EQ(info.at("max_value").asDouble(), 1000.0);
  EXPECT_EQ(info.at("saturated_frames").asInteger(), 0);
  EXPECT_EQ(info.at("serial").asString(), "00000001");
  ASSERT_EQ(info.at("matrices").size(), 1u);
  const Json matrix = info.at("matrices").at(0);
  EXPECT_EQ(matrix.at("index").asInteger(), 0);
  EXPECT_EQ(matrix.at("rows").asInteger(), 2);
  EXPECT_EQ(matrix.at("columns").asInteger(), 3);
  EXPECT_EQ(matrix.at("pitch_mm").asDouble(), 3.4);
  EXPECT_EQ(matrix.at("taxels").asInteger(), 5);
  EXPECT_EQ(info.at("warnings").size(), 0u);
  const auto text = palpate({"info", folder / "small.dsa"});
  EXPECT_NE(text.out.find("31.25 Hz"), std::string::npos) << text.out;
}

// What a recording says of itself, by an independent program and regular expressions.
struct PlainFacts {
  std::int64_t frames = 0;
  std::int64_t temperatures = 0;
  std::int64_t angles = 0;
  double durationS = 0.0;
};

PlainFacts factsOf(const fs::path& file) {
  const auto xml = testing::runProgram("/bin/sh", {"-c", "bzip2 -dc '" + file.string() + "'"}).out;
  const auto count = [&](const std::string& element) {
    std::int64_t number = 0;
    for (auto at = xml.find(element); at != std::string::npos; at = xml.find(element, at + 1))
      ++number;
    return number;
  };
  PlainFacts facts{count("<frame index="), count("<temp index="), count("<angle index="), 0.0};
  const auto stampAfter = [&](std::size_t frame) {
    const auto at = xml.find("<time_stamp>", frame) + 12;
    return *parseInteger(xml.substr(at, xml.find('<', at) - at));
  };
  const std::int64_t first = stampAfter(xml.find("<frame index="));
  const std::int64_t last = stampAfter(xml.rfind("<frame index="));
  facts.durationS = static_cast<double>(last - first) / 1000.0;
  return facts;
}

TEST(InfoCommand, AgreesWithAnIndependentLookAtEverySharedRecording) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
    if (entry.path().extension() != ".dsa") continue;
    // Every grasp by class is alike; a tenth of them is enough here (the reader's own tests take
    // all).
    if (entry.path().string().find("grasps_by_class") != std::string::npos && files++ % 10 != 0)
      continue;
    const Json info = infoOf(entry.path());
    const PlainFacts facts = factsOf(entry.path());
    EXPECT_EQ(info.at("frames").asInteger(), facts.frames) << entry.path();
    EXPECT_EQ(info.at("temperatures").asInteger(), facts.temperatures) << entry.path();
    EXPECT_EQ(info.at("joint_angles").asInteger(), facts.angles) << entry.path();
    EXPECT_NEAR(info.at("duration_s").asDouble(), facts.durationS, 1e-9) << entry.path();
    EXPECT_EQ(info.at("serial").asString(), "1D9B0057") << entry.path();
    // The survey found nothing odd but optional elements that are missing in a few files.
    for (std::size_t i = 0; i < info.at("warnings").size(); ++i)
      EXPECT_EQ(info.at("warnings").at(i).asString().rfind("no element ", 0), 0u) << entry.path();
    ASSERT_EQ(info.at("matrices").size(), 6u) << entry.path();
    for (std::size_t m = 0; m < 6; ++m)
      EXPECT_EQ(info.at("matrices").at(m).at("taxels").asInteger(), m % 2 ? 68 : 84);
    EXPECT_LE(info.at("max_value").asDouble(), 3567.0) << entry.path();  // the survey's largest
  }
  EXPECT_GT(files, 100);
}

TEST(InfoCommand, AgreesWithTheSurvey) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const Json noise = infoOf(*folder / "calibration_noise" / "temperature-noise.dsa");
  EXPECT_EQ(noise.at("frames").asInteger(), 1297);
  EXPECT_NEAR(noise.at("duration_s").asDouble(), 3893.7, 0.05);
  EXPECT_NEAR(noise.at("rate_hz").asDouble(), 0.33, 0.005);
  EXPECT_EQ(noise.at("gaps").asInteger(), 0);  // a frame every 3 s has no gaps
  const Json slip = infoOf(*folder / "slip-detection" / "slip_test.dsa");
  ASSERT_EQ(slip.at("gaps").asInteger(), 1);
  EXPECT_NEAR(slip.at("gap_list").at(0).at("seconds").asDouble(), 147.5, 0.05);
  const Json masked = infoOf(*folder / "misc" / "masked_matrix.dsa");
  EXPECT_NEAR(masked.at("mean_rate_hz").asDouble(), 54.8, 0.1);
  EXPECT_EQ(masked.at("joint_angles").asInteger(), 0);
  EXPECT_EQ(masked.at("temperatures").asInteger(), 0);
  const Json sensitivity = infoOf(*folder / "calibration_sensitivity" / "sensitivity_0.1-1.0.dsa");
  EXPECT_EQ(sensitivity.at("frames").asInteger(), 6912);
  EXPECT_NEAR(sensitivity.at("duration_s").asDouble(), 224.7, 0.05);
}

TEST(InfoCommand, SaysWhatIsWrongWithAFile) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "empty.dsa", "");
  testing::writeFile(folder / "text.dsa", "hello");
  expectOneLineError(palpate({"info", folder / "missing.dsa"}), 1, {"missing.dsa", "No such file"});
  expectOneLineError(palpate({"info", folder / "empty.dsa"}), 1, {"empty"});
  expectOneLineError(palpate({"info", folder / "text.dsa"}), 1, {"text.dsa"});
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(InfoCommand, ControlCharactersOfNamesDoNotReachTheTerminal) {
  const testing::TemporaryFolder folder;
  const std::string name = "x\x1b]0;title\ay.dsa";
  for (const std::string& file : {name, std::string("z.dsa")}) {
    const auto made = palpate({"synthesize", "-o", folder / file, "--duration", "1"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_EQ(made.out.find_first_of("\x1b\a"), std::string::npos);
  }
  for (const auto& path : {folder.path(), folder / name}) {
    const auto result = palpate({"info", path});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out.find_first_of("\x1b\a"), std::string::npos);
    EXPECT_NE(result.out.find("x\\x1B]0;title\\x07y.dsa"), std::string::npos) << result.out;
  }
}

TEST(InfoCommand, OfSeveralItPrintsOneTable) {
  const testing::TemporaryFolder folder;
  // One frame has no rate; its value 100 and the mask are written out here.
  testing::writeFile(folder / "one, frame.dsa",
                     "<?xml version=\"1.0\" encoding=\"utf-8\"?><root><sensor name=\"\">"
                     "<serial_nr>00000001</serial_nr><num_matrices>1</num_matrices>"
                     "<matrix index=\"0\"><cells_x>3</cells_x><cells_y>1</cells_y>"
                     "<texel_width>3.4</texel_width><texel_height>3.4</texel_height>"
                     "<static_mask>111</static_mask><dynamic_mask>111</dynamic_mask>"
                     "</matrix></sensor><data><frame_count>7</frame_count>"
                     "<frame index=\"0\"><time_stamp>1400000000000</time_stamp>"
                     "<frame_data>42C80000 C0000000</frame_data></frame></data></root>");
  ASSERT_EQ(
      palpate({"synthesize", "-o", folder / "z.dsa", "--duration", "2", "--rate", "10"}).exitCode,
      0);
  const auto result = palpate({"info", folder.path()});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const auto lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), 3u) << result.out;
  EXPECT_EQ(
      lines[0],
      "file,format,value_type,frames,duration_s,rate_hz,mean_rate_hz,gaps,temperatures,"
      "joint_angles,max_value,saturated_frames,serial,warnings,operator,object,run,notes,labels,"
      "events,lost");
  const std::string quoted = "\"" + (folder / "one, frame.dsa").string() + "\"";
  EXPECT_EQ(lines[1].rfind(quoted + ",dsa,counts,1,0,,,0,0,0,100,0,00000001,", 0), 0u) << lines[1];
  EXPECT_NE(lines[1].find("says \"\"7\"\", found 1", quoted.size()), std::string::npos) << lines[1];
  EXPECT_EQ(lines[2].rfind((folder / "z.dsa").string() + ",dsa,counts,21,2,10,10,0,", 0), 0u)
      << lines[2];
  // The same with the files named one by one.
  EXPECT_EQ(palpate({"info", folder / "one, frame.dsa", folder / "z.dsa"}).out, result.out);
  const Json json = Json::parse(palpate({"info", folder.path(), "--json"}).out);
  ASSERT_EQ(json.at("recordings").size(), 2u);
  const Json last = json.at("recordings").at(1);
  EXPECT_EQ(last.at("file").asString(), (folder / "z.dsa").string());
  EXPECT_EQ(last.at("frames").asInteger(), 21);
  EXPECT_EQ(last.at("matrices").size(), 6u);
}

TEST(InfoCommand, WritesWhatItPrintsToAFile) {
  const testing::TemporaryFolder folder;
  const std::string a = folder / "in/a.dsa", b = folder / "in/b.dsa", none = folder / "none.dsa";
  fs::create_directory(folder / "in");
  for (const std::string& file : {a, b})
    ASSERT_EQ(palpate({"synthesize", "-o", file, "--duration", "1"}).exitCode, 0);
  const auto written = [&](std::vector<std::string> words, const std::string& out) {
    words.insert(words.begin(), "info");
    words.insert(words.end(), {"-o", folder / out});
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, (folder / out).string() + "\n");
    return testing::readFile(folder / out);
  };
  EXPECT_EQ(written({a}, "one.json"), palpate({"info", a, "--json"}).out);
  EXPECT_EQ(written({a, b}, "two.json"), palpate({"info", a, b, "--json"}).out);
  const std::string table = palpate({"info", a, b}).out;
  EXPECT_EQ(written({folder / "in"}, "two.csv"), table);
  EXPECT_EQ(written({a}, "one.csv"), table.substr(0, table.find('\n', table.find(a)) + 1));
  expectOneLineError(palpate({"info", a, "-o", folder / "two.csv"}), 1, {"two.csv"});
  expectOneLineError(palpate({"info", a, "-o", folder / "x.png"}), 2, {".csv, .json"});
  expectOneLineError(palpate({"info", none, "-o", folder / "none.csv"}), 1, {"none.dsa"});
  EXPECT_FALSE(fs::exists(folder / "none.csv"));
}

// A recording as the recorder makes it, with what was asked before and marked during it.
void writeWithNotes(const fs::path& path) {
  PalpateWriter writer(path,
                       sdh2().layout,
                       {{"operator", "Ada"},
                        {"object", "tennis ball"},
                        {"run", "7"},
                        {"notes", "first line\nsecond"}});
  constexpr std::int64_t kStartUs = 1'400'000'000'000'000;
  for (int i = 0; i < 4; ++i) {
    TactileFrame frame(sdh2().layout);
    frame.hostUs = kStartUs + i * 500'000;
    frame.matrix(1)(2, 3) = static_cast<float>(100 + i);
    writer.addFrame(frame);
  }
  writer.addEvent(
      {kStartUs + 250'000, kStartUs + 250'000, "label", {}, "touched", "{\"digit\":3}"});
  writer.addEvent({kStartUs + 500'000, kStartUs + 1'500'000, "gap", 2, "no data", ""});
  writer.addEvent({kStartUs + 600'000,
                   kStartUs + 700'000,
                   "gap",
                   {},
                   "9 angle samples lost: the file was damaged",
                   R"({"stream":"angles","lost":9,"reason":"the file was damaged"})"});
  writer.finish();
}

// The gaps are those of the frames alone.
TEST(InfoCommand, SaysWhatWasLostBesideTheGaps) {
  const testing::TemporaryFolder folder;
  writeWithNotes(folder / "a.palpate");
  const Json lost = infoOf(folder / "a.palpate").at("lost");
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost.at(0).at("stream").asString(), "tactile");
  EXPECT_TRUE(lost.at(0).at("lost").isNull()) << "the event doesn't tell how many";
  EXPECT_EQ(lost.at(1).at("stream").asString(), "angles");
  EXPECT_EQ(lost.at(1).at("lost").asInteger(), 9);
  EXPECT_EQ(lost.at(1).at("spans").asInteger(), 1);
  EXPECT_NEAR(lost.at(1).at("seconds").asDouble(), 0.1, 1e-9);
  const std::string text = palpate({"info", folder / "a.palpate"}).out;
  for (const char* line : {"gaps              0 (of the frames)\n",
                           "lost              frames, how many is not known, in 1 span, 1.00 s\n",
                           "lost              9 angle samples in 1 span, 0.10 s\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  const auto table = palpate({"info", folder / "a.palpate", folder / "a.palpate"});
  EXPECT_TRUE(
      table.out.ends_with(",3,\"frames, how many is not known, in 1 span, 1.00 s; 9 angle samples "
                          "in 1 span, 0.10 s\"\n"))
      << table.out;
}

TEST(InfoCommand, SaysWhoRecordedWhatAndWhatWasNoted) {
  const testing::TemporaryFolder folder;
  writeWithNotes(folder / "a.palpate");
  const Json info = infoOf(folder / "a.palpate");
  EXPECT_EQ(info.at("operator").asString(), "Ada");
  EXPECT_EQ(info.at("object").asString(), "tennis ball");
  EXPECT_EQ(info.at("run").asString(), "7");
  EXPECT_EQ(info.at("notes").asString(), "first line\nsecond");
  ASSERT_EQ(info.at("labels").size(), 1u);
  EXPECT_EQ(info.at("labels").at(0).asString(), "touched");
  ASSERT_EQ(info.at("events").size(), 3u);
  const Json label = info.at("events").at(0), gap = info.at("events").at(1);
  EXPECT_EQ(label.at("time_ms").asInteger(), 1'400'000'000'250);
  EXPECT_EQ(label.at("kind").asString(), "label");
  EXPECT_EQ(label.at("json").at("digit").asInteger(), 3);
  EXPECT_TRUE(label.at("matrix").isNull());
  EXPECT_EQ(gap.at("end_ms").asInteger(), 1'400'000'001'500);
  EXPECT_EQ(gap.at("matrix").asInteger(), 2);
  const std::string text = palpate({"info", folder / "a.palpate"}).out;
  for (const char* line : {"operator          Ada\n",
                           "object            tennis ball\n",
                           "run               7\n",
                           "labels            touched\n",
                           "  0.25 s          label: touched\n",
                           "  0.50 to 1.50 s  gap, matrix 2: no data\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

TEST(InfoCommand, SaysHowATableBecomesARecording) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "x.CSV", "time,value\n1,2\n");
  testing::writeFile(folder / "x.dsa", "time,value\n1,2\n");
  expectOneLineError(palpate({"info", folder / "x.CSV"}), 1, {"File > Import", "palpate import"});
  EXPECT_EQ(palpate({"info", folder / "x.dsa"}).err.find("Import"), std::string::npos);
}

// Folders that are made in a folder.
class MadeFolders {
 public:
  explicit MadeFolders(const fs::path& folder) : watch_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    EXPECT_GE(::inotify_add_watch(watch_, folder.c_str(), IN_CREATE), 0);
  }
  ~MadeFolders() { ::close(watch_); }
  // Until now.
  int count() const {
    alignas(inotify_event) std::array<char, 4096> events{};
    int made = 0;
    for (ssize_t size = 0; (size = ::read(watch_, events.data(), events.size())) > 0;)
      for (ssize_t at = 0; at < size;) {
        const auto* event = reinterpret_cast<const inotify_event*>(events.data() + at);
        made += (event->mask & IN_ISDIR) != 0 ? 1 : 0;
        at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      }
    return made;
  }

 private:
  int watch_;
};

// One that was killed is copied to be opened, and may be large.
TEST(InfoCommand, OpensAKilledRecordingOnce) {
  const testing::TemporaryFolder folder, temporary;
  writeWithNotes(folder / "a.palpate");
  testing::writeFile(folder / "a.palpate-journal", "to be played back");
  const MadeFolders copies(temporary.path());
  const auto result =
      palpate({"info", folder / "a.palpate", "--json"}, {{"TMPDIR", temporary.path().string()}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out).at("operator").asString(), "Ada");
  EXPECT_EQ(Json::parse(result.out).at("events").size(), 3u);
  EXPECT_EQ(copies.count(), 1);
}

TEST(InfoCommand, OfADamagedOneSaysWhoRecordedItAndWhatIsMissing) {
  const testing::TemporaryFolder folder;
  writeWithNotes(folder / "a.palpate");
  std::string bytes = testing::readFile(folder / "a.palpate");
  const testing::BlockBytes block = testing::blockBytes(folder / "a.palpate").at(0);
  bytes[block.end - 1] = static_cast<char>(bytes[block.end - 1] ^ 1);
  testing::writeFile(folder / "a.palpate", bytes);
  const auto result = palpate({"info", folder / "a.palpate", "--json"});
  EXPECT_EQ(result.exitCode, 3) << result.err;
  const Json info = Json::parse(result.out);
  EXPECT_EQ(info.at("frames").asInteger(), static_cast<std::int64_t>(4 - block.n));
  EXPECT_EQ(info.at("operator").asString(), "Ada");
  EXPECT_EQ(info.at("labels").at(0).asString(), "touched");
  ASSERT_EQ(info.at("warnings").size(), 1u);
  EXPECT_NE(info.at("warnings").at(0).asString().find("lost frame"), std::string::npos);
}

TEST(InfoCommand, ReadsTheNotesBesideADsa) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(palpate({"synthesize", "-o", folder / "z.dsa", "--duration", "1"}).exitCode, 0);
  EXPECT_EQ(infoOf(folder / "z.dsa").at("events").size(), 0u);
  const std::int64_t us = openRecording(folder / "z.dsa").frameTimeUs(3);
  saveEvents(folder / "z.dsa", {}, std::vector<Event>{{us, us, "label", {}, "held", ""}});
  const Json info = infoOf(folder / "z.dsa");
  ASSERT_EQ(info.at("labels").size(), 1u);
  EXPECT_EQ(info.at("labels").at(0).asString(), "held");
  EXPECT_EQ(info.at("events").at(0).at("time_ms").asInteger(), us / 1000);
  EXPECT_EQ(info.at("operator").asString(), "");
}

TEST(InfoCommand, OneBadFileOfSeveralDoesNotStopTheOthers) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "bad.dsa", "hello");
  ASSERT_EQ(palpate({"synthesize", "-o", folder / "good.dsa", "--duration", "1"}).exitCode, 0);
  const auto table = palpate({"info", folder.path()});
  expectOneLineError(table, 3, {"bad.dsa"});
  EXPECT_EQ(linesOf(table.out).size(), 2u);
  const auto json = palpate({"info", folder / "missing.dsa", folder.path(), "--json"});
  EXPECT_EQ(json.exitCode, 3);
  EXPECT_NE(json.err.find("2 of 3 recordings failed"), std::string::npos) << json.err;
  EXPECT_EQ(Json::parse(json.out).at("recordings").size(), 1u);
  const auto none = palpate({"info", folder / "bad.dsa", folder / "missing.dsa", "--json"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_EQ(Json::parse(none.out).at("recordings").size(), 0u);
}

// Each row of the table over all shared recordings is what `info FILE --json` says of that file.
TEST(InfoCommand, TheTableOverAllSharedRecordingsHasEveryOne) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(*folder))
    if (entry.path().extension() == ".dsa") files.push_back(entry.path());
  EXPECT_EQ(files.size(), 609u);  // data/README.md
  const auto result = palpate({"info", folder->string()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  auto lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), files.size() + 1);
  lines.erase(lines.begin());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return a < b; });
  for (std::size_t i = 0; i < files.size(); ++i) {
    ASSERT_EQ(lines[i].substr(0, lines[i].find(',')), files[i]);
    if (i % 50 != 0) continue;
    const Json info = infoOf(files[i]);
    const std::string row = files[i] + ",dsa,counts," +
                            std::to_string(info.at("frames").asInteger()) + "," +
                            numberText(info.at("duration_s").asDouble()) + "," +
                            numberText(info.at("rate_hz").asDouble()) + ",";
    EXPECT_EQ(lines[i].rfind(row, 0), 0u) << lines[i];
  }
}

}  // namespace
}  // namespace palpate::info_command_test
