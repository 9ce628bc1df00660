#include "fuzz/corpus_replay.h"

namespace palpate::testing::dsa_server_fuzz_corpus_test {
namespace {

TEST(DsaServerFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 7); }

}  // namespace
}  // namespace palpate::testing::dsa_server_fuzz_corpus_test
