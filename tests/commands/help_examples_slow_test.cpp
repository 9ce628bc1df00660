// Every command's help has an example, and every example works as it stands there: it is run in a
// folder with files of the names that it uses. Serial ports are replaced by those of an emulated
// hand.
#include <algorithm>
#include <csignal>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "palpate/core/number_text.h"

#include "commands/recognition_folder.h"

namespace palpate::help_examples_slow_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

std::vector<std::string> linesIn(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  return all;
}

// The lines below "Example:" or "Examples:".
std::vector<std::string> examplesIn(const std::string& help) {
  std::vector<std::string> examples;
  bool within = false;
  for (const std::string& line : linesIn(help)) {
    if (line.starts_with("Example")) within = true;
    if (within && line.starts_with("  palpate ")) examples.push_back(line.substr(2));
  }
  return examples;
}

std::string helpOf(std::vector<std::string> words) {
  words.emplace_back("--help");
  const ProgramResult result = palpate(words);
  EXPECT_EQ(result.exitCode, 0) << words.front() << ": " << result.err;
  return result.out;
}

// The names in a list of commands or kinds: lines that begin with two spaces and a name.
std::vector<std::vector<std::string>> allCommands() {
  const std::string help = helpOf({});
  std::vector<std::vector<std::string>> all;
  const std::regex name("  ([a-z][-a-z]*) .*");
  std::smatch match;
  for (const std::string& line : linesIn(help.substr(help.find("\nCommands:"))))
    if (std::regex_match(line, match, name)) all.push_back({match[1]});
  for (const std::string& line : linesIn(helpOf({"calibrate"})))
    if (std::regex_match(line, match, name) && line[3] != ' ' && !line.starts_with("  palpate"))
      all.push_back({"calibrate", match[1]});
  return all;
}

// Listens for UDP datagrams at a port of this machine.
class Datagrams {
 public:
  Datagrams() : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
        ::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
      port_ = ntohs(address.sin_port);
  }
  ~Datagrams() { ::close(fd_); }
  Datagrams(const Datagrams&) = delete;
  Datagrams& operator=(const Datagrams&) = delete;
  // A port that was free; 0: none could be had.
  int port() const noexcept { return port_; }
  bool arrived() const noexcept {
    char byte = 0;
    return ::recv(fd_, &byte, 1, 0) >= 0;
  }

 private:
  int fd_;
  int port_ = 0;
};

class HelpExamples : public ::testing::Test {
 protected:
  void SetUp() override {
    recordings_ = recordingsFolder();
    PALPATE_NEED(recordings_);
  }

  fs::path at(const std::string& name) const { return folder_ / name; }

  // Runs a line of a shell in the folder, with the program of the build as `palpate`.
  std::string shell(const std::string& line) const {
    return "cd '" + folder_.path().string() + "' && export PATH='" +
           fs::path(PALPATE_PROGRAM).parent_path().string() +
           "':$PATH HOME=$PWD XDG_CONFIG_HOME=$PWD" +
           " XDG_DATA_HOME=$PWD XDG_STATE_HOME=$PWD XDG_CACHE_HOME=$PWD XDG_RUNTIME_DIR=$PWD && " +
           line;
  }
  ProgramResult run(const std::string& line) const {
    return runProgram("/bin/sh", {"-c", shell(line)});
  }
  std::unique_ptr<BackgroundProgram> begin(const std::string& line) const {
    return std::make_unique<BackgroundProgram>(
        "/bin/sh", std::vector<std::string>{"-c", shell("exec " + line)});
  }
  void must(const std::string& line) const {
    const ProgramResult result = run(line);
    ASSERT_EQ(result.exitCode, 0) << line << ": " << result.err;
  }

  // A real recording of this name, else a copy of foam_ball.dsa.
  void copyRecording(const std::string& name) const {
    for (const auto& entry : fs::recursive_directory_iterator(*recordings_))
      if (entry.path().filename() == name) return fs::copy_file(entry.path(), at(name)), void();
    fs::copy_file(*recordings_ / "grasps/foam_ball.dsa", at(name));
  }
  // The pressures are made up: what counts is the shape of the table.
  void makeWeights() const {
    std::string table = "file,pressure_kpa\n";
    for (const char* place : {"room", "operating", "high"})
      for (int i = 0; i < 8; ++i) {
        const std::string name = std::string(1, static_cast<char>('A' + i)) + "1.dsa";
        table += (*recordings_ / "pressure_calibration" / place / name).string() + "," +
                 numberText(2.0 + 3.0 * i) + "\n";
      }
    writeFile(at("weights.csv"), table);
  }
  void makeTable() const {
    std::string text = "time_ms";
    for (int i = 0; i < 256; ++i) text += ",taxel" + std::to_string(i);
    for (int row = 0; row < 20; ++row) {
      text += "\n" + std::to_string(10 * row);
      for (int i = 0; i < 256; ++i) text += "," + std::to_string((row + i) % 1000);
    }
    writeFile(at("pad.csv"), text + "\n");
  }

  // Makes what an example reads; the others of its words are what it writes.
  void makeFile(const std::string& word) const {
    static const std::vector<std::string> copied = {"foam_ball.dsa",
                                                    "hockey_ball.dsa",
                                                    "bottle.dsa",
                                                    "run_1.dsa",
                                                    "run_2.dsa",
                                                    "A1.dsa",
                                                    "temperature-noise.dsa",
                                                    "sensitivity_0.1-1.0.dsa",
                                                    "roughness_test_rough.dsa"};
    if (fs::exists(at(word))) return;
    if (std::find(copied.begin(), copied.end(), word) != copied.end()) return copyRecording(word);
    if (word == "recordings") return fs::create_symlink(*recordings_ / "grasps_by_class", at(word));
    if (word == "grasp.dsa") return saveGrasps(at(word), 16.0, 3, 9);
    if (word == "touch.dsa") return saveTouches(at(word), -1.0);
    if (word == "weights.csv") return makeWeights();
    if (word == "pad.csv") return makeTable();
    if (word == "my_hand")
      return fs::copy(dataFolder() / "hands/flat_pad_16x16", at(word), fs::copy_options::recursive);
    if (word == "session.palpate" || word == "grasp.palpate")
      return must("palpate convert -q " + (*recordings_ / "grasps/foam_ball.dsa").string() + " " +
                  word);
    if (word == "broken.dsa") {
      // Two bzip2 blocks are left; the first of them is whole.
      const std::string whole =
          readFile(*recordings_ / "calibration_sensitivity/sensitivity_0.1-1.0.dsa");
      return writeFile(at(word), whole.substr(0, whole.size() / 2));
    }
    if (word == "objects.json") {
      saveThings(at("things"), 10, 1);
      saveTouches(at("zero.dsa"), -1.0);
      return must("palpate train -q things -o objects.json --empty-hand-zero zero.dsa");
    }
    if (word == "hand.json") {
      makeWeights();
      return must("palpate calibrate pressure -q weights.csv --area 110 -o hand.json");
    }
  }
  void makeInputs(const std::string& line) const {
    // What follows -o or > is made by the example.
    std::istringstream words(line);
    bool written = false;
    for (std::string word; words >> word;) {
      if (!written) makeFile(word);
      written = word == "-o" || word == ">" || word == "--output";
    }
  }
  // The emulated hand with its two ports in the folder.
  std::unique_ptr<BackgroundProgram> hand() const {
    auto emulated = begin("palpate emulate --dsa ttyUSB0 --sdh ttyUSB1 --scene ball");
    EXPECT_TRUE(emulated->awaitLine("dsa=")) << emulated->err();
    return emulated;
  }

  std::optional<fs::path> recordings_;
  const TemporaryFolder folder_;
};

std::string withPortsOf(const std::string& line, const fs::path& folder) {
  const std::string ports = std::regex_replace(line, std::regex("/dev/"), folder.string() + "/");
  return std::regex_replace(ports, std::regex("/tmp/(dsa|sdh)"), folder.string() + "/$1");
}

TEST_F(HelpExamples, EveryCommandHasOneOfItself) {
  const auto all = allCommands();
  EXPECT_GT(all.size(), 35u);
  for (const auto& words : all) {
    const auto examples = examplesIn(helpOf(words));
    EXPECT_FALSE(examples.empty()) << words.back();
    for (const std::string& example : examples)
      EXPECT_TRUE(example.starts_with("palpate " + words.front())) << example;
  }
}

TEST_F(HelpExamples, ThoseThatEndByThemselvesSucceed) {
  // These need a hand or run until they are stopped; a test each, below.
  const std::vector<std::string> others = {"emulate", "record", "stream", "grasp", "remote"};
  int run = 0;
  for (const auto& words : allCommands()) {
    if (std::find(others.begin(), others.end(), words.front()) != others.end()) continue;
    for (const std::string& example : examplesIn(helpOf(words))) {
      makeInputs(example);
      const ProgramResult result = this->run(example);
      // Of the broken recording something is lost: 3, as its help says.
      EXPECT_EQ(result.exitCode, words.front() == "recover" ? 3 : 0) << example << "\n"
                                                                     << result.err;
      // What it is said to write is there.
      std::smatch match;
      if (std::regex_search(example, match, std::regex("(?:-o|>) (\\S+)"))) {
        EXPECT_TRUE(fs::exists(at(match[1])) && !fs::is_empty(at(match[1]))) << example;
      }
      ++run;
      // The next example may write a file of the same name.
      for (const auto& entry : fs::directory_iterator(folder_.path())) fs::remove_all(entry.path());
    }
  }
  EXPECT_GT(run, 30);
}

TEST_F(HelpExamples, EmulateRunsUntilItIsStopped) {
  for (const std::string& example : examplesIn(helpOf({"emulate"}))) {
    const auto program = begin(withPortsOf(example, folder_.path()));
    ASSERT_TRUE(program->awaitLine("dsa=")) << program->err();
    EXPECT_TRUE(fs::exists(at("dsa")) && fs::exists(at("sdh")));
    program->signal(SIGINT);
    EXPECT_EQ(program->wait(), 0) << program->err();
  }
}

TEST_F(HelpExamples, RecordRunsUntilItIsStopped) {
  const auto emulated = hand();
  for (const std::string& example : examplesIn(helpOf({"record"}))) {
    const auto program = begin(withPortsOf(example, folder_.path()));
    ASSERT_TRUE(awaited([&] { return fs::exists(at("grasp.palpate")); })) << program->err();
    EXPECT_EQ(interruptAtWork(*program), 0) << program->err();
    must("palpate verify -q grasp.palpate");
  }
}

TEST_F(HelpExamples, StreamRunsUntilItIsStopped) {
  const auto emulated = hand();
  for (const std::string& example : examplesIn(helpOf({"stream"}))) {
    // To a free port instead of the usual one, which another program may use.
    const Datagrams listener;
    ASSERT_GT(listener.port(), 0);
    const auto program = begin(withPortsOf(example, folder_.path()) +
                               " --to signals:" + std::to_string(listener.port()));
    ASSERT_TRUE(awaited([&] { return listener.arrived(); })) << program->err();
    program->signal(SIGINT);
    EXPECT_EQ(program->wait(), 0) << program->err();
  }
}

TEST_F(HelpExamples, GraspMovesTheHand) {
  const auto emulated = hand();
  for (const std::string& example : examplesIn(helpOf({"grasp"}))) {
    const ProgramResult result = run(withPortsOf(example, folder_.path()));
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  }
}

TEST_F(HelpExamples, RemoteControlsARecorder) {
  const auto emulated = hand();
  fs::create_directory(at("runs"));
  const auto recorder = begin("palpate record --dsa ttyUSB0 -o runs --remote");
  ASSERT_TRUE(recorder->awaitLine("remote=")) << recorder->err();
  // Nothing is recorded before the hand sends frames.
  ASSERT_TRUE(awaited([&] {
    return run("palpate remote status").out.find("\"rate_hz\":null") == std::string::npos;
  }));
  for (const std::string& example : examplesIn(helpOf({"remote"}))) {
    const ProgramResult result = run(example);
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  }
  recorder->signal(SIGINT);
  EXPECT_EQ(recorder->wait(), 0) << recorder->err();
  EXPECT_FALSE(fs::is_empty(at("runs")));
}

}  // namespace
}  // namespace palpate::help_examples_slow_test
