#include "gui/record/recorded_take.h"

#include <QSignalSpy>

#include <palpate/core/error.h>

#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::recorded_take_test {
namespace {
namespace fs = std::filesystem;

class RecordedTakeTest : public WindowStateTest {
 protected:
  RecordedTakeTest() : take_(*windowState_) {
    for (const char* name : {"run_001.palpate", "run_001.mcap"})
      testing::writeFile(folder_ / name, name);
    ask_.choices = {"Discard", "Delete"};
    take_.moveToTrash = [this](const QString& path) {
      if (!trash_ || path.endsWith(fails_)) return false;
      trashed_ << path.section('/', -1);
      return QFile::remove(path);
    };
    QObject::connect(&windowState_->messages,
                     &Messages::failed,
                     &actionsOf_,
                     [this](const QString&, const QString& text) { failed_ << text; });
    take_.set({folder_ / "run_001.palpate"});
  }
  bool there(const char* name) { return fs::exists(folder_ / name); }

  RecordedTake take_;
  QStringList failed_, trashed_;
  bool trash_ = true;
  QString fails_ = "none";  // the end of the name that the trash doesn't take
};

TEST_F(RecordedTakeTest, GetsANewNameWithWhatBelongsToIt) {
  ask_.texts = {" good ball.palpate "};
  QSignalSpy changed(&take_, &RecordedTake::changed);
  take_.rename();
  EXPECT_EQ(ask_.texts.asked, QStringList("Rename run_001.palpate"));
  EXPECT_EQ(ask_.texts.began, QStringList("run_001"));
  EXPECT_EQ(take_.paths().front(), folder_ / "good_ball.palpate");
  EXPECT_TRUE(there("good_ball.palpate"));
  EXPECT_TRUE(there("good_ball.mcap"));
  EXPECT_FALSE(there("run_001.palpate"));
  EXPECT_EQ(changed.size(), 1);
}

TEST_F(RecordedTakeTest, ATakenNameIsSaidAndAskedAgainWithWhatWasTyped) {
  testing::writeFile(folder_ / "taken.palpate", "other");
  ask_.texts = {"taken", "free"};
  take_.rename();
  EXPECT_EQ(ask_.texts.asked, QStringList(2, "Rename run_001.palpate"));
  EXPECT_TRUE(ask_.texts.filters[1].contains("exists already; give another name"));
  EXPECT_EQ(ask_.texts.began[1], "taken");
  EXPECT_TRUE(there("free.palpate"));
  EXPECT_EQ(testing::readFile(folder_ / "taken.palpate"), "other");
}

TEST_F(RecordedTakeTest, WhatIsNoNameChangesNothing) {
  ask_.texts = {" .. "};
  take_.rename();
  EXPECT_TRUE(there("run_001.palpate"));
  EXPECT_EQ(failed_, QStringList("that is not a valid file name"));
}

TEST_F(RecordedTakeTest, IsDiscardedIntoTheTrashAfterAQuestion) {
  ask_.choices = {QString(), "Discard"};
  take_.discard();
  EXPECT_TRUE(there("run_001.palpate"));
  take_.discard();
  EXPECT_EQ(ask_.choices.asked.back(), "Discard run_001.palpate? It is moved to the trash.");
  EXPECT_EQ(trashed_, (QStringList{"run_001.palpate", "run_001.mcap"}));
  EXPECT_TRUE(take_.paths().empty());
  take_.discard();
  take_.rename();
  EXPECT_EQ(ask_.choices.asked.size(), 2) << "there is nothing any more";
  EXPECT_TRUE(ask_.texts.asked.isEmpty());
}

TEST_F(RecordedTakeTest, WithoutATrashItSaysThatItDeletes) {
  trash_ = false;
  take_.discard();
  ASSERT_EQ(ask_.choices.asked.size(), 2);
  EXPECT_TRUE(ask_.choices.asked[1].contains("has no trash"))
      << ask_.choices.asked[1].toStdString();
  EXPECT_TRUE(ask_.choices.asked[1].endsWith("for good?"));
  EXPECT_FALSE(there("run_001.palpate"));
  EXPECT_FALSE(there("run_001.mcap"));
}

TEST_F(RecordedTakeTest, OfATakeThatIsHalfInTheTrashTheRestIsNamedAndKept) {
  testing::writeFile(folder_ / "run_001_2.palpate", "");
  take_.set({folder_ / "run_001.palpate", folder_ / "run_001_2.palpate"});
  fails_ = "run_001_2.palpate";
  ask_.choices = {"Discard", QString()};
  take_.discard();
  ASSERT_EQ(ask_.choices.asked.size(), 2);
  EXPECT_EQ(ask_.choices.asked[1],
            "Only run_001.palpate, run_001.mcap could be moved to the trash. Delete the rest of "
            "run_001.palpate and 1 more part for good?");
  EXPECT_EQ(failed_,
            QStringList("Partly discarded; in the trash: run_001.palpate, run_001.mcap; kept: "
                        "run_001_2.palpate"));
  EXPECT_EQ(take_.paths(), std::vector<fs::path>{folder_ / "run_001_2.palpate"});
}

TEST_F(RecordedTakeTest, ItIsSaidByWhichPartATakeIsKnownNow) {
  testing::writeFile(folder_ / "run_001_2.palpate", "");
  const fs::path first = folder_ / "run_001.palpate", second = folder_ / "run_001_2.palpate";
  take_.set({first, second});
  std::vector<fs::path> told, gone;
  QObject::connect(&take_,
                   &RecordedTake::beginsWith,
                   &actionsOf_,
                   [&](const fs::path& part, const fs::path& before) {
                     told = {part, before};
                   });
  QObject::connect(&take_, &RecordedTake::discarded, &actionsOf_, [&](const fs::path& path) {
    gone.push_back(path);
  });
  fails_ = "run_001_2.palpate";
  ask_.choices = {"Discard", QString(), "Discard"};
  take_.discard();
  EXPECT_EQ(told, (std::vector{second, first}));
  EXPECT_TRUE(gone.empty());
  fails_ = "none";
  take_.discard();
  EXPECT_EQ(gone, std::vector{second});
}

// The rest can't be deleted either: a folder has taken its place.
TEST_F(RecordedTakeTest, WhatIsInTheTrashIsSaidAlsoWhereTheRestCantBeDeleted) {
  const fs::path second = folder_ / "run_001_2.palpate";
  testing::writeFile(second, "");
  take_.set({folder_ / "run_001.palpate", second});
  fails_ = "run_001_2.palpate";
  ask_.choices.meanwhile = [&] {
    if (ask_.choices.asked.size() < 2) return;
    fs::remove(second);
    fs::create_directories(second / "full");
  };
  take_.discard();
  ASSERT_EQ(failed_.size(), 1);
  EXPECT_TRUE(failed_[0].startsWith("Partly discarded: ")) << failed_[0].toStdString();
  EXPECT_TRUE(
      failed_[0].endsWith("; in the trash: run_001.palpate, run_001.mcap; kept: "
                          "run_001_2.palpate"))
      << failed_[0].toStdString();
}

TEST_F(RecordedTakeTest, ATakeWhoseFilesAreGoneIsDiscarded) {
  QSignalSpy discarded(&take_, &RecordedTake::discarded);
  trash_ = false;
  ask_.choices.meanwhile = [&] {
    if (ask_.choices.asked.size() < 2) return;
    for (const char* name : {"run_001.palpate", "run_001.mcap"}) fs::remove(folder_ / name);
    throw FileError(folder_ / "run_001.palpate", "is gone");
  };
  take_.discard();
  EXPECT_EQ(discarded.size(), 1);
  EXPECT_TRUE(take_.paths().empty());
  ASSERT_EQ(failed_.size(), 1);
  EXPECT_TRUE(failed_[0].endsWith("is gone")) << failed_[0].toStdString();
}

}  // namespace
}  // namespace palpate::gui::recorded_take_test
