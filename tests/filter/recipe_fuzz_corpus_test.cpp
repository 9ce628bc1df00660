#include "fuzz/corpus_replay.h"

namespace palpate::recipe_fuzz_corpus_test {
namespace {

TEST(RecipeFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::recipe_fuzz_corpus_test
