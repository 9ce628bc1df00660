#include "gui/appearance/settings_table.h"

#include "testing/testing.h"

namespace palpate::gui::settings_table_test {

enum class Fruit { kApple, kPear };
inline constexpr std::array kAllFruits = {Fruit::kApple, Fruit::kPear};
QString nameOf(Fruit fruit) { return fruit == Fruit::kPear ? "pear" : "apple"; }
enum class Step { kSlow, kFast };

namespace {

struct Values {
  bool on = true;
  QString text = "usual";
  QString word = "red";
  QStringList list = {};
  int whole = 7;
  double real = 0.5;
  std::optional<double> limit = {};
  Fruit fruit = Fruit::kPear;
  Step step = Step::kFast;
  Fruit byNumber = Fruit::kPear;
  bool operator==(const Values&) const = default;
};

constexpr std::array kSteps = {"slow", "fast"};

void fieldsOf(SettingsTable& table, Values& values) {
  table.flag("on", values.on);
  table.text("text", values.text);
  table.text(
      "word", values.word, [](const QString& word) { return word == "red" || word == "blue"; });
  table.texts("list", values.list);
  table.number("whole", values.whole, -10, 10);
  table.number("real", values.real, 0.0, 1.0);
  table.number("limit", values.limit, 1.0, 9.0);
  table.choice("fruit", values.fruit, kAllFruits);
  table.choice("step", values.step, kSteps);
  table.number("by_number", values.byNumber, 0, 1);
}

class SettingsTableTest : public ::testing::Test {
 protected:
  // What is loaded from the group "a" of such a file.
  Values loadedFrom(const std::string& lines) {
    testing::writeFile(folder_ / "a.ini", "[a]\n" + lines);
    return loadFields<Values>(QSettings(ini_, QSettings::IniFormat), fieldsOf, "a/");
  }
  void save(const Values& values) {
    QSettings settings(ini_, QSettings::IniFormat);
    saveFields(settings, values, fieldsOf, "a/");
  }
  testing::TemporaryFolder folder_;
  QString ini_ = QString::fromStdString((folder_ / "a.ini").string());
};

TEST_F(SettingsTableTest, WhatWasSavedComesBack) {
  const Values values{.on = false,
                      .text = "two\nlines, é",
                      .word = "blue",
                      .list = {"a, b", "c"},
                      .whole = -3,
                      .real = 0.1,
                      .limit = 2.5,
                      .fruit = Fruit::kApple,
                      .step = Step::kSlow,
                      .byNumber = Fruit::kApple};
  save(values);
  EXPECT_EQ(loadFields<Values>(QSettings(ini_, QSettings::IniFormat), fieldsOf, "a/"), values);
}

TEST_F(SettingsTableTest, TheFileHasNamesAndPlainNumbers) {
  save({.list = {"a", "b"}, .limit = 2.5});
  QStringList lines =
      QString::fromStdString(testing::readFile(folder_ / "a.ini")).split('\n', Qt::SkipEmptyParts);
  lines.sort();
  EXPECT_EQ(lines,
            (QStringList{"[a]",
                         "by_number=1",
                         "fruit=pear",
                         "limit=2.5",
                         "list=a, b",
                         "on=true",
                         "real=0.5",
                         "step=fast",
                         "text=usual",
                         "whole=7",
                         "word=red"}));
}

TEST_F(SettingsTableTest, ALimitThatIsTakenAwayLeavesNoKey) {
  save({.limit = 2.5});
  save({});
  EXPECT_FALSE(QSettings(ini_, QSettings::IniFormat).contains("a/limit"));
}

TEST_F(SettingsTableTest, WithoutKeysAllIsUsual) { EXPECT_EQ(loadedFrom(""), Values()); }

TEST_F(SettingsTableTest, WhatMakesNoSenseIsUsual) {
  EXPECT_EQ(loadedFrom("on=@Rect(1 2 3 4)\ntext=a\\0b\nword=green\nwhole=many\nreal=nan\nlimit=x\n"
                       "fruit=stone\nstep=1\nby_number=2\n"),
            Values());
  EXPECT_EQ(loadedFrom("whole=11\nreal=-0.1\nlimit=0.5\nfruit=\nby_number=-1\n"), Values());
  EXPECT_EQ(loadedFrom("whole=1e308\nreal=inf\nlimit=-inf\nfruit=a, b\nby_number=1e308\n"),
            Values());
}

TEST_F(SettingsTableTest, TheEndsOfARangeBelongToIt) {
  EXPECT_EQ(loadedFrom("whole=-10\nreal=1\nlimit=9\n"),
            (Values{.whole = -10, .real = 1.0, .limit = 9.0}));
}

}  // namespace
}  // namespace palpate::gui::settings_table_test
