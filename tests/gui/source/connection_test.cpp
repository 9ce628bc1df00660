#include "gui/source/connection.h"

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::connection_test {
namespace {

class ConnectionTest : public ::testing::Test {
 protected:
  ConnectionTest() : path_(QString::fromStdString((folder_ / "palpate.ini").string())) {}
  // As another start of the program sees it.
  Connection reloaded() {
    QSettings settings(path_, QSettings::IniFormat);
    return loadConnection(settings);
  }
  void store(const Connection& connection) {
    QSettings settings(path_, QSettings::IniFormat);
    saveConnection(connection, settings);
  }
  void store(const QString& key, const QVariant& value) {
    QSettings(path_, QSettings::IniFormat).setValue(key, value);
  }

  const testing::TemporaryFolder folder_;
  const QString path_;
};

TEST_F(ConnectionTest, AFirstStartOffersTheBall) {
  const Connection connection = reloaded();
  EXPECT_EQ(connection.kind, Connection::Kind::kEmulated);
  EXPECT_EQ(connection.scene, "ball");
  EXPECT_FALSE(connection.sceneScriptRuns);
  EXPECT_TRUE(problemOf(connection).isEmpty());
}

TEST_F(ConnectionTest, ComesBackFromTheSettingsAsItWas) {
  for (const Connection::Kind kind : kAllConnectionKinds) {
    const Connection connection = {
        .kind = kind,
        .dsaPort = "/dev/serial/by-id/usb-FTDI, Ltd-if00",
        .sdhPort = "tcp:[::1]:13000",
        .scene = "/home/müller/my scene.json",
        .sceneScriptRuns = true,
        .recording = "/data/a;b %1.palpate",
        .stream = {.source = "listen:[::1]:9871",
                   .hand = "/home/müller/my hand",
                   .format = StreamFormat::kBinary,
                   .time = StreamTime::kMilliseconds,
                   .baud = 1'000'000},
    };
    store(connection);
    EXPECT_EQ(reloaded(), connection);
  }
}

TEST_F(ConnectionTest, SeveralAreKeptUnderTheirNames) {
  Connection left = {.kind = Connection::Kind::kPorts, .dsaPort = "a", .sdhPort = "b"};
  Connection right = {.kind = Connection::Kind::kReplay, .recording = "/x.palpate"};
  {
    QSettings settings(path_, QSettings::IniFormat);
    EXPECT_TRUE(connectionNames(settings).isEmpty());
    saveNamedConnection(settings, "left hand", left);
    saveNamedConnection(settings, "bench 1/2, ü %", right);
  }
  QSettings settings(path_, QSettings::IniFormat);
  EXPECT_EQ(connectionNames(settings), (QStringList{"bench 1/2, ü %", "left hand"}));
  left.name = "left hand";
  EXPECT_EQ(namedConnection(settings, "left hand"), left);
  right.name = "bench 1/2, ü %";
  EXPECT_EQ(namedConnection(settings, "bench 1/2, ü %"), right);
  EXPECT_EQ(namedConnection(settings, "other"), std::nullopt);
  EXPECT_EQ(loadConnection(settings), Connection{}) << "the last one is another matter";
  saveConnection(left, settings);
  EXPECT_EQ(loadConnection(settings).name, "left hand");
  saveNamedConnection(settings, "left hand", right);
  right.name = "left hand";
  EXPECT_EQ(namedConnection(settings, "left hand"), right);
  EXPECT_EQ(loadConnection(settings).dsaPort, "a");
  EXPECT_EQ(loadConnection(settings).name, "") << "the name is that of another hand now";
  removeNamedConnection(settings, "left hand");
  EXPECT_EQ(connectionNames(settings), QStringList{"bench 1/2, ü %"});
}

TEST_F(ConnectionTest, TheLastOneCounts) {
  store({.kind = Connection::Kind::kPorts, .dsaPort = "a", .sdhPort = "b"});
  store({.kind = Connection::Kind::kPorts, .dsaPort = "", .sdhPort = "b"});
  EXPECT_EQ(reloaded().dsaPort, "");
  EXPECT_EQ(reloaded().sdhPort, "b");
}

TEST_F(ConnectionTest, WhatCannotBeReadIsTheDefault) {
  store("connection/kind", "telepathy");
  EXPECT_EQ(reloaded().kind, Connection::Kind::kEmulated);
  store("connection/kind", QStringList{"ports", "replay"});
  EXPECT_EQ(reloaded().kind, Connection::Kind::kEmulated);
  store("connection/kind", "ports");
  EXPECT_EQ(reloaded().kind, Connection::Kind::kPorts);
  EXPECT_EQ(reloaded().scene, "ball");
  store("connection/stream_format", "morse");
  store("connection/stream_time", 3);
  store("connection/stream_baud", "fast");
  EXPECT_EQ(reloaded().stream, StreamConnection{});
}

TEST_F(ConnectionTest, ADamagedFileGivesTheDefault) {
  testing::writeFile(path_.toStdString(), "\x01\x02[connection\nkind=ports");
  EXPECT_EQ(reloaded(), Connection{});
}

TEST(Connection, IsDescribedInAFewWords) {
  Connection connection;
  EXPECT_EQ(describe(connection), "emulated hand · ball");
  connection.scene = "foam_ball";
  EXPECT_EQ(describe(connection), "emulated hand · foam ball") << "as in the dialogue Connect";
  connection.scene = "/somewhere/my.first.scene.json";
  EXPECT_EQ(describe(connection), "emulated hand · my.first.scene");
  connection.kind = Connection::Kind::kPorts;
  connection.dsaPort = "/dev/ttyUSB0";
  EXPECT_EQ(describe(connection), "hand on ttyUSB0");
  connection.sdhPort = "tcp:localhost:13000";
  EXPECT_EQ(describe(connection), "hand on ttyUSB0 and tcp:localhost:13000");
  connection.kind = Connection::Kind::kStream;
  connection.stream = {.source = "/dev/ttyACM0", .hand = "/home/me/hands/my_pad"};
  EXPECT_EQ(describe(connection), "stream from ttyACM0 · my_pad");
  connection.stream = {.source = "udp:9871", .hand = "sole"};
  EXPECT_EQ(describe(connection), "stream from udp:9871 · sole");
  connection.kind = Connection::Kind::kReplay;
  connection.recording = "/data/foam_ball.dsa";
  EXPECT_EQ(describe(connection), "replay of foam_ball.dsa");
  connection.name = "left hand/2";
  EXPECT_EQ(describe(connection), "left hand/2: replay of foam_ball.dsa");
  connection.name = "replay of foam_ball.dsa";
  EXPECT_EQ(describe(connection), "replay of foam_ball.dsa") << "not twice";
}

TEST(Connection, IsTheSameSourceByTheFieldsOfItsKind) {
  const Connection ball = {.name = "mine", .scene = "ball"};
  EXPECT_TRUE(isSameSource(ball, {.dsaPort = "a", .scene = "ball"}));
  EXPECT_FALSE(isSameSource(ball, {.scene = "ball", .sceneScriptRuns = true}));
  EXPECT_FALSE(isSameSource(ball, {.kind = Connection::Kind::kReplay, .scene = "ball"}));
  const Connection ports = {.kind = Connection::Kind::kPorts, .dsaPort = "a", .sdhPort = "b"};
  EXPECT_FALSE(isSameSource(ports, {.kind = Connection::Kind::kPorts, .dsaPort = "a"}));
}

TEST(Connection, SaysWhatIsMissing) {
  Connection connection = {.kind = Connection::Kind::kPorts};
  EXPECT_TRUE(problemOf(connection).contains("Choose the port"));
  connection.sdhPort = "/dev/ttyUSB0";
  EXPECT_TRUE(problemOf(connection).isEmpty()) << "one controller is enough";
  connection.dsaPort = "/dev/ttyUSB0";
  EXPECT_TRUE(problemOf(connection).contains("different ports"));
  connection.dsaPort = "/dev/ttyUSB1";
  EXPECT_TRUE(problemOf(connection).isEmpty());
  connection.kind = Connection::Kind::kStream;
  EXPECT_EQ(problemOf(connection), "Choose where the stream comes from.");
  connection.stream.source = "listen:9871";
  EXPECT_EQ(problemOf(connection), "Choose the hand whose frames are sent.");
  connection.stream.hand = "sole";
  EXPECT_EQ(problemOf(connection), "");
  connection.stream.source = "-";
  EXPECT_EQ(problemOf(connection), "The window can't read standard input.");
  connection.kind = Connection::Kind::kReplay;
  EXPECT_EQ(problemOf(connection), "Choose a recording.");
  connection.recording = "a.dsa";
  EXPECT_TRUE(problemOf(connection).isEmpty());
  connection.kind = Connection::Kind::kEmulated;
  connection.scene = "";
  EXPECT_EQ(problemOf(connection), "Choose a scene.");
}

}  // namespace
}  // namespace palpate::gui::connection_test
