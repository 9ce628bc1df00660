#include "gui/appearance/settings_file.h"

#include <QHeaderView>
#include <QStandardItemModel>
#include <QTableView>
#include <QTemporaryDir>
#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "testing/testing.h"

namespace palpate::gui::settings_file_test {
namespace {

namespace fs = std::filesystem;

class SettingsFileTest : public ::testing::Test {
 protected:
  QString path() const { return QString::fromStdString(file().string()); }
  fs::path file() const { return folder_ / "palpate.ini"; }
  // What QSettings reads after the file was made safe.
  QVariant valueIn(const std::string& text, const char* key) {
    testing::writeFile(file(), text);
    return QSettings(readableSettings(path()).path, QSettings::IniFormat).value(key);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(SettingsFileTest, AGoodFileStaysAsItIs) {
  const std::string text = "[view]\ntheme=dark\nname=\"\\xe4\\x40 \\\"a\\\"\"\n";
  EXPECT_EQ(valueIn(text, "view/theme").toString(), "dark");
  EXPECT_EQ(testing::readFile(file()), text);
  EXPECT_FALSE(fs::exists(file().string() + ".damaged"));
}

TEST_F(SettingsFileTest, ValuesThatAreObjectsAreRemovedHoweverTheyAreWritten) {
  // Type 9 is a list of values, here of 2^31 - 1.
  const std::string object = "\\0\\0\\0\\t\\0\\x7f\\xff\\xff\\xff)";
  for (const std::string begin : {"@Variant(",
                                  "\\x40Variant(",
                                  "\\100Variant(",
                                  "\\x10040Variant(",
                                  "\"@Var\"iant(",
                                  "@Var\\qiant(",
                                  "a, @Variant(",
                                  "@DateTime("}) {
    EXPECT_EQ(valueIn("[a]\nbad=" + begin + object + "\ngood=1\n", "a/good").toInt(), 1) << begin;
    EXPECT_FALSE(QSettings(path(), QSettings::IniFormat).contains("a/bad")) << begin;
  }
  EXPECT_FALSE(fs::exists(file().string() + ".damaged"));
}

TEST_F(SettingsFileTest, AnObjectOverSeveralLinesPutsTheFileAside) {
  EXPECT_FALSE(valueIn("[a]\nbad=@Var\\\niant(\\0)\ngood=1\n", "a/good").isValid());
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_TRUE(fs::exists(file().string() + ".damaged"));
}

TEST_F(SettingsFileTest, AFifoIsPutAside) {
  ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
  EXPECT_EQ(readableSettings(path()).path, path());
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(SettingsFileTest, AHugeFileIsPutAside) {
  testing::writeFile(file(), "");
  fs::resize_file(file(), (64u << 20) + 1);
  EXPECT_EQ(readableSettings(path()).path, path());
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(SettingsFileTest, NoFileIsNoFault) {
  EXPECT_EQ(readableSettings(path()).path, path());
  EXPECT_FALSE(fs::exists(file().string() + ".damaged"));
}

// As the versions before wrote them, by Qt itself.
TEST_F(SettingsFileTest, GraspsThatAnEarlierVersionLeftOutOfTrainingStayLeftOut) {
  const QString folder = QString::fromUtf8("/home/a b/Übung, \"1\"/f");
  const QStringList grasps{"12 a.dsa", "345 sub/b;c.palpate"}, other{"0 x.dsa"};
  {
    QSettings before(path(), QSettings::IniFormat);
    before.setValue("recognise/leftOut", QVariantMap{{folder, grasps}, {"/abc", other}});
    before.setValue("recognise/featureSet", "best");
  }
  ASSERT_NE(testing::readFile(file()).find("@Variant("), std::string::npos);
  const SettingsPlace place = readableSettings(path());
  EXPECT_EQ(place.problem, "");
  const QSettings now(place.path, QSettings::IniFormat);
  EXPECT_EQ(now.value(leftOutKeyOf(folder)).toStringList(), grasps);
  EXPECT_EQ(now.value(leftOutKeyOf("/abc")).toStringList(), other);
  EXPECT_EQ(now.value("recognise/featureSet").toString(), "best");
  EXPECT_FALSE(now.contains("recognise/leftOut"));
}

TEST_F(SettingsFileTest, AnotherFileIsPutAsideUnderAnotherName) {
  for (const char* text : {"1", "2"}) {
    testing::writeFile(file(), std::string("[a]\nbad=@Var\\\niant(\\0)\nn=") + text);
    const SettingsPlace place = readableSettings(path());
    EXPECT_EQ(place.path, path());
    EXPECT_NE(place.problem, "");
  }
  EXPECT_TRUE(testing::readFile(file().string() + ".damaged").ends_with("n=1"));
  EXPECT_TRUE(testing::readFile(file().string() + ".damaged2").ends_with("n=2"));
}

TEST_F(SettingsFileTest, AFileThatCannotBeReadNowStays) {
  // A regular file whose first byte can't be read, by anybody.
  fs::create_symlink("/proc/self/mem", file());
  const SettingsPlace place = readableSettings(path());
  EXPECT_NE(place.path, path());
  EXPECT_TRUE(place.problem.contains("palpate.ini")) << place.problem.toStdString();
  EXPECT_TRUE(place.problem.contains("aren't kept")) << place.problem.toStdString();
  EXPECT_TRUE(fs::is_symlink(file()));
  EXPECT_FALSE(fs::exists(file().string() + ".damaged"));
}

TEST_F(SettingsFileTest, AFileThatCannotBeWrittenNowStays) {
  const std::string text = "[a]\nn=1\nbad=@Variant(\\0)\n";
  testing::writeFile(file(), text);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit none{0, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &none);
  const SettingsPlace place = readableSettings(path());
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(place.path, path());
  EXPECT_TRUE(place.problem.contains("can't be written")) << place.problem.toStdString();
  EXPECT_EQ(testing::readFile(file()), text);
  EXPECT_FALSE(fs::exists(file().string() + ".damaged"));
}

class SettingsColumnsTest : public SettingsFileTest {
 protected:
  SettingsColumnsTest() : model_(2, 3), settings_(path(), QSettings::IniFormat) {
    table_.setModel(&model_);
    table_.setSortingEnabled(true);
    table_.horizontalHeader()->setSectionsMovable(true);
  }

  QHeaderView& header() { return *table_.horizontalHeader(); }

  QStandardItemModel model_;
  QTableView table_;
  QSettings settings_;
};

TEST_F(SettingsColumnsTest, ColumnsComeBack) {
  header().resizeSection(0, 77);
  header().moveSection(0, 2);
  header().setSortIndicator(1, Qt::DescendingOrder);
  storeColumns(header(), settings_, "columns");
  QTableView again;
  again.setModel(&model_);
  restoreColumns(*again.horizontalHeader(), settings_, "columns");
  EXPECT_EQ(again.columnWidth(0), 77);
  EXPECT_EQ(again.horizontalHeader()->logicalIndex(0), 1);
  EXPECT_EQ(again.horizontalHeader()->logicalIndex(2), 0);
  EXPECT_EQ(again.horizontalHeader()->sortIndicatorSection(), 1);
  EXPECT_EQ(again.horizontalHeader()->sortIndicatorOrder(), Qt::DescendingOrder);
}

TEST_F(SettingsColumnsTest, ColumnsThatMakeNoSenseAreNotTaken) {
  const int width = table_.columnWidth(0);
  for (const QStringList& bad : {QStringList{"50", "50"},
                                 QStringList{"50", "50", "50", "50"},
                                 QStringList{"-50", "50", "50"},
                                 QStringList{"50", "2000000000", "50"},
                                 QStringList{"50", "x", "50"},
                                 QStringList{"50", "99999999999", "50"}}) {
    settings_.setValue("columns/widths", bad);
    settings_.setValue("columns/order", bad);
    settings_.setValue("columns/sorted", bad);
    restoreColumns(header(), settings_, "columns");
    EXPECT_EQ(table_.columnWidth(0), width) << bad.join(",").toStdString();
  }
  settings_.setValue("columns/order", QStringList{"0", "0", "1"});
  restoreColumns(header(), settings_, "columns");
  EXPECT_EQ(header().logicalIndex(0), 0);
}

}  // namespace
}  // namespace palpate::gui::settings_file_test
