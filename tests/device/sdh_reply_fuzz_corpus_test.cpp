#include "fuzz/corpus_replay.h"

namespace palpate::testing {
namespace {

TEST(SdhReplyFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 6); }

}  // namespace
}  // namespace palpate::testing
