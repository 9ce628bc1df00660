// Sensors beside the hand in the window: asked for, added, shown, remembered, removed.
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSpinBox>
#include <thread>

#include "gui/connect/sensor_dialog.h"
#include "gui/connect/sensor_rows.h"
#include "gui/connect/stream_fixture.h"
#include "gui/source/sensor.h"
#include "gui/widgets/facts_view.h"
#include "testing/awaited.h"

namespace palpate::gui::sensor_window_test {
namespace {

TEST(Sensor, IsRememberedByItsName) {
  const testing::TemporaryFolder folder;
  QSettings settings(pathText(folder / "settings.ini"), QSettings::IniFormat);
  const Sensor wrist{"wrist", "/dev/ttyUSB7", 921'600, "fx [N], fy [N]"};
  const Sensor imu{"imu", "udp:9000"};
  rememberSensor(wrist, settings);
  rememberSensor(imu, settings);
  EXPECT_EQ(rememberedSensors(settings), (std::vector<Sensor>{imu, wrist}));
  forgetSensor("imu", settings);
  settings.setValue("sensors/bad/source", "udp:nine");
  EXPECT_EQ(rememberedSensors(settings), std::vector<Sensor>{wrist});
  const SeriesSourceOptions options = optionsOf(wrist);
  EXPECT_EQ(options.baud, 921'600);
  EXPECT_EQ(options.columns, (std::vector<Column>{{"fx", "N"}, {"fy", "N"}}));
}

TEST(Sensor, SaysWhatIsWrong) {
  EXPECT_EQ(problemOf(Sensor{"wrist", "udp:9000"}), "");
  EXPECT_EQ(problemOf(Sensor{"", "udp:9000"}), "Give the sensor a name.");
  EXPECT_EQ(problemOf(Sensor{"wrist", ""}), "Choose where its lines come from.");
  EXPECT_TRUE(problemOf(Sensor{"wrist", "-"}).contains("standard input"));
  EXPECT_FALSE(problemOf(Sensor{"Wrist", "udp:9000"}).isEmpty());
  EXPECT_FALSE(problemOf(Sensor{"wrist", "udp:9000", 115'200, "fx,fx"}).isEmpty());
}

class SensorWindowTest : public StreamWindowTest {
 protected:
  // Adds a sensor that waits for its sender, and connects that.
  void add(const QString& columns = {}) {
    window().state().prompts.sensor = [columns] {
      return std::optional(
          std::pair(Sensor{"wrist", "listen:0", 115'200, columns}, std::shared_ptr<void>()));
    };
    actions().at("addSensor")->trigger();
    connectSender();
  }
  void connectSender() {
    ASSERT_TRUE(await([this] {
      const auto sensors = live().source()->session->seriesSources();
      return !sensors.empty() && sensors[0]->localPort();
    }));
    sender_ = openChannel("tcp:127.0.0.1:" + std::to_string(*sensor()->localPort()));
  }
  std::shared_ptr<SeriesSource> sensor() { return live().source()->session->seriesSources().at(0); }
  void sendRow(const std::string& line) {
    const std::string whole = line + "\n";
    sender_->write(std::as_bytes(std::span(whole)));
  }
  QString linkFact(const QString& name) {
    for (const Fact& each : find<FactsView>("linkFacts")->facts())
      if (each.name == name) return each.value;
    return {};
  }
  std::unique_ptr<ByteChannel> sender_;
};

TEST_F(SensorWindowTest, IsShownInLinkAndRemembered) {
  show("flat_pad_16x16", std::vector<float>(256, 5.0F));
  ASSERT_TRUE(actions().at("addSensor")->isEnabled());
  add();
  sendRow("fx[N],fy[N]");
  sendRow("1,2");
  sendRow("1,2,3");
  EXPECT_TRUE(await([&] { return linkFact("wrist").startsWith("streaming"); }));
  EXPECT_TRUE(await([&] { return linkFact("wrist: refused").startsWith("1 line, the last: "); }));
  EXPECT_EQ(rememberedSensors(window().state().settings),
            std::vector<Sensor>{(Sensor{"wrist", "listen:0"})});
  EXPECT_FALSE(live().stale()) << "the hand goes on";
  // The next connection has it, too.
  stopSending();
  unplug();
  sender_.reset();
  listen("flat_pad_16x16");
  EXPECT_TRUE(await([&] { return live().source()->session->seriesSources().size() == 1; }));
  // Removed by the menu.
  QMenu* menu = window().state().menus.connections;
  emit menu->aboutToShow();
  for (QAction* entry : menu->actions())
    if (entry->text() == "Remove a sensor") entry->menu()->actions().at(0)->trigger();
  EXPECT_TRUE(await([&] { return live().source()->session->seriesSources().empty(); }));
  EXPECT_TRUE(await([&] { return rememberedSensors(window().state().settings).empty(); }));
}

TEST_F(SensorWindowTest, AnUnpluggedOneLeavesTheHandAsItIs) {
  show("flat_pad_16x16", std::vector<float>(256, 5.0F));
  add("f[N]");
  sendRow("1");
  EXPECT_TRUE(await([&] { return linkFact("wrist").startsWith("streaming"); }));
  sender_.reset();
  EXPECT_TRUE(await([&] { return !linkFact("wrist: why").isEmpty(); }));
  EXPECT_FALSE(live().stale());
  connectSender();
  sendRow("2");
  EXPECT_TRUE(await([&] { return linkFact("wrist").startsWith("streaming"); }));
  EXPECT_TRUE(await([&] { return linkFact("wrist: why").isEmpty(); }));
}

TEST_F(SensorWindowTest, TheDialogShowsWhatArrives) {
  PortScan scan;
  SensorDialog dialog({.name = "wrist"}, {"angles"}, scan, nullptr);
  const auto in = [&dialog]<class Widget>(Widget*, const char* name) {
    return dialog.findChild<Widget*>(name);
  };
  auto* add = in(static_cast<QPushButton*>(nullptr), "sensorAdd");
  auto* look = in(static_cast<QPushButton*>(nullptr), "sensorLook");
  auto* rows = in(static_cast<QLabel*>(nullptr), "sensorRows");
  EXPECT_FALSE(add->isEnabled()) << "no source";
  in(static_cast<QComboBox*>(nullptr), "sensorPlace")->setCurrentIndex(3);  // UDP
  in(static_cast<QSpinBox*>(nullptr), "sensorUdpPort")->setValue(0);
  EXPECT_TRUE(add->isEnabled());
  EXPECT_EQ(dialog.sensor(), (Sensor{"wrist", "udp:0"}));
  auto* name = in(static_cast<QLineEdit*>(nullptr), "sensorName");
  name->setText("angles");
  EXPECT_FALSE(add->isEnabled()) << "taken";
  name->setText("wrist");
  look->setChecked(true);
  EXPECT_TRUE(await([&] { return rows->text().startsWith("no rows come"); }))
      << rows->text().toStdString();
  in(static_cast<QLineEdit*>(nullptr), "sensorColumns")->setText("fx [N]");
  EXPECT_FALSE(look->isChecked()) << "of other fields";
  look->setChecked(true);
  bool isAccepted = false;
  QObject::connect(&dialog, &QDialog::accepted, [&] { isAccepted = true; });
  add->click();
  EXPECT_TRUE(isAccepted);
  EXPECT_NE(dialog.takePreview(), nullptr);
  EXPECT_EQ(dialog.takePreview(), nullptr);
}

// A sender over loopback.
TEST(SensorRows, AreListedBelowTheirColumns) {
  SensorRows rows(SeriesSourceOptions{
      .name = "wrist", .source = "pipe", .columns = {{"fx", "N"}, {"t", ""}}, .open = [](auto&) {
        class Once : public ByteChannel {
          std::size_t read(std::span<std::byte> into, std::chrono::milliseconds) override {
            constexpr std::string_view kText = "1.5,0\nnan,1\nx,2\n";
            if (sent_) std::this_thread::yield();
            const std::size_t count = sent_ ? 0 : kText.size();
            for (std::size_t i = 0; i < count; ++i) into[i] = static_cast<std::byte>(kText[i]);
            sent_ = true;
            return count;
          }
          void write(std::span<const std::byte>) override {}
          void interrupt() noexcept override {}
          const std::string& name() const noexcept override { return name_; }
          std::string name_ = "pipe";
          bool sent_ = false;
        };
        return std::unique_ptr<ByteChannel>(std::make_unique<Once>());
      }});
  ASSERT_TRUE(testing::awaited([&] { return rows.text().contains("refused"); }));
  const QStringList lines = rows.text().split('\n');
  EXPECT_TRUE(lines.value(0).startsWith("2 rows")) << lines.value(0).toStdString();
  EXPECT_EQ(lines.mid(1), (QStringList{"fx [N]", "1.5", "–"}));
}

}  // namespace
}  // namespace palpate::gui::sensor_window_test
