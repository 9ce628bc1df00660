// Replays a fuzzer's corpus as an ordinary test, so that what it once found stays found. The test
// is linked with the fuzzer's source and told the folder by PALPATE_FUZZ_CORPUS.
#pragma once

#include <cstdint>

#include "testing/testing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace palpate::testing {

inline void expectCorpusReplays(const std::filesystem::path& corpus, std::size_t fewestFiles) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    SCOPED_TRACE(entry.path().string());
    const std::string bytes = readFile(entry.path());
    EXPECT_EQ(
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()),
        0);
    ++files;
  }
  EXPECT_GE(files, fewestFiles);
}

}  // namespace palpate::testing
