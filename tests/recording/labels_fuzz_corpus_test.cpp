#include "fuzz/corpus_replay.h"

namespace palpate::testing::labels_fuzz_corpus_test {
namespace {

TEST(LabelsFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 2); }

}  // namespace
}  // namespace palpate::testing::labels_fuzz_corpus_test
