#include "fuzz/corpus_replay.h"

namespace palpate::testing::sdh_reply_fuzz_corpus_test {
namespace {

TEST(SdhReplyFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 6); }

}  // namespace
}  // namespace palpate::testing::sdh_reply_fuzz_corpus_test
