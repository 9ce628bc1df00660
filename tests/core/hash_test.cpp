#include "palpate/core/hash.h"

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"

#include "testing/testing.h"

namespace palpate::hash_test {
namespace {

// FIPS 180-4 example values.
constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kOfNothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* kOfMillionA =
    "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Hash, MatchesPublishedValues) {
  const std::string abc = "abc";
  EXPECT_EQ(sha256(std::as_bytes(std::span(abc))), kOfAbc);
  EXPECT_EQ(sha256({}), kOfNothing);
}

TEST(Hash, OfFilesLongerThanOnePiece) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a", std::string(1'000'000, 'a'));
  EXPECT_EQ(sha256OfFile(folder / "a"), kOfMillionA);
  EXPECT_THROW(sha256OfFile(folder / "missing"), FileError);
}

TEST(Hash, OfADescriptorFromAByteOn) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a", "head" + std::string(1'000'000, 'a'));
  const FileDescriptor file(::open((folder / "a").c_str(), O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(sha256OfDescriptor(file.get(), 4, folder / "a"), kOfMillionA);
  EXPECT_EQ(sha256OfDescriptor(file.get(), 2'000'000, folder / "a"), kOfNothing);
  EXPECT_EQ(::lseek(file.get(), 0, SEEK_CUR), 0);
  EXPECT_THROW(sha256OfDescriptor(-1, 0, folder / "a"), FileError);
}

}  // namespace
}  // namespace palpate::hash_test
