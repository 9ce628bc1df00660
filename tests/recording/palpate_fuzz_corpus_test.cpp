#include "fuzz/corpus_replay.h"

namespace palpate::testing {
namespace {

TEST(PalpateFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 8); }

}  // namespace
}  // namespace palpate::testing
