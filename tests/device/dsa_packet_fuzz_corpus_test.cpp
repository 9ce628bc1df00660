#include "fuzz/corpus_replay.h"

namespace palpate::testing::dsa_packet_fuzz_corpus_test {
namespace {

TEST(DsaPacketFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 4); }

}  // namespace
}  // namespace palpate::testing::dsa_packet_fuzz_corpus_test
