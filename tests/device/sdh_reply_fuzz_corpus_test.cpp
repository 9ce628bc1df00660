// Replays the fuzzer's corpus, so that what it once found stays found.
#include <cstdint>

#include "testing/testing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace palpate {
namespace {

TEST(SdhReplyFuzzCorpus, ReplaysWithoutHarm) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PALPATE_FUZZ_CORPUS)) {
    SCOPED_TRACE(entry.path().string());
    const std::string bytes = testing::readFile(entry.path());
    EXPECT_EQ(
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()),
        0);
    ++files;
  }
  EXPECT_GE(files, 6u);
}

}  // namespace
}  // namespace palpate
