// The window starts whatever its settings hold.
#include <QDir>
#include <QRegularExpression>
#include <set>

#include "gui/testing/window_fixture.h"

namespace palpate::gui::hostile_settings_test {
namespace {

namespace fs = std::filesystem;

// Of the documented groups whose keys contain a name of the user.
const QStringList kNamedKeys = {"session/files/size",
                                "session/files/1/path",
                                "session/files/1/frame",
                                "session/files/1/seen",
                                "session/files/1/selection",
                                "taxel_groups/size",
                                "taxel_groups/1/name",
                                "taxel_groups/1/taxels",
                                "poses/sdh2/x",
                                "hands/sdh2/x",
                                "import/presets/x",
                                "recognise/leftOut/x",
                                "recording/plan_limits/taxels",
                                "recording/plan_limits/least_s",
                                "recording/plan_limits/most_lost",
                                "recording/plan_limits/most_saturated",
                                "recording/plan_limits/least_quality",
                                "recording/label0",
                                "grasp/finger_0_counts",
                                "calibrate/noise_seconds",
                                "calibrate/applied/sdh2",
                                "calibrate/noise/sdh2",
                                "window/layouts_recording/Watch",
                                "window/layouts_live/own one",
                                "window/preset_recording",
                                "window/preset_live",
                                "library/columns/widths",
                                "library/columns/order",
                                "library/columns/sorted"};

// Every text in the sources of the window that is a key of the settings.
std::set<QString> keys() {
  std::set<QString> keys(kNamedKeys.begin(), kNamedKeys.end());
  const QRegularExpression key("\"([a-z_0-9]+/[A-Za-z_0-9/]+)\"");
  for (const auto& entry : fs::recursive_directory_iterator(PALPATE_WINDOW_SOURCES)) {
    if (entry.path().extension() != ".cpp") continue;
    auto found = key.globalMatch(QString::fromStdString(testing::readFile(entry.path())));
    while (found.hasNext()) {
      QString name = found.next().captured(1);
      if (name.endsWith('/')) name += "x";
      keys.insert(name);
    }
  }
  return keys;
}

struct Hostile {
  const char* name;
  std::string value;  // as in the file
};

std::vector<Hostile> hostileValues() {
  const std::string bytes =
      "@ByteArray(\\0\\0\\0\\xff\\0\\0\\0\\0\\xfd\\0\\0\\0\\x1\\x7f\\xff\\xff\\xff\\0)";
  std::string words = "1";
  for (int i = 0; i < 20'000; ++i) words += ", " + std::to_string(i);
  return {{"empty", ""},
          {"garbage", "\\x1\\xffrubbish {[\\\"<b>%s"},
          {"zero", "0"},
          {"negative", "-1"},
          {"minus_2_31", "-2147483648"},
          {"2_31", "2147483648"},
          {"2_64", "18446744073709551616"},
          {"huge", "1e308"},
          {"minus_huge", "-1e308"},
          {"nan", "nan"},
          {"inf", "inf"},
          {"long", std::string(200'000, 'x')},
          {"words", words},
          {"bytes", bytes},
          {"rectangle", "@Rect(2147483647 -2147483648 2147483647 2147483647)"},
          {"object", "@Variant(\\0\\0\\0\\t\\0\\x7f\\xff\\xff\\xff)"},
          {"deep_json", std::string(100'000, '[')},
          {"device", "/dev/zero"},
          {"two_numbers", "1e308, -1e308"}};
}

class HostileSettingsTest : public WindowTest, public ::testing::WithParamInterface<Hostile> {
 protected:
  HostileSettingsTest() {
    std::string text;
    for (const QString& key : keys()) {
      QString name = key;
      text += "[" + key.section('/', 0, 0).toStdString() + "]\n" +
              name.remove(0, name.indexOf('/') + 1).replace('/', '\\').toStdString() + "=" +
              GetParam().value + "\n";
    }
    testing::writeFile(folder_ / "palpate.ini", text);
  }
};

TEST_P(HostileSettingsTest, TheWindowStartsAndShowsARecording) {
  EXPECT_LE(window().width(), 4000);
  open({"rich.dsa"});
  EXPECT_EQ(playback().numFrames() > 0, true);
  for (const QString& dock : window().docks().names()) {
    window().docks().show(dock);
    QCoreApplication::processEvents();
  }
  EXPECT_TRUE(window().close());
}

INSTANTIATE_TEST_SUITE_P(AllValues,
                         HostileSettingsTest,
                         ::testing::ValuesIn(hostileValues()),
                         [](const auto& hostile) { return std::string(hostile.param.name); });

TEST(HostileSettingsKeys, AreFound) {
  const std::set<QString> found = keys();
  EXPECT_GT(found.size(), 100u);
  EXPECT_TRUE(found.contains("window/layouts_recording/Watch"));
}

}  // namespace
}  // namespace palpate::gui::hostile_settings_test
