// The batch in the window: it makes what the command makes, and can be cancelled at any time.
#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <map>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "gui/batch/batch_dialog.h"
#include "gui/batch/batch_feature.h"
#include "gui/batch/batch_fields.h"
#include "gui/batch/batch_pictures.h"
#include "gui/testing/window_fixture.h"
#include "gui/widgets/opening_strip.h"
#include "imports/import_samples.h"
#include "testing/program.h"

namespace palpate::gui::batch_window_test {
namespace {

namespace fs = std::filesystem;

class BatchWindowTest : public WindowTest {
 protected:
  // Recordings in in/: a.dsa, deep/b.palpate, and bad.dsa, which is none.
  void makeRecordings() {
    fs::create_directories(folder_ / "in/deep");
    saveRecording(synthesize({.durationS = 12.0}), {}, folder_ / "in/a.dsa");
    saveRecording(
        synthesize({.durationS = 12.0, .grasps = 2, .seed = 5}), {}, folder_ / "in/deep/b.palpate");
    testing::writeFile(folder_ / "in/bad.dsa", "hello");
  }
  // So many links to one recording.
  void makeMany(int count) {
    fs::create_directories(folder_ / "many");
    saveRecording(synthesize({.durationS = 20.0}), {}, folder_ / "many/0.dsa");
    for (int i = 1; i < count; ++i)
      fs::create_hard_link(folder_ / "many/0.dsa",
                           folder_ / ("many/" + std::to_string(i) + ".dsa"));
  }
  BatchDialog& dialog() {
    if (!window().findChild<BatchDialog*>()) actions().at("batch")->trigger();
    return *window().findChild<BatchDialog*>();
  }
  static QString text(const fs::path& path) { return QString::fromStdString(path.string()); }
  bool busy() { return window().state().batchRunning(); }
  void begin(const BatchChoices& choices) {
    dialog().setChoices(choices);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !dialog().looking(); }, 30'000));
    ASSERT_EQ(dialog().problem().toStdString(), "");
    dialog().start();
  }
  void run(const BatchChoices& choices) {
    begin(choices);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !busy(); }, 60'000));
  }
  // The bytes of all files below a folder by their names, without hidden ones.
  static std::map<std::string, std::string> filesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& each : fs::recursive_directory_iterator(folder))
      if (each.is_regular_file() && !each.path().filename().string().starts_with('.'))
        files[each.path().lexically_relative(folder).string()] = testing::readFile(each.path());
    return files;
  }
  testing::ProgramResult command(std::vector<std::string> words) {
    return testing::runProgram(PALPATE_PROGRAM, words);
  }
};

TEST_F(BatchWindowTest, MakesTheBytesOfTheCommand) {
  makeRecordings();
  const std::string in = folder_ / "in";
  struct Case {
    std::vector<std::string> words;
    BatchChoices choices;
  };
  std::vector<Case> cases = {
      {{"convert", in, "-o", "{name}.npz"}, {}},
      {{"convert", in, "-o", "{folder}_{name}.csv", "--units-row", "--filter", "median"},
       {.filters = "median", .form = "csv", .unitsRow = true, .names = "{folder}_{name}"}},
      {{"convert", in, "-o", "{name}.mat", "--no-slip"}, {.form = "mat", .withSlip = false}},
      {{"signals", in, "-o", "{name}.csv", "--matrix", "1", "--smooth", "kalman:q=0.05"},
       {.work = BatchWork::kSignals, .smooth = "kalman:q=0.05", .matrix = 1}},
      {{"slip", in, "-o", "{name}.csv", "--units-row", "--method", "register"},
       {.work = BatchWork::kSlip, .unitsRow = true, .method = "register"}},
      {{"slip", in, "-o", "{name}.csv", "--segments", "--reference", "rest", "--step", "0.1"},
       {.work = BatchWork::kSlip, .reference = "rest", .segments = true, .stepTaxels = 0.1}},
      {{"features", in, "-o", "{name}.csv", "--set", "statistics"},
       {.work = BatchWork::kFeatures, .featureSet = "statistics"}},
  };
  int number = 0;
  for (Case& each : cases) {
    const fs::path mine = folder_ / ("window" + std::to_string(number));
    const fs::path theirs = folder_ / ("command" + std::to_string(number++));
    each.words[3] = theirs / each.words[3];
    const auto result = command(each.words);
    EXPECT_EQ(result.exitCode, 3) << result.err;
    each.choices.paths = {QString::fromStdString(in)};
    each.choices.folder = text(mine);
    run(each.choices);
    const auto made = filesIn(mine);
    EXPECT_FALSE(made.empty());
    EXPECT_TRUE(made == filesIn(theirs)) << each.words[0] << " " << number;
    // The journal of one is that of the other, too: the command goes on where the window ended.
    each.words[3] = mine / fs::path(each.words[3]).lexically_relative(theirs);
    each.words.emplace_back("--resume");
    const auto again = command(each.words);
    EXPECT_NE(again.out.find("skipped            2\n"), std::string::npos) << again.out;
  }
}

// A file of another program of which two messages can't be read.
TEST_F(BatchWindowTest, APictureOfAPartOfARecordingSaysWhatIsMissing) {
  testing::runPython(folder_, R"(
import sys
sys.path.insert(0, ')" PALPATE_MCAP_CHECK_FOLDER R"(')
sys.dont_write_bytecode = True
import mcap_check as m
w = m.Writer(sys.argv[1] + '/a.mcap')
for at, rows in enumerate([[[7, 2]], [[1], [2]], [[9, 2]], [[1], [2]]], 1):
  image = m.cdr_image(at * 10**6, rows, 'mono16')
  w.message('/pad', 'sensor_msgs/msg/Image', image, at * 10**6)
w.close()
)");
  const BatchTask task = picturesTask({}, "png");
  const BatchItem item{.source = folder_ / "a.mcap", .target = folder_ / "a.png"};
  const BatchAnswer answer = task.work(item, Overwrite::kRefuse, {}, 1);
  EXPECT_TRUE(fs::exists(item.target));
  EXPECT_NE(answer.problem.find("a.mcap: 2 messages of the topic \"/pad\" are left out"),
            std::string::npos)
      << answer.problem;
}

TEST_F(BatchWindowTest, CancelKeepsWhatIsDoneAndStartGoesOn) {
  constexpr int kFiles = 40;
  makeMany(kFiles);
  const fs::path out = folder_ / "out";
  const BatchChoices choices{
      .paths = {text(folder_ / "many")}, .work = BatchWork::kSignals, .folder = text(out)};
  begin(choices);
  EXPECT_FALSE(dialog().findChild<QPushButton*>("batchStart")->isEnabled());
  ASSERT_TRUE(QTest::qWaitFor([&] { return fs::exists(out) && filesIn(out).size() > 2; }, 30'000));
  EXPECT_TRUE(busy());
  EXPECT_TRUE(window().state().actions.at("open")->isEnabled()) << "the window goes on";
  dialog().findChild<QPushButton*>("batchCancel")->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !busy(); }, 20'000));
  const auto made = filesIn(out);
  EXPECT_LT(made.size(), static_cast<std::size_t>(kFiles));
  for (const auto& [name, bytes] : made) EXPECT_EQ(bytes, made.begin()->second) << name;
  const auto* said = dialog().findChild<QLabel*>("batchSaid");
  EXPECT_TRUE(said->text().startsWith("Cancelled: ")) << said->text().toStdString();
  EXPECT_TRUE(said->text().contains("not done"));
  EXPECT_EQ(dialog().findChild<QTableView*>("batchTable")->model()->rowCount(), kFiles)
      << "nothing failed: what is done and what isn't is listed";
  run(choices);
  EXPECT_EQ(filesIn(out).size(), static_cast<std::size_t>(kFiles));
  EXPECT_TRUE(said->text().contains(QString("%1 skipped").arg(made.size())))
      << said->text().toStdString();
}

TEST_F(BatchWindowTest, RunsOnWhileTheDialogIsClosedAndEscapeEndsIt) {
  makeMany(400);
  begin({.paths = {text(folder_ / "many")},
         .work = BatchWork::kSlip,
         .folder = text(folder_ / "out")});
  dialog().close();
  EXPECT_TRUE(busy());
  const auto* cancel = find<QPushButton>("cancelBatch");
  EXPECT_TRUE(QTest::qWaitFor([&] { return cancel->isVisible() || !busy(); }, 20'000));
  press(Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !busy(); }, 20'000));
  EXPECT_TRUE(window().state().messages.flashed().startsWith("Batch cancelled: "));
}

TEST_F(BatchWindowTest, QuittingAsksAndEndsTheBatch) {
  makeMany(400);
  const fs::path out = folder_ / "out";
  begin({.paths = {text(folder_ / "many")}, .work = BatchWork::kSlip, .folder = text(out)});
  ASSERT_TRUE(QTest::qWaitFor([&] { return fs::exists(out) && !filesIn(out).empty(); }, 30'000));
  ask_.choices = {QString(), "&Yes"};
  EXPECT_FALSE(window().close());
  EXPECT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_TRUE(window().isVisible());
  EXPECT_TRUE(busy()) << "it goes on";
  EXPECT_TRUE(window().close());
  EXPECT_FALSE(window().findChild<BatchDialog*>()->isVisible());
  window_.reset();
  for (const auto& [name, bytes] : filesIn(out)) EXPECT_FALSE(bytes.empty()) << name;
  start();
  EXPECT_EQ(dialog().choices().folder, text(out)) << "the choices are remembered";
}

TEST_F(BatchWindowTest, BeginsWithTheShownRecordingAndTakesItsFilters) {
  open({"good.dsa"});
  EXPECT_EQ(dialog().choices().paths, QStringList{text(folder_ / "good.dsa")});
  const std::vector<std::string> median = {"median:size=3"};
  window().state().activeFilters.restore(parseRecipe(median));
  dialog().findChild<QPushButton*>("batchTakeFilters")->click();
  EXPECT_TRUE(dialog().choices().filters.startsWith("median"));
  EXPECT_FALSE(dialog().isModal());
  // analyst m26: another recording is shown when it is opened again.
  dialog().close();
  open({"good2.dsa"});
  actions().at("batch")->trigger();
  EXPECT_EQ(dialog().choices().paths, QStringList{text(folder_ / "good2.dsa")});
}

}  // namespace
}  // namespace palpate::gui::batch_window_test
