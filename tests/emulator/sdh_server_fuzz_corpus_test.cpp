#include "fuzz/corpus_replay.h"

namespace palpate::testing::sdh_server_fuzz_corpus_test {
namespace {

TEST(SdhServerFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 7); }

}  // namespace
}  // namespace palpate::testing::sdh_server_fuzz_corpus_test
