#include "fuzz/corpus_replay.h"

namespace palpate::testing::series_rows_fuzz_corpus_test {
namespace {

TEST(SeriesRowsFuzzCorpus, replaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::testing::series_rows_fuzz_corpus_test
