// What counts as touched in filtered values: what was active as recorded. Expected numbers are
// computed here from the frames as they came and from what the filters gave, taxel by taxel.

#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/characteristic_signals.h"

#include "testing/testing.h"

namespace palpate::filtered_contact_test {
namespace {

const char* const kEach[] = {"box",
                             "gaussian",
                             "median",
                             "bilateral",
                             "nlm",
                             "opening",
                             "threshold:above=300",
                             "running-mean",
                             "running-mean:centred=1",
                             "temporal-gaussian",
                             "temporal-min",
                             "kalman",
                             "kalman:centred=1",
                             "rts",
                             "kelvin-voigt:m=1,e=400,eta=40,q=1e8,r=1",
                             "savitzky-golay",
                             "low-pass",
                             "band-pass:order=4",
                             "band-stop:centred=1",
                             "median3d",
                             "min-median",
                             "median | kalman | gaussian"};

Recipe recipeOf(const std::string& text) { return parseRecipe(std::vector<std::string>{text}); }

Profile grasps() { return synthesize({.durationS = 5.0, .grasps = 2, .noiseCounts = 12.0}); }

// A taxel of a frame: as recorded, and all that the filters gave.
struct Taxel {
  float recorded, given;
  bool active() const { return recorded > 0.0F && given > 0.0F; }
};

std::vector<Taxel> taxelsOf(const TactileFrame& recorded, const TactileFrame& filtered) {
  std::vector<Taxel> taxels;
  for (std::size_t i = 0; i < recorded.values.size(); ++i)
    taxels.push_back({recorded.values[i], filtered.allValues()[i]});
  return taxels;
}

TEST(FilteredContact, IsWhatWasActiveAsRecorded) {
  const Profile source = grasps();
  for (const char* text : kEach) {
    SCOPED_TRACE(text);
    const Profile filtered = filteredProfile(source, recipeOf(text));
    std::size_t wrong = 0;
    for (std::size_t f = 0; f < source.numFrames(); ++f) {
      const TactileFrame seen = filtered.frame(f);
      const std::vector<Taxel> taxels = taxelsOf(source.frame(f), seen);
      int active = 0;
      double sum = 0.0;
      for (std::size_t i = 0; i < taxels.size(); ++i) {
        wrong += seen.values[i] == (taxels[i].recorded > 0.0F ? taxels[i].given : 0.0F) ? 0 : 1;
        if (!taxels[i].active()) continue;
        ++active;
        sum += static_cast<double>(taxels[i].given);
      }
      const CharacteristicSignals whole = wholeFrameSignals(seen);
      ASSERT_EQ(whole.active, active) << f;
      ASSERT_NEAR(whole.sum, sum, 1e-9 * sum) << f;
    }
    EXPECT_EQ(wrong, 0u);
  }
}

// The bytes of one array of an .npz that is stored, not packed (PKWARE APPNOTE 4.3.7;
// numpy.lib.format, version 1.0).
std::string arrayOf(const std::string& npz, const std::string& name) {
  const std::size_t at = npz.find(name);
  if (at == std::string::npos) return {};
  const auto u16 = [&](std::size_t from) {
    return static_cast<std::size_t>(static_cast<unsigned char>(npz[from])) |
           static_cast<std::size_t>(static_cast<unsigned char>(npz[from + 1])) << 8;
  };
  const std::size_t npy = at + u16(at - 4) + u16(at - 2);
  const std::size_t data = npy + 10 + u16(npy + 8);
  return npz.substr(data, npz.find("PK\x07\x08", data) - data);
}

// Beside all that the filters gave stands what counts as touched, as .csv has it.
TEST(FilteredContact, AnNpzSaysWhichTaxelsAreActive) {
  const testing::TemporaryFolder folder;
  std::vector<float> values(486, 0.0F);
  values[84 + 8 * 6 + 2] = 700.0F;
  ProfileBuilder builder(sdh2().layout);
  builder.addFrame(1'400'000'000'000'000, values);
  const Profile recorded = builder.finish({});
  saveRecording(filteredProfile(recorded, recipeOf("gaussian:sigma=1")), {}, folder / "a.npz");
  const std::string npz = testing::readFile(folder / "a.npz");
  const std::string given = arrayOf(npz, "m1.npy"), active = arrayOf(npz, "m1_active.npy");
  ASSERT_EQ(given.size(), 78u * 4);
  ASSERT_EQ(active.size(), 78u);
  EXPECT_NE(given.substr(4 * (8 * 6 + 3), 4), std::string(4, '\0')) << "smeared to its neighbour";
  for (std::size_t i = 0; i < active.size(); ++i)
    EXPECT_EQ(active[i], i == 8 * 6 + 2 ? '\1' : '\0') << i;
  EXPECT_NE(npz.find("'descr': '|b1'"), std::string::npos);
  saveRecording(recorded, {}, folder / "b.npz");
  EXPECT_EQ(testing::readFile(folder / "b.npz").find("_active"), std::string::npos)
      << "as recorded, the values say it";
}

// analyst M10: a sensor sends its noise, every taxel of it above 0 at times, and is touched once.
TEST(FilteredContact, NoiseBelowTheThresholdIsNoContact) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 40; ++i) {
    std::vector<float> values(sdh2().layout->numCells());
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = static_cast<float>((7 * k + 3 * static_cast<std::size_t>(i)) % 11);  // 0..10
    if (i >= 10 && i < 20) values[40] = 10.5F;
    builder.addFrame(31'546 * i + 1, values);
  }
  const Profile source = builder.finish({});
  EXPECT_GT(wholeFrameSignals(source.frame(0)).active, 400);
  const Profile filtered = filteredProfile(source, recipeOf("threshold:above=10"));
  for (std::size_t i = 0; i < 40; ++i) {
    const CharacteristicSignals signals = wholeFrameSignals(filtered.frame(i));
    EXPECT_EQ(signals.active, i >= 10 && i < 20 ? 1 : 0) << i;
    EXPECT_EQ(signals.mean, i >= 10 && i < 20 ? 10.5 : 0.0) << i;
  }
}

TEST(FilteredContact, NoContactOutlivesTheRecordedOneAndTheTailIsStillThere) {
  // A taxel is pressed with 1000 counts for 10 frames, then let go.
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 40; ++i) {
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    if (i >= 10 && i < 20) values[40] = 1000.0F;
    builder.addFrame(31'546 * i + 1, values);
  }
  const Profile source = builder.finish({});
  const Profile filtered = filteredProfile(source, recipeOf("kalman"));
  for (std::size_t i = 0; i < 40; ++i) {
    const TactileFrame frame = filtered.frame(i);
    EXPECT_EQ(wholeFrameSignals(frame).active, i >= 10 && i < 20 ? 1 : 0) << i;
    // What the filter makes of it is the recursion itself: it decays by a constant factor.
    if (i > 25) {
      EXPECT_NEAR(frame.allValues()[40] / filtered.frame(i - 1).allValues()[40], 0.729844, 1e-4);
    }
  }
}

TEST(FilteredContact, IsThatOfTheFirstRecordingWhenAFilteredOneIsFilteredAgain) {
  const Profile source = grasps();
  const Profile once = filteredProfile(source, recipeOf("kalman"));
  const Profile twice = filteredProfile(once, recipeOf("running-mean"));
  const Profile together = filteredProfile(source, recipeOf("kalman | running-mean"));
  for (std::size_t f = 0; f < source.numFrames(); ++f) {
    ASSERT_EQ(twice.frame(f).allValues(), together.frame(f).allValues()) << f;
    ASSERT_EQ(twice.frame(f).values, together.frame(f).values) << f;
  }
}

TEST(FilteredContact, IsKeptInACopyAndInItsPart) {
  const Profile source = grasps();
  const testing::TemporaryFolder folder;
  for (const char* text : {"kalman", "rts", "gaussian"}) {
    const Profile filtered = filteredProfile(source, recipeOf(text));
    saveRecording(filtered, {}, folder / "copy.palpate", Overwrite::kReplace);
    const Profile copy = openRecording(folder / "copy.palpate");
    EXPECT_EQ(copy.info().valueType, ValueType::kFloat);
    for (std::size_t f = 0; f < source.numFrames(); ++f) {
      ASSERT_EQ(copy.frame(f).values, filtered.frame(f).values) << text << " " << f;
      ASSERT_EQ(copy.frame(f).allValues(), filtered.frame(f).allValues()) << text << " " << f;
    }
    EXPECT_EQ(verifyRecording(folder / "copy.palpate").state, VerifyReport::State::kSound);
  }
}

// The plateau of the tenth grasp of the ball, pads of two fingers (study, recordings of 2014).
TEST(FilteredContact, HasTheGraspsAreasAndMeansOfTheRecording) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const Profile source = openRecording(*folder / "grasps/foam_ball.dsa");
  for (const char* text : {"kalman", "rts", "kelvin-voigt", "running-mean"}) {
    SCOPED_TRACE(text);
    const Profile filtered = filteredProfile(source, recipeOf(text));
    // The ball was let go with frame 586.
    EXPECT_EQ(wholeFrameSignals(source.frame(600)).active, 0);
    EXPECT_EQ(wholeFrameSignals(filtered.frame(600)).active, 0);
    EXPECT_GT(wholeFrameSignals(filtered.frame(585)).active, 0);
    double before = 0.0, after = 0.0;
    for (std::size_t f = 2820; f < 2920; ++f) {
      const MatrixLayout& layout = source.layout().matrix(1);
      const auto raw = characteristicSignals(std::as_const(source).frame(f).matrix(1), layout);
      const auto smooth = characteristicSignals(std::as_const(filtered).frame(f).matrix(1), layout);
      EXPECT_EQ(smooth.active, raw.active) << f;
      before += raw.mean / 100.0;
      after += smooth.mean / 100.0;
    }
    EXPECT_NEAR(after, before, 3.0);  // counts of about 620; before: 592 (kalman), 557 (rts)
  }
}

}  // namespace
}  // namespace palpate::filtered_contact_test
