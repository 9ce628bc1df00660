#include "gui/record/recovery_finder.h"

#include <QSignalSpy>
#include <QTest>
#include <latch>
#include <map>

#include <palpate/core/error.h>
#include <palpate/recording/recording.h>

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::gui::recovery_finder_test {
namespace {
namespace fs = std::filesystem;
using testing::writeSamples;

constexpr int kPatienceMs = 20'000;

class RecoveryFinderTest : public ::testing::Test {
 protected:
  RecoveryFinderTest()
      : settings_(QString::fromStdString((settingsFolder_ / "palpate.ini").string()),
                  QSettings::IniFormat) {
    start();
  }
  // As after a restart of the program.
  void start(RecoveryFinder::Recover recoverFile = {}) {
    finder_ = recoverFile ? std::make_unique<RecoveryFinder>(settings_, std::move(recoverFile))
                          : std::make_unique<RecoveryFinder>(settings_);
    found_ = std::make_unique<QSignalSpy>(finder_.get(), &RecoveryFinder::found);
    recovered_ = std::make_unique<QSignalSpy>(finder_.get(), &RecoveryFinder::recovered);
    failed_ = std::make_unique<QSignalSpy>(finder_.get(), &RecoveryFinder::failed);
    finished_ = std::make_unique<QSignalSpy>(finder_.get(), &RecoveryFinder::finished);
    progressed_ = std::make_unique<QSignalSpy>(finder_.get(), &RecoveryFinder::progressed);
  }
  QString path(const char* name) const { return QString::fromStdString((folder_ / name).string()); }
  QString folder() const { return QString::fromStdString(folder_.path().string()); }
  QStringList look() {
    const auto before = found_->size();
    finder_->look(folder());
    if (!QTest::qWaitFor([&] { return found_->size() > before; }, kPatienceMs))
      ADD_FAILURE() << "nothing was heard";
    return found_->isEmpty() ? QStringList{"?"} : found_->last()[0].toStringList();
  }
  std::map<std::string, std::string> content() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      files[entry.path().filename().string()] = testing::readFile(entry.path());
    return files;
  }

  const testing::TemporaryFolder folder_;
  const testing::TemporaryFolder settingsFolder_;
  QSettings settings_;
  std::unique_ptr<RecoveryFinder> finder_;
  std::unique_ptr<QSignalSpy> found_, recovered_, failed_, finished_, progressed_;
};

TEST_F(RecoveryFinderTest, FindsRecoversAndOffersNoMore) {
  writeSamples(folder_ / "done.palpate", 20);
  writeSamples(folder_ / "died.palpate", 70, false);
  ASSERT_EQ(look(), QStringList{path("died.palpate")});
  EXPECT_FALSE(finder_->busy());
  const auto before = content();
  finder_->recover({path("died.palpate")});
  EXPECT_TRUE(finder_->busy());
  ASSERT_TRUE(finished_->wait(kPatienceMs));
  EXPECT_FALSE(finder_->busy());
  ASSERT_EQ(recovered_->size(), 1);
  EXPECT_EQ(failed_->size(), 0);
  EXPECT_EQ((*recovered_)[0][0].toString(), path("died.palpate"));
  EXPECT_TRUE((*recovered_)[0][1].toString().startsWith("saved 70 frames"))
      << (*recovered_)[0][1].toString().toStdString();
  EXPECT_EQ((*recovered_)[0][2].toString(), path("died_recovered.palpate"));
  // The same samples; and all that was there before is as it was.
  EXPECT_TRUE(testing::dumped(openRecording(folder_ / "died_recovered.palpate")) ==
              testing::dumped(openRecording(folder_ / "died.palpate")));
  EXPECT_EQ(verifyRecording(folder_ / "died_recovered.palpate").state, VerifyReport::State::kSound);
  auto after = content();
  EXPECT_EQ(after.erase("died_recovered.palpate"), 1u);
  EXPECT_EQ(after, before);
  EXPECT_EQ(look(), QStringList{});
  for (const auto& step : *progressed_) {
    EXPECT_GE(step[0].toDouble(), 0.0);
    EXPECT_LE(step[0].toDouble(), 1.0);
  }
}

TEST_F(RecoveryFinderTest, TellsWhatCantBeRecoveredAndGoesOn) {
  writeSamples(folder_ / "good.palpate", 10, false);
  testing::writeFile(folder_ / "bad.palpate", "SQLite format 3 no more");
  finder_->recover({path("gone.palpate"), path("bad.palpate"), path("good.palpate")});
  ASSERT_TRUE(finished_->wait(kPatienceMs));
  ASSERT_EQ(failed_->size(), 2);
  EXPECT_EQ((*failed_)[0][0].toString(), path("gone.palpate"));
  EXPECT_TRUE((*failed_)[0][1].toString().contains("No such file"))
      << (*failed_)[0][1].toString().toStdString();
  EXPECT_EQ((*failed_)[1][0].toString(), path("bad.palpate"));
  EXPECT_TRUE((*failed_)[1][1].toString().startsWith(path("bad.palpate") + ": "))
      << (*failed_)[1][1].toString().toStdString();
  EXPECT_EQ(recovered_->size(), 1);
  EXPECT_EQ(finished_->size(), 1);
}

TEST_F(RecoveryFinderTest, IgnoredOnesAreNotOfferedUntilTheyChange) {
  writeSamples(folder_ / "a b.palpate", 10, false);
  writeSamples(folder_ / "c.palpate", 10, false);
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(folder_ / "a b.palpate", now);
  fs::last_write_time(folder_ / "c.palpate", now - std::chrono::hours(1));
  EXPECT_EQ(look(), (QStringList{path("a b.palpate"), path("c.palpate")}));
  const auto before = content();
  finder_->ignore({path("a b.palpate"), path("never heard of.palpate")});
  EXPECT_EQ(look(), QStringList{path("c.palpate")});
  EXPECT_EQ(content(), before);
  settings_.sync();
  start();
  EXPECT_EQ(look(), QStringList{path("c.palpate")}) << "after a restart";
  fs::last_write_time(folder_ / "a b.palpate", now + std::chrono::seconds(5));
  EXPECT_EQ(look(), (QStringList{path("a b.palpate"), path("c.palpate")}));
  // Ignored again and again it stands in the settings once.
  for (int i = 0; i < 3; ++i) finder_->ignore({path("a b.palpate")});
  EXPECT_EQ(look(), QStringList{path("c.palpate")});
  EXPECT_EQ(settings_.value("recording/ignored").toStringList().size(), 1);
}

TEST_F(RecoveryFinderTest, AFolderThatCantBeLookedIntoIsSaid) {
  testing::writeFile(folder_ / "file", "");
  finder_->look(path("file"));
  ASSERT_TRUE(found_->wait(kPatienceMs));
  EXPECT_EQ((*found_)[0][0].toStringList(), QStringList{});
  ASSERT_EQ(failed_->size(), 1);
  EXPECT_TRUE((*failed_)[0][1].toString().contains("can't be listed"));
  finder_->look(path("not there"));
  ASSERT_TRUE(found_->wait(kPatienceMs));
  EXPECT_EQ((*found_)[1][0].toStringList(), QStringList{});
  EXPECT_EQ(failed_->size(), 1) << "the first day is no failure";
}

TEST_F(RecoveryFinderTest, WhatIsAskedForMeanwhileWaitsItsTurn) {
  writeSamples(folder_ / "a.palpate", 10, false);
  finder_->look(folder());
  finder_->recover({path("a.palpate")});
  finder_->look(folder());
  ASSERT_TRUE(QTest::qWaitFor([&] { return found_->size() == 2; }, kPatienceMs));
  EXPECT_EQ((*found_)[0][0].toStringList(), QStringList{path("a.palpate")});
  EXPECT_EQ(recovered_->size(), 1);
  EXPECT_EQ(finished_->size(), 1);
  EXPECT_EQ((*found_)[1][0].toStringList(), QStringList{});
}

TEST_F(RecoveryFinderTest, CancelReachesWhatIsInWork) {
  int begun = 0;
  start([&begun](const auto&, const auto&, const Progress& progress) -> RecoverReport {
    ++begun;
    while (progress(0.5)) {
    }
    throw Cancelled();
  });
  QObject::connect(
      finder_.get(), &RecoveryFinder::progressed, finder_.get(), [this] { finder_->cancel(); });
  finder_->recover({path("a.palpate"), path("b.palpate")});
  ASSERT_TRUE(finished_->wait(kPatienceMs));
  EXPECT_FALSE(finder_->busy());
  EXPECT_EQ(begun, 1) << "the second one is given up as well";
  EXPECT_EQ(recovered_->size(), 0);
  EXPECT_EQ(failed_->size(), 0);
  ASSERT_EQ(progressed_->size(), 1);
  EXPECT_EQ((*progressed_)[0][0].toDouble(), 0.25) << "half of the first of two";
}

TEST_F(RecoveryFinderTest, CancelGivesUpWhatWaits) {
  writeSamples(folder_ / "a.palpate", 10, false);
  const auto before = content();
  finder_->recover({path("a.palpate")});
  finder_->recover({path("a.palpate")});
  finder_->look(folder());
  finder_->cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished_->size() == 2; }, kPatienceMs));
  EXPECT_EQ(failed_->size(), 0);
  // The one in work may have been done already; the one behind it never began.
  EXPECT_LE(recovered_->size(), 1);
  EXPECT_EQ(content().size(), before.size() + static_cast<std::size_t>(recovered_->size()));
  // It can be used again, and of the look that was given up nothing is heard.
  EXPECT_EQ(look().size(), static_cast<qsizetype>(recovered_->isEmpty() ? 1 : 0));
  EXPECT_EQ(found_->size(), 1);
}

// Window F7.
TEST_F(RecoveryFinderTest, LeavingDoesNotWaitForAFolderThatDoesNotAnswer) {
  const auto end = std::make_shared<std::latch>(1);
  start([end](const auto&, const auto&, const Progress&) {
    end->wait();
    return RecoverReport{};
  });
  finder_->recover({path("a.palpate")});
  finder_.reset();
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1))) << "it still hangs";
  end->count_down();
  EXPECT_TRUE(Abandonable::awaitThreads(std::chrono::milliseconds(kPatienceMs)));
}

TEST_F(RecoveryFinderTest, CanBeDestroyedWhileItWorks) {
  writeSamples(folder_ / "long.palpate", 2000, false);
  const auto before = content();
  for (int i = 0; i < 10; ++i) {
    RecoveryFinder finder(settings_);
    finder.look(folder());
    finder.recover({path("long.palpate"), path("long.palpate")});
    finder.recover({path("long.palpate")});
    QTest::qWait(i);  // at different moments of its work
  }
  ASSERT_TRUE(Abandonable::awaitThreads(std::chrono::milliseconds(kPatienceMs)));
  // Whatever became of them: whole files, or none.
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    if (before.count(name)) continue;
    EXPECT_EQ(verifyRecording(entry.path()).state, VerifyReport::State::kSound) << name;
    EXPECT_EQ(openRecording(entry.path()).numFrames(), 2000u) << name;
  }
}

}  // namespace
}  // namespace palpate::gui::recovery_finder_test
