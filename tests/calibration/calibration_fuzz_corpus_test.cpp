#include "fuzz/corpus_replay.h"

namespace palpate::calibration_fuzz_corpus_test {
namespace {

TEST(CalibrationFuzzCorpus, Replays) { testing::expectCorpusReplays(PALPATE_FUZZ_CORPUS, 5); }

}  // namespace
}  // namespace palpate::calibration_fuzz_corpus_test
