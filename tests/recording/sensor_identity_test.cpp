// C-E4: which sensor a matrix was is kept, so that a worn-out one can be told apart in old
// recordings.
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::sensor_identity_test {
namespace {

// A short recording of six matrices with ids of their own; the last one has none.
Profile profileWithIds() {
  SyntheticOptions options;
  options.durationS = 20.0;
  const Profile plain = synthesize(options);
  std::vector<MatrixLayout> matrices = plain.layout().matrices();
  for (std::size_t m = 0; m + 1 < matrices.size(); ++m)
    matrices[m].uniqueId = "28FF00AB0C1" + std::to_string(m);
  ProfileBuilder builder(std::make_shared<const SensorLayout>(SensorLayout(matrices)));
  for (std::size_t i = 0; i < plain.numFrames(); ++i) {
    const TactileFrame frame = plain.frame(i);
    builder.addFrame(frame.hostUs, frame.values);
  }
  return builder.finish(plain.info());
}

class SensorIdentity : public ::testing::TestWithParam<const char*> {};

TEST_P(SensorIdentity, IsKeptInARecording) {
  const testing::TemporaryFolder folder;
  const auto path = folder / GetParam();
  const Profile written = profileWithIds();
  saveRecording(written, {}, path);
  const Profile read = openRecording(path);
  for (std::size_t m = 0; m < 6; ++m)
    EXPECT_EQ(read.layout().matrix(m).uniqueId, written.layout().matrix(m).uniqueId) << m;
  EXPECT_EQ(read.layout(), written.layout());
}

INSTANTIATE_TEST_SUITE_P(Forms,
                         SensorIdentity,
                         ::testing::Values("a.palpate", "a.dsa"),
                         [](const auto& instance) {
                           return std::string(instance.param).substr(2);
                         });

}  // namespace
}  // namespace palpate::sensor_identity_test
