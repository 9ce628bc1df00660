#include "fuzz/corpus_replay.h"

namespace palpate::remote_request_fuzz_corpus_test {
namespace {

TEST(RemoteRequestFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::remote_request_fuzz_corpus_test
