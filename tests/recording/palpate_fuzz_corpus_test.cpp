#include "fuzz/corpus_replay.h"

namespace palpate::testing::palpate_fuzz_corpus_test {
namespace {

TEST(PalpateFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 11); }

}  // namespace
}  // namespace palpate::testing::palpate_fuzz_corpus_test
