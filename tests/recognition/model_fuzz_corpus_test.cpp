#include "fuzz/corpus_replay.h"

namespace palpate::model_fuzz_corpus_test {
namespace {

TEST(ModelFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::model_fuzz_corpus_test
