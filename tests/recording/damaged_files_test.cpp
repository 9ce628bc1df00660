// Damaged, cut, huge and hostile files: exactly one error each, whose message names the place, and
// little memory.
#include <random>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/recording.h"

#include "recording/dsa_corpus.h"
#include "testing/testing.h"

namespace palpate::damaged_files_test {
namespace {
namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // shadow memory counts as memory
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

// The message of the one error, or "" when the file opens.
std::string errorOf(const fs::path& path) {
  try {
    openRecording(path);
  } catch (const FileError& error) {
    return error.what();
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

void expectError(const fs::path& path, const std::vector<std::string>& parts) {
  const std::string message = errorOf(path);
  EXPECT_NE(message, "") << "opened";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
  EXPECT_LT(message.size(), path.string().size() + 400) << message;
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" not in: " << message;
}

// Opens the file in a process of its own. Returns its highest memory [bytes]; fails unless the file
// is refused with a message that holds `part`.
std::uint64_t memoryOfRefusal(const fs::path& path, const std::string& part) {
  const pid_t child = fork();
  if (child == 0) {
    const bool refused = errorOf(path).find(part) != std::string::npos;
    _exit(refused ? 0 : 1);
  }
  int status = 0;
  rusage usage{};
  EXPECT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
      << path.filename() << " was not refused with \"" << part << "\"";
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

constexpr std::uint64_t kMemoryLimit = 256u << 20;  // reliability table, R13

class DamagedFile : public ::testing::TestWithParam<testing::DamagedCase> {};

TEST_P(DamagedFile, givesOneErrorThatNamesThePlace) {
  const testing::TemporaryFolder folder;
  const fs::path path = folder / (GetParam().name + ".dsa");
  testing::writeFile(path, GetParam().bytes());
  expectError(path, GetParam().messageParts);
  const std::uint64_t memory = memoryOfRefusal(path, GetParam().messageParts.front());
  if (!kSanitized) {
    EXPECT_LT(memory, kMemoryLimit);
  }
  // Checking a file tells the same and never throws.
  const VerifyReport report = verifyRecording(path);
  EXPECT_NE(report.state, VerifyReport::State::kSound);
  EXPECT_NE(report.message, "");
}

INSTANTIATE_TEST_SUITE_P(Corpus,
                         DamagedFile,
                         ::testing::ValuesIn(testing::damagedCases()),
                         [](const auto& of) { return of.param.name; });

TEST(DamagedFiles, aMissingFileAFolderAndAPipeAreToldApart) {
  const testing::TemporaryFolder folder;
  expectError(folder / "missing.dsa", {"No such file"});
  fs::create_directory(folder / "folder.dsa");
  expectError(folder / "folder.dsa", {"is a folder"});
  ASSERT_EQ(mkfifo((folder / "pipe.dsa").c_str(), 0600), 0);
  expectError(folder / "pipe.dsa", {"not a regular file"});
}

TEST(DamagedFiles, aFileWithoutPermissionIsRefused) {
  const testing::TemporaryFolder folder;
  const fs::path path = folder / "secret.dsa";
  testing::writeFile(path, testing::exampleXml());
  fs::permissions(path, fs::perms::none);
  fs::permissions(folder.path(), fs::perms::all);
  const pid_t child = fork();
  if (child == 0) {
    // root may read everything: be nobody.
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setuid(kNobody) != 0) _exit(2);
    _exit(errorOf(path).find("can't be opened: Permission denied") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(DamagedFiles, aCutAtEveryByteGivesOneError) {
  const testing::TemporaryFolder folder;
  const std::string packed = testing::compressed(testing::exampleXml());
  for (std::size_t size = 0; size < packed.size(); ++size) {
    testing::writeFile(folder / "cut.dsa", packed.substr(0, size));
    expectError(folder / "cut.dsa", {size == 0 ? "is empty" : "ends early"});
  }
}

// 'palpate recover' is named where it may help, and doesn't name itself.
TEST(DamagedFiles, recoveryIsPromisedOnlyWhereSomethingMayBeLeft) {
  const testing::TemporaryFolder folder;
  const std::string packed = testing::compressed(testing::exampleXml());
  testing::writeFile(folder / "cut.dsa", packed.substr(0, packed.size() / 2));
  EXPECT_EQ(recoverRecording(folder / "cut.dsa", folder / "out.palpate").message,
            "nothing can be saved: its bzip2 data ends early, at byte " +
                std::to_string(packed.size() / 2) +
                " of the file: the file is cut within its first block, nothing of it can be read");
  // A second bzip2 stream that is cut.
  testing::writeFile(folder / "second.dsa", packed + packed.substr(0, packed.size() / 2));
  expectError(folder / "second.dsa", {"the file is cut; 'palpate recover' may save"});
  const std::string verified = verifyRecording(folder / "second.dsa").message;
  EXPECT_EQ(verified.find("recover' may"), std::string::npos) << verified;
  for (const char* name : {"empty.dsa", "empty.palpate"}) {
    testing::writeFile(folder / name, "");
    expectError(folder / name, {"is empty"});
  }
}

TEST(DamagedFiles, aFlippedBitAnywhereGivesOneErrorOrTheSameData) {
  const testing::TemporaryFolder folder;
  const std::string packed = testing::compressed(testing::exampleXml());
  std::size_t opened = 0;
  for (std::size_t bit = 0; bit < 8 * packed.size(); ++bit) {
    std::string flipped = packed;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << bit % 8);
    testing::writeFile(folder / "flipped.dsa", flipped);
    try {
      const Profile profile = openRecording(folder / "flipped.dsa");
      ++opened;
      ASSERT_EQ(profile.numFrames(), 2u) << bit;
      EXPECT_EQ(profile.frame(1).values, (std::vector<float>{0, 0, 100, 0, 1000, 0})) << bit;
      EXPECT_EQ(profile.angles(0).values, (std::vector<double>{60, -10, 10, -90, 0, -10, 10}))
          << bit;
    } catch (const FormatError&) {
    }
  }
  // Few bits mean nothing: two of the block size's digit, those that pad the last byte, some of the
  // code lengths of symbols that don't occur.
  EXPECT_LE(opened, packed.size() * 8 / 100);
}

TEST(DamagedFiles, manyFlippedBytesGiveOneErrorEach) {
  const testing::TemporaryFolder folder;
  const std::string packed = testing::compressed(testing::longXml(20, 50, 1));
  std::mt19937 random(20261121);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = packed;
    const int flips = 1 + static_cast<int>(random() % 100);
    for (int i = 0; i < flips; ++i)
      damaged[4 + random() % (damaged.size() - 4)] = static_cast<char>(random());
    if (round % 3 == 0) damaged.resize(random() % damaged.size());
    if (damaged == packed) continue;
    testing::writeFile(folder / "damaged.dsa", damaged);
    expectError(folder / "damaged.dsa", {});
  }
}

struct Bomb {
  std::string name;
  std::string begin;
  char filler;
  std::size_t megabytes;
  std::string message;
};

class BombFile : public ::testing::TestWithParam<Bomb> {};

TEST_P(BombFile, isRefusedInLittleMemory) {
  const testing::TemporaryFolder folder;
  const fs::path path = folder / "bomb.dsa";
  testing::writeBomb(
      path, GetParam().begin, std::string(1u << 20, GetParam().filler), GetParam().megabytes);
  expectError(path, {GetParam().message});
  const std::uint64_t memory = memoryOfRefusal(path, GetParam().message);
  if (!kSanitized) {
    EXPECT_LT(memory, kMemoryLimit);
  }
  EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kUnreadable);
}

const std::string kUpToFrameData = [] {
  const std::string example = testing::exampleXml();
  const std::string_view tag = "<frame_data>";
  return example.substr(0, example.find(tag) + tag.size());
}();

// 200 MB each, some kB when packed; the slow suite opens all five.
std::vector<Bomb> bombs() {
  std::vector<Bomb> all = {
      {"oneText", "<root>", 'a', 200, "expands to more than 32 MB"},
      {"zeros", "", '\0', 200, "not well-formed"},
      {"blanks", "", ' ', 200, "expands to more than 32 MB"},
      {"blanksInFrame", kUpToFrameData, ' ', 200, "expands to more than 32 MB"},
      {"oneName", "<", 'a', 200, "longer than 1048576 bytes"}};
  if (!testing::exhaustive()) all.resize(1);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Corpus, BombFile, ::testing::ValuesIn(bombs()), [](const auto& of) {
  return of.param.name;
});

}  // namespace
}  // namespace palpate::damaged_files_test
