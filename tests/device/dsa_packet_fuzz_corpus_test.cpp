#include "fuzz/corpus_replay.h"

namespace palpate::testing {
namespace {

TEST(DsaPacketFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 4); }

}  // namespace
}  // namespace palpate::testing
