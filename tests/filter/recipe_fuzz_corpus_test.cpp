#include "fuzz/corpus_replay.h"

namespace palpate {
namespace {

TEST(RecipeFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate
