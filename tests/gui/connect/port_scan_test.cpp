#include "gui/connect/port_scan.h"

#include <QCoreApplication>
#include <QSignalSpy>
#include <QTest>
#include <QThread>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include <pty.h>
#include <unistd.h>

#include "control/emulated_bench.h"
#include "gui/connect/fake_ports.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::gui::port_scan_test {
namespace {

constexpr int kPatienceMs = 10'000;
constexpr std::chrono::seconds kLong{10};  // a machine may be busy

// What the scan says, in the order it says it.
class Heard : public QObject {
 public:
  explicit Heard(PortScan& scan) : finished(&scan, &PortScan::finished) {
    connect(&scan, &PortScan::listed, this, [this](const QList<ScannedPort>& ports) {
      log.append("listed");
      list = ports;
      inOurThread = inOurThread && QThread::currentThread() == thread();
    });
    connect(&scan, &PortScan::probed, this, [this](const QString& port, const PortProbe& probe) {
      log.append(port);
      probes.append(probe);
      inOurThread = inOurThread && QThread::currentThread() == thread();
    });
    connect(&scan, &PortScan::finished, this, [this] { log.append("finished"); });
  }
  bool await(const QString& what) {
    return QTest::qWaitFor([&] { return log.contains(what); }, kPatienceMs);
  }

  QStringList log;
  QList<ScannedPort> list;
  QList<PortProbe> probes;
  bool inOurThread = true;
  QSignalSpy finished;
};

TEST(PortScan, ListsThenAsksEveryPort) {
  FakePorts fake;
  fake.list({usbPort("a"), usbPort("b"), usbPort("c")});
  fake.answer("b", motionAnswer());
  PortScan scan(fake.functions());
  Heard heard(scan);
  EXPECT_FALSE(scan.running());
  scan.scan();
  EXPECT_TRUE(scan.running());
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_FALSE(scan.running());
  ASSERT_EQ(heard.log.size(), 5) << heard.log.join(' ').toStdString();
  EXPECT_EQ(heard.log.front(), "listed");
  EXPECT_EQ(heard.log.back(), "finished");
  ASSERT_EQ(heard.list.size(), 3);
  EXPECT_EQ(heard.list[2].info.name, "c");
  for (const PortProbe& probe : heard.probes)
    EXPECT_EQ(probe.answer, probe.port == "b" ? PortAnswer::kMotion : PortAnswer::kNotFound);
  EXPECT_TRUE(heard.inOurThread);
}

TEST(PortScan, NoPortIsFinishedToo) {
  FakePorts fake;
  PortScan scan(fake.functions());
  Heard heard(scan);
  scan.scan();
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_EQ(heard.log, (QStringList{"listed", "finished"}));
}

TEST(PortScan, ASilentPortDoesNotHoldUpTheOthers) {
  FakePorts fake;
  fake.list({usbPort("silent"), usbPort("b"), usbPort("c")});
  fake.hang("silent");
  PortScan scan(fake.functions());
  Heard heard(scan);
  scan.scan();
  ASSERT_TRUE(heard.await("b"));
  ASSERT_TRUE(heard.await("c"));
  EXPECT_TRUE(scan.running());
  fake.release("silent");
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_TRUE(heard.log.contains("silent"));
}

TEST(PortScan, ManyPortsAreAskedAFewAtATime) {
  FakePorts fake;
  std::vector<PortInfo> ports;
  for (int i = 0; i < 40; ++i) ports.push_back(usbPort("port" + std::to_string(i)));
  fake.list(ports);
  fake.hang("port0");
  PortScan scan(fake.functions());
  Heard heard(scan);
  scan.scan();
  ASSERT_TRUE(heard.await("port39"));
  fake.release("port0");
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_EQ(heard.probes.size(), 40);
  EXPECT_LE(fake.mostOpen(), 8);
}

TEST(PortScan, OfOurOwnPortsEachIsJudgedByItself) {
  Connection connection;
  connection.kind = Connection::Kind::kPorts;
  connection.dsaPort = "A";
  connection.sdhPort = "B";
  DeviceStatus status;
  status.motion.emplace();
  EXPECT_TRUE(knownProbes(connection, status).isEmpty()) << "none has answered yet";
  // Both names lead to the motion controller.
  status.tactile.found = PortAnswer::kMotion;
  status.tactile.message = "A: the motion controller answers here: the two ports are swapped";
  status.motion->state = PortState::kStreaming;
  auto known = knownProbes(connection, status);
  EXPECT_EQ(known.value("A").answer, PortAnswer::kMotion);
  EXPECT_EQ(known.value("B").answer, PortAnswer::kMotion);
  EXPECT_EQ(known.value("B").message, "motion controller; this window is connected to it");
  // Of the other one nothing is known.
  status.motion->state = PortState::kConnecting;
  known = knownProbes(connection, status);
  EXPECT_TRUE(known.contains("A"));
  EXPECT_FALSE(known.contains("B"));
}

TEST(PortScan, PortsThatMustNotBeOpenedAreNotAsked) {
  FakePorts fake;
  PortInfo bluetooth = usbPort("bluetooth");
  bluetooth.bluetooth = true;
  PortInfo foreign = usbPort("foreign");
  foreign.writable = false;
  fake.list({bluetooth, foreign, usbPort("mine", "my-stable-name"), usbPort("fine")});
  PortScan scan(fake.functions());
  scan.setBusy({"my-stable-name"});
  Heard heard(scan);
  scan.scan();
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_EQ(fake.asked(), std::vector<std::string>{"fine"});
  ASSERT_EQ(heard.list.size(), 4);
  EXPECT_TRUE(heard.list[0].notAsked.contains("Bluetooth"));
  EXPECT_TRUE(heard.list[1].notAsked.contains("dialout"));
  EXPECT_TRUE(heard.list[2].notAsked.contains("this window is connected to it"));
  EXPECT_TRUE(heard.list[3].notAsked.isEmpty());
  // Nor when it is typed, under either name.
  heard.probes.clear();
  scan.ask("my-stable-name");
  EXPECT_FALSE(scan.running());
  EXPECT_EQ(fake.asked(), std::vector<std::string>{"fine"});
  ASSERT_EQ(heard.probes.size(), 1);
  EXPECT_EQ(heard.probes[0].answer, PortAnswer::kBusy);
}

TEST(PortScan, ABusyPortIsKnownByEveryNameOfIt) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "device", "");
  std::filesystem::create_symlink(folder / "device", folder / "by-id");
  FakePorts fake;
  fake.list({usbPort((folder / "device").string())});
  PortScan scan(fake.functions());
  scan.setBusy({QString::fromStdString((folder / "by-id").string())});
  Heard heard(scan);
  scan.scan();
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_TRUE(fake.asked().empty());
}

TEST(PortScan, AsksAPortThatWasTyped) {
  FakePorts fake;
  fake.list({usbPort("a")});
  fake.answer("tcp:localhost:13000", tactileAnswer());
  PortScan scan(fake.functions());
  Heard heard(scan);
  scan.ask("tcp:localhost:13000");
  EXPECT_TRUE(scan.running());
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_EQ(heard.log, (QStringList{"tcp:localhost:13000", "finished"}));
  EXPECT_EQ(heard.probes[0].answer, PortAnswer::kTactile);
  EXPECT_EQ(heard.probes[0].port, "tcp:localhost:13000");
}

TEST(PortScan, CancelFreesThePortsAndIsSilent) {
  FakePorts fake;
  fake.list({usbPort("a"), usbPort("b")});
  fake.hang("a");
  fake.hang("b");
  PortScan scan(fake.functions());
  Heard heard(scan);
  scan.scan();
  ASSERT_TRUE(QTest::qWaitFor([&] { return fake.numOpen() == 2; }, kPatienceMs));
  EXPECT_TRUE(scan.cancel(kLong));
  EXPECT_EQ(fake.numOpen(), 0);
  EXPECT_FALSE(scan.running());
  QCoreApplication::processEvents();
  EXPECT_EQ(heard.log, QStringList{"listed"});
  // It can be used again.
  fake.release("a");
  fake.release("b");
  scan.scan();
  ASSERT_TRUE(heard.await("finished"));
  EXPECT_EQ(heard.probes.size(), 2);
}

// As the word comes that belongs to a scan before.
TEST(PortScan, AnAnswerThatWasOnItsWayIsNotHeardAfterCancel) {
  FakePorts fake;
  fake.list({usbPort("a")});
  PortScan scan(fake.functions());
  Heard heard(scan);
  scan.scan();
  const auto soon = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  // Listed without our hearing: no events are handled here.
  ASSERT_TRUE(heard.await("listed"));
  while (fake.asked().empty() || fake.numOpen() > 0) {
    ASSERT_LT(std::chrono::steady_clock::now(), soon);
    std::this_thread::yield();
  }
  scan.cancel();
  QCoreApplication::processEvents();
  EXPECT_EQ(heard.log, QStringList{"listed"});
}

TEST(PortScan, WhoHearsTheListMayCancel) {
  FakePorts fake;
  fake.list({usbPort("a")});
  PortScan scan(fake.functions());
  Heard heard(scan);
  QObject::connect(&scan, &PortScan::listed, &scan, [&] { scan.cancel(); });
  scan.scan();
  ASSERT_TRUE(heard.await("listed"));
  EXPECT_FALSE(scan.running());
  EXPECT_TRUE(fake.asked().empty());
}

TEST(PortScan, EndsQuicklyWhileAPortHangs) {
  FakePorts fake;
  fake.list({usbPort("a")});
  fake.hang("a");
  auto scan = std::make_unique<PortScan>(fake.functions());
  scan->scan();
  ASSERT_TRUE(QTest::qWaitFor([&] { return fake.numOpen() == 1; }, kPatienceMs));
  const auto begin = std::chrono::steady_clock::now();
  scan.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, testing::timeLimit(std::chrono::seconds(2)));
  EXPECT_TRUE(QTest::qWaitFor([&] { return fake.numOpen() == 0; }, kPatienceMs))
      << "it was given up, not left behind";
}

// A port whose driver holds a thread up: the program doesn't wait for it.
TEST(PortScan, LeavesAThreadBehindThatTheSystemHoldsUp) {
  FakePorts fake;
  fake.list({usbPort("a"), usbPort("b")});
  fake.hang("a", true);
  auto scan = std::make_unique<PortScan>(fake.functions());
  Heard heard(*scan);
  scan->scan();
  ASSERT_TRUE(heard.await("b"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return fake.numOpen() == 1; }, kPatienceMs));
  EXPECT_FALSE(scan->cancel());
  EXPECT_EQ(fake.numOpen(), 1);
  scan.reset();
  fake.release("a");
  EXPECT_TRUE(QTest::qWaitFor([&] { return fake.numOpen() == 0; }, kPatienceMs));
}

// The real functions, on the ptys of an emulated hand (not scan(): that would ask this machine's
// ports).
TEST(PortScan, FindsTheControllersOfAHandAndMovesNothing) {
  testing::EmulatedBench bench(testing::stillHand());
  const QString tactile = QString::fromStdString(bench.hand->dsaPort());
  const QString motion = QString::fromStdString(bench.hand->sdhPort());
  PortScan scan;
  Heard heard(scan);
  scan.ask(tactile);
  scan.ask(motion);
  ASSERT_TRUE(heard.await("finished"));
  ASSERT_EQ(heard.probes.size(), 2);
  for (const PortProbe& probe : heard.probes)
    EXPECT_EQ(probe.answer,
              probe.port == tactile.toStdString() ? PortAnswer::kTactile : PortAnswer::kMotion)
        << probe.message;
  EXPECT_TRUE(bench.log.deeds().empty());
  EXPECT_FALSE(bench.handMoves());
}

// A pty where nobody answers: asking takes 2.5 s, unless it is given up.
TEST(PortScan, GivesUpAPortThatIsSilent) {
  int ours = -1;
  int theirs = -1;
  std::array<char, 256> name = {};
  ASSERT_EQ(::openpty(&ours, &theirs, name.data(), nullptr, nullptr), 0);
  PortScan scan;
  scan.ask(name.data());
  // The question has come: the port is open.
  std::array<char, 64> question = {};
  EXPECT_GT(::read(ours, question.data(), question.size()), 0);
  EXPECT_TRUE(scan.cancel(kLong));
  ::close(theirs);
  ::close(ours);
}

TEST(PortScan, CanBeDestroyedAtAnyMoment) {
  FakePorts fake;
  fake.list({usbPort("a"), usbPort("b"), usbPort("c")});
  for (int i = 0; i < 50; ++i) {
    PortScan scan(fake.functions());
    scan.scan();
    for (int rounds = 0; rounds < i % 5; ++rounds) QCoreApplication::processEvents();
  }
  EXPECT_TRUE(QTest::qWaitFor([&] { return fake.numOpen() == 0; }, kPatienceMs));
}

}  // namespace
}  // namespace palpate::gui::port_scan_test
