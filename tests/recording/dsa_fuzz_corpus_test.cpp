#include "fuzz/corpus_replay.h"

namespace palpate::testing {
namespace {

TEST(DsaFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 15); }

}  // namespace
}  // namespace palpate::testing
