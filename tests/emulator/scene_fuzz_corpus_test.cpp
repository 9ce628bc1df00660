#include "fuzz/corpus_replay.h"

namespace palpate::scene_fuzz_corpus_test {
namespace {

TEST(SceneFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::scene_fuzz_corpus_test
