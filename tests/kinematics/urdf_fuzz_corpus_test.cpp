#include "fuzz/corpus_replay.h"

namespace palpate::testing::urdf_fuzz_corpus_test {
namespace {

TEST(UrdfFuzzCorpus, ReplaysWithoutHarm) { expectCorpusReplays(PALPATE_FUZZ_CORPUS, 7); }

}  // namespace
}  // namespace palpate::testing::urdf_fuzz_corpus_test
