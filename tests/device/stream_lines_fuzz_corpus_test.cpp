#include "fuzz/corpus_replay.h"

namespace palpate::testing::stream_lines_fuzz_corpus_test {
namespace {

TEST(StreamLinesFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 9); }

}  // namespace
}  // namespace palpate::testing::stream_lines_fuzz_corpus_test
