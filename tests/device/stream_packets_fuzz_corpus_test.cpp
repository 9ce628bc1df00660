#include "fuzz/corpus_replay.h"

namespace palpate::testing::stream_packets_fuzz_corpus_test {
namespace {

TEST(StreamPacketsFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 6); }

}  // namespace
}  // namespace palpate::testing::stream_packets_fuzz_corpus_test
