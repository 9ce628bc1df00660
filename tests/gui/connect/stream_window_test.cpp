// The window on a stream of another hand: shown, recorded, lost, found again; what such a hand
// lacks is absent.
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QStackedWidget>
#include <filesystem>

#include <palpate/model/hand_file.h>
#include <palpate/recording/recording.h>

#include "gui/calibrate/force_page.h"
#include "gui/connect/stream_fixture.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/taxel_text.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui::stream_window_test {
namespace {
namespace fs = std::filesystem;

// The values of a pad: taxel i has i + 1, up to 250.
std::vector<float> padValues(std::size_t count = 256) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i % 250 + 1);
  return values;
}

class StreamShownTest : public StreamWindowTest {
 protected:
  std::vector<Fact> linkFacts() { return find<FactsView>("linkFacts")->facts(); }
  QString linkFact(const QString& name) {
    for (const Fact& each : linkFacts())
      if (each.name == name) return each.value;
    return {};
  }
  QString handState() { return find<QLabel>("handState")->text(); }
};

TEST_F(StreamShownTest, SaysWhereASenderIsAwaited) {
  listen("flat_pad_16x16");
  const QString port = QString::number(*live().source()->streamDevice()->localPort());
  const QString notice = "listening at 127.0.0.1:" + port + ", for programs of this machine only";
  EXPECT_TRUE(await([&] { return linkFact("senders") == notice; }));
  EXPECT_TRUE(await([&] { return find<StatusStrip>("statusStrip")->status().notice == notice; }));
  EXPECT_EQ(find<StatusStrip>("statusStrip")->status().state, "waiting for data");
}

TEST_F(StreamShownTest, ShowsEveryValueThatIsSent) {
  show("flat_pad_16x16", padValues());
  EXPECT_EQ(window().windowTitle(), "stream from listen:0 · flat_pad_16x16 – Palpate");
  const TactileFrame& frame = window().state().currentFrame.frame();
  EXPECT_EQ(frame.values, padValues());
  EXPECT_EQ(frame.layout->numMatrices(), 1u);
  EXPECT_EQ(linkFact("lost"), "0");
  EXPECT_TRUE(await([&] { return linkFact("tactile").startsWith("streaming"); }));
}

TEST_F(StreamShownTest, CountsWhatIsLostAndNamesWhatIsRefused) {
  show("flat_pad_16x16", padValues());
  number_ += 3;
  EXPECT_TRUE(await([&] { return linkFact("lost") == "3"; }));
  send("1,2,3");
  EXPECT_TRUE(await([&] { return linkFact("last refused").contains("3 numbers instead of 256"); }))
      << linkFact("last refused").toStdString();
  EXPECT_EQ(linkFact("suspect"), "1");
}

TEST_F(StreamShownTest, CountsFramesThatAreOutOfRange) {
  show("flat_pad_16x16", padValues());
  std::vector<float> high = padValues();
  high[1] = 5880.0F;
  sendFrame(high);
  EXPECT_TRUE(await([&] { return linkFact("out of range").startsWith("1 frame, the last: "); }))
      << linkFact("out of range").toStdString();
}

TEST_F(StreamShownTest, ASenderThatComesBackIsShownAgain) {
  show("flat_pad_16x16", padValues());
  unplug();
  EXPECT_TRUE(await([&] { return live().stale(); }));
  plugIn();
  EXPECT_TRUE(await([&] { return !live().stale(); }));
  EXPECT_TRUE(await([&] { return linkFact("reconnects") == "1"; }))
      << linkFact("reconnects").toStdString();
}

TEST_F(StreamShownTest, TheRecordingKeepsTheHandAndTheValues) {
  show("flat_pad_16x16", padValues());
  std::optional<RecordingReport> report;
  QObject::connect(&live(), &LiveController::recordingEnded, [&](const RecordingReport& ended) {
    report = ended;
  });
  live().startRecording([path = folder_ / "pad.palpate"] {
    RecordingOptions options;
    options.path = path;
    return options;
  });
  ASSERT_TRUE(await([&] { return live().health().recorder.frames >= 20; }));
  live().stopRecording();
  ASSERT_TRUE(await([&] { return report.has_value(); }));
  const Profile recorded = openRecording(folder_ / "pad.palpate");
  EXPECT_GE(recorded.numFrames(), 20u);
  EXPECT_EQ(recorded.hand().name, builtInHand("flat_pad_16x16").name);
  EXPECT_TRUE(recorded.hand().axes.empty());
  for (std::size_t i = 0; i < recorded.numFrames(); ++i)
    EXPECT_EQ(recorded.frame(i).values, padValues()) << i;
}

TEST_F(StreamShownTest, AHandFromAFolderThatWasBrokenSinceIsRefusedInOneLine) {
  testing::writeFile(folder_ / "hand.json", "{");
  QSignalSpy failed(&live(), &LiveController::failed);
  Connection connection;
  connection.kind = Connection::Kind::kStream;
  connection.stream = {.source = "udp:0", .hand = QString::fromStdString(folder_.path().string())};
  window().state().connectTo(connection);
  ASSERT_TRUE(await([&] { return failed.size() == 1; }));
  EXPECT_TRUE(failed[0][0].toString().contains("hand.json"));
  EXPECT_EQ(live().state(), LiveController::State::kNone);
}

// --- What a hand lacks.

TEST_F(StreamShownTest, AHandWithoutAxesIsReadNotMoved) {
  show("flat_pad_16x16", padValues());
  EXPECT_EQ(handState(), "This hand is read, not moved: its stream takes no commands.");
  for (const char* absent : {"handControls", "stopHand"})
    EXPECT_TRUE(find<QWidget>(absent)->isHidden()) << absent;
  for (const char* action :
       {"graspHand", "reactiveGrasp", "slipAwareGrasp", "openHand", "relaxHand", "stopHand"})
    EXPECT_FALSE(actions().at(action)->isEnabled()) << action;
  EXPECT_EQ(actions().at("stopHand")->toolTip(), "This hand is read, not moved");
  // The controls are back as soon as the stream is left.
  stopSending();
  live().end();
  EXPECT_TRUE(await([&] { return live().state() == LiveController::State::kNone; }));
  EXPECT_FALSE(find<QWidget>("stopHand")->isHidden());
  EXPECT_FALSE(find<QWidget>("handControls")->isHidden());
}

TEST_F(StreamShownTest, AnglesAndTemperaturesAreShownInTheirUnits) {
  const HandDescription& gripper = builtInHand("parallel_gripper");
  ASSERT_EQ(gripper.axes.size(), 1u);
  std::vector<float> values(gripper.layout->numCells(), 1.0F);
  show("parallel_gripper", values, {"angles 12.5"});
  window().docks().show("Inspect");
  EXPECT_TRUE(await([&] {
    const auto facts = find<FactsView>("angleFacts")->facts();
    return facts.size() == 1 && facts[0].value == "12.5 mm";
  }));
  EXPECT_EQ(find<FactsView>("temperatureFacts")->isHidden(), gripper.temperatureSensors.empty());
}

// The texts of a widget's labels and of the facts in it that can be seen.
QString visibleText(QWidget* in) {
  QStringList all;
  for (QLabel* each : in->findChildren<QLabel*>())
    if (each->isVisible()) all.append(each->text());
  for (FactsView* each : in->findChildren<FactsView*>())
    if (each->isVisible())
      for (const Fact& fact : each->facts()) all.append(fact.name + ": " + fact.value);
  return all.join('\n');
}

TEST_F(StreamShownTest, NothingIsSaidOfJointsTemperaturesAndMotionThatAPadLacks) {
  show("flat_pad_16x16", padValues());
  for (const char* dock : {"Inspect", "Hand", "Link", "Timeline"}) {
    auto* shown = find<QDockWidget>(dock);
    shown->show();
    shown->raise();
    QCoreApplication::processEvents();
    const QString text = visibleText(shown);
    EXPECT_FALSE(text.isEmpty()) << dock;
    for (const char* absent : {"oint", "emperature", "°C", "firmware", "reshape", "motion"})
      EXPECT_FALSE(text.contains(absent)) << dock << ": " << text.toStdString();
  }
}

TEST_F(StreamShownTest, ValuesHaveTheUnitAndTheFullScaleOfTheHand) {
  const HandDescription& sole = builtInHand("sole");
  std::vector<float> values(sole.layout->numCells(), 0.0F);
  const MatrixLayout& first = sole.layout->matrix(0);
  int x = 0;
  while (!first.exists(0, x)) ++x;
  values[static_cast<std::size_t>(x)] = 12.5F;
  show("sole", values);
  auto& panel = window().feature<MatricesFeature>().panel();
  EXPECT_EQ(taxelText(sole, {0, 0, x}, window().state().currentFrame.frame(), nullptr),
            QString::fromStdString(sole.matrixName(0)) + " · x " + QString::number(x) +
                ", y 0 · 12.50 kPa");
  EXPECT_TRUE(find<QDoubleSpinBox>("rangeMaximum")->toolTip().endsWith("in kPa"));
  // A light touch is not shown in the brightest colour: a part of full scale is.
  EXPECT_NEAR(panel.pictureOptions().rangeMax,
              static_cast<double>(sole.maximumCounts) * 500.0 / 4095.0,
              1.0);
  window().state().appearance.change(
      [](ViewSettings& view) { view.range = RangeMode::kFullScale; });
  EXPECT_EQ(panel.pictureOptions().rangeMax, static_cast<double>(sole.maximumCounts));
  // Nothing to calibrate.
  find<QDockWidget>("Calibrate")->show();
  auto* force = window().findChild<ForcePage*>();
  qobject_cast<QStackedWidget*>(force->parentWidget())->setCurrentWidget(force);
  EXPECT_EQ(force->emptyText(),
            "The values of this hand are kPa already: there is nothing to calibrate.");
}

}  // namespace
}  // namespace palpate::gui::stream_window_test
