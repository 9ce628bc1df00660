// The bad days of a recorder: disk full, input/output errors, power cuts, kills. Counted: what the
// writer said was on disk is there afterwards, nothing is wrong, nothing is there twice.
#include "recording/palpate_faults.h"

#include <sys/stat.h>

#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::palpate_faults_test {
namespace {
using namespace testing;
using Fault = FaultyVfs::Fault;

TEST(PalpateFaults, powerCutAtEveryOperationLosesNothingThatWasCommitted) {
  const std::int64_t operations = operationsOfRun();
  ASSERT_GT(operations, 100);
  for (std::int64_t n = 1; n <= operations; ++n) cutPowerAt(n, static_cast<unsigned>(n));
}

TEST(PalpateFaults, aDiskFullAtAnyOperationLeavesTheFileValidUpToTheLastCommit) {
  for (std::int64_t n = 1; n <= operationsOfRun(); ++n) {
    failForGoodAt(Fault::kFull, n);
    failForGoodAt(Fault::kError, n);
  }
}

TEST(PalpateFaults, aFaultThatPassesLosesNothing) {
  for (std::int64_t n = 1; n <= operationsOfRun(); ++n) {
    failOnceAt(Fault::kFullOnce, n);
    failOnceAt(Fault::kErrorOnce, n);
  }
}

TEST(PalpateFaults, theMemoryForWhatWaitsIsBoundedAndSaysSo) {
  const TemporaryFolder folder;
  FaultyVfs vfs;
  PalpateWriterOptions options;
  options.vfs = FaultyVfs::name();
  std::size_t added = 0;
  {
    PalpateWriter writer(folder / "r.palpate", sdh2().layout, {}, options);
    vfs.failAt(Fault::kFull, vfs.operations() + 1);
    const std::string longText(kMaxEventBytes, 'x');
    while (!writer.pendingFull()) writer.addEvent({0, 0, "", {}, longText, ""});
    EXPECT_THROW(writer.addFrame(sampleFrame(0)), FileError);
    EXPECT_THROW(writer.commit(), FileError);
    vfs.heal();
    writer.commit();
    EXPECT_FALSE(writer.pendingFull());
    for (; added < 10; ++added) writer.addFrame(sampleFrame(added));
    writer.finish();
  }
  EXPECT_EQ(openRecording(folder / "r.palpate").numFrames(), added);
}

TEST(PalpateFaults, killedAtAnyMomentItOpensWithAllThatWasCommitted) {
  std::mt19937 random(20261121);
  for (int round = 0; round < 30; ++round) killAfter(random() % 30, random());
}

TEST(PalpateFaults, killedTheMomentItsNameAppearsItOpens) {
  for (int round = 0; round < 20; ++round) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "r.palpate";
    const pid_t child = fork();
    if (child == 0) {
      PalpateWriter writer(path, sdh2().layout, {{"serial", "1D9B0057"}});
      for (std::size_t i = 0;; ++i) addSamples(writer, i, i + 1);
    }
    ASSERT_GT(child, 0);
    struct stat found {};
    while (::stat(path.c_str(), &found) != 0) ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const Profile profile = openRecording(path);
    EXPECT_EQ(profile.info().serial, "1D9B0057");
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  }
}

}  // namespace
}  // namespace palpate::palpate_faults_test
