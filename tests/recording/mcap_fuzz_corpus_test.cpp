#include "fuzz/corpus_replay.h"

namespace palpate::testing::mcap_fuzz_corpus_test {
namespace {

TEST(McapFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 8); }

}  // namespace
}  // namespace palpate::testing::mcap_fuzz_corpus_test
