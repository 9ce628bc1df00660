#include "fuzz/corpus_replay.h"

namespace palpate::testing::touch_fuzz_corpus_test {
namespace {

TEST(TouchFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::testing::touch_fuzz_corpus_test
