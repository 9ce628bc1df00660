#include "fuzz/corpus_replay.h"

namespace palpate::testing::hand_fuzz_corpus_test {
namespace {

TEST(HandFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 11); }

}  // namespace
}  // namespace palpate::testing::hand_fuzz_corpus_test
