#include "fuzz/corpus_replay.h"

namespace palpate::table_fuzz_corpus_test {
namespace {

TEST(TableFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 10); }

}  // namespace
}  // namespace palpate::table_fuzz_corpus_test
