#include <chrono>

#include "palpate/core/json.h"
#include "palpate/device/byte_channel.h"

#include "commands/palpate_program.h"
#include "device/fake_sdh_hand.h"
#include "device/fake_tactile_answers.h"
#include "device/pty_server.h"
#include "testing/time_limit.h"

namespace palpate::ports_command_test {
namespace {

using testing::Bytes;
using testing::expectOneLineError;
using testing::FakeSdhHand;
using testing::FakeTactileAnswers;
using testing::palpate;
using testing::PtyPair;
using testing::PtyServer;

// The two controllers of a hand on ptys, and a line where nobody answers.
class PortsCommand : public ::testing::Test {
 protected:
  FakeSdhHand hand;
  FakeTactileAnswers controller;
  PtyServer motion{[this](const Bytes& request) { return hand.receive(request); }};
  PtyServer tactile{[this](const Bytes& request) { return controller.receive(request); }};
  PtyPair silent;

  // The object of that port in `palpate ports --json`.
  static Json portOf(const Json& report, const std::string& name) {
    const Json list = report.at("ports");
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list.at(i).at("port").asString() == name) return list.at(i);
    ADD_FAILURE() << name << " is not in the list";
    return Json::object().set("answer", "");
  }
  // The line of `text` that begins with `name`.
  static std::string lineOf(const std::string& text, const std::string& name) {
    const std::size_t at = text.find(name + " ");
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
  }
};

TEST_F(PortsCommand, SaysWhichControllerIsWhere) {
  const auto start = std::chrono::steady_clock::now();
  const auto result = palpate({"ports", motion.path(), tactile.path(), silent.path()});
  EXPECT_LT(std::chrono::steady_clock::now() - start, testing::timeLimit(std::chrono::seconds(6)))
      << "one by one?";
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out.rfind("port ", 0), 0u) << result.out;
  const std::string motionLine = lineOf(result.out, motion.path());
  EXPECT_NE(motionLine.find("motion controller, firmware 0.0.3.3, serial 48"), std::string::npos)
      << result.out;
  const std::string tactileLine = lineOf(result.out, tactile.path());
  EXPECT_NE(tactileLine.find("tactile controller, firmware 2.9.0.0, serial 1D9B0057"),
            std::string::npos)
      << result.out;
  EXPECT_NE(lineOf(result.out, silent.path()).find("nothing answers"), std::string::npos);
  EXPECT_NE(result.out.find("--dsa " + tactile.path() + " --sdh " + motion.path()),
            std::string::npos)
      << result.out;
}

TEST_F(PortsCommand, SaysTheSameAsJson) {
  const auto result =
      palpate({"ports", "--json", motion.path(), tactile.path(), "/dev/ttyNONE5", "tcp:nonsense"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_EQ(portOf(report, motion.path()).at("answer").asString(), "motion");
  EXPECT_EQ(portOf(report, motion.path()).at("firmware").asString(), "0.0.3.3");
  EXPECT_EQ(portOf(report, motion.path()).at("serial").asString(), "48");
  EXPECT_TRUE(portOf(report, motion.path()).at("by_id").isNull());
  EXPECT_EQ(portOf(report, tactile.path()).at("answer").asString(), "tactile");
  EXPECT_EQ(portOf(report, tactile.path()).at("serial").asString(), "1D9B0057");
  EXPECT_EQ(portOf(report, "/dev/ttyNONE5").at("answer").asString(), "not_found");
  EXPECT_EQ(portOf(report, "tcp:nonsense").at("answer").asString(), "not_found");
}

TEST_F(PortsCommand, WritesTheListToAFile) {
  const testing::TemporaryFolder folder;
  const std::string csv = folder / "ports.csv";
  const auto result = palpate({"ports", "-o", csv, tactile.path()});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, csv + "\n");
  const std::string table = testing::readFile(csv);
  EXPECT_TRUE(table.starts_with("port,by_id,description,usb,answer,firmware,serial,message\n"));
  EXPECT_NE(table.find(tactile.path() + ",,,0,tactile,2.9.0.0,1D9B0057,"), std::string::npos)
      << table;
  expectOneLineError(palpate({"ports", "--no-probe", "-o", csv}), 1, {"ports.csv"});
  expectOneLineError(palpate({"ports", silent.path(), "-o", "x.txt"}), 2, {".csv, .json"});
  EXPECT_EQ(silent.receive(0), Bytes{}) << "bytes were sent";
}

TEST_F(PortsCommand, LeavesAloneWhatAnotherProgramHolds) {
  const auto held = openChannel(silent.path());
  const auto result = palpate({"ports", "--json", silent.path()});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(portOf(Json::parse(result.out), silent.path()).at("answer").asString(), "busy");
  EXPECT_EQ(silent.receive(0), Bytes{}) << "bytes were sent";
}

TEST_F(PortsCommand, SendsNothingWhenToldSo) {
  const auto result = palpate({"ports", "--json", "--no-probe", motion.path(), silent.path()});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(portOf(Json::parse(result.out), motion.path()).at("answer").asString(), "not_asked");
  EXPECT_EQ(silent.receive(0), Bytes{}) << "bytes were sent";
  motion.between([&] { EXPECT_EQ(hand.bytesSeen, 0u); });
}

// Whatever is attached to the machine that runs these tests.
TEST_F(PortsCommand, AsksOnlyTheNamedOnes) {
  const auto result = palpate({"ports", "--json", motion.path()});
  const Json list = Json::parse(result.out).at("ports");
  for (std::size_t i = 0; i < list.size(); ++i)
    EXPECT_EQ(list.at(i).at("answer").asString(),
              list.at(i).at("port").asString() == motion.path() ? "motion" : "not_asked");
}

TEST_F(PortsCommand, AsksAPortOfTwoNamesOnce) {
  const testing::TemporaryFolder folder;
  const std::string link = folder / "hand";
  std::filesystem::create_symlink(motion.path(), link);
  const auto result = palpate({"ports", "--json", link, motion.path(), link});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(portOf(Json::parse(result.out), link).at("answer").asString(), "motion");
  EXPECT_EQ(result.out.find("busy"), std::string::npos) << result.out;
}

TEST(PortsCommandUsage, ExplainsItselfAndRefusesWhatItDoesNotKnow) {
  const auto help = palpate({"ports", "--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.out.find("--no-probe"), std::string::npos);
  expectOneLineError(palpate({"ports", "--frobnicate"}), 2, {"frobnicate"});
  EXPECT_EQ(palpate({"ports", "--no-probe"}).exitCode, 0);
}

}  // namespace
}  // namespace palpate::ports_command_test
