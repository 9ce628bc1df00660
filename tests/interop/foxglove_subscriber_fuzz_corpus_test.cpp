#include "fuzz/corpus_replay.h"

namespace palpate::foxglove_subscriber_fuzz_corpus_test {
namespace {

TEST(FoxgloveSubscriberFuzzCorpus, Replays) {
  testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 6);
}

}  // namespace
}  // namespace palpate::foxglove_subscriber_fuzz_corpus_test
