#include "fuzz/corpus_replay.h"

namespace palpate::testing::dsa_fuzz_corpus_test {
namespace {

TEST(DsaFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 15); }

}  // namespace
}  // namespace palpate::testing::dsa_fuzz_corpus_test
