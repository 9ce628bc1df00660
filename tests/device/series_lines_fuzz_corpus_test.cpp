#include "fuzz/corpus_replay.h"

namespace palpate::testing::series_lines_fuzz_corpus_test {
namespace {

TEST(SeriesLinesFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::testing::series_lines_fuzz_corpus_test
