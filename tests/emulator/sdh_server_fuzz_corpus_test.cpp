#include "fuzz/corpus_replay.h"

namespace palpate::testing {
namespace {

TEST(SdhServerFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 7); }

}  // namespace
}  // namespace palpate::testing
