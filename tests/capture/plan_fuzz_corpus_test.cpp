#include "fuzz/corpus_replay.h"

namespace palpate::testing::plan_fuzz_corpus_test {
namespace {

TEST(PlanFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 2); }

}  // namespace
}  // namespace palpate::testing::plan_fuzz_corpus_test
