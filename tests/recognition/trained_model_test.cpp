#include "palpate/recognition/trained_model.h"

#include <algorithm>

#include "palpate/core/error.h"
#include "palpate/recognition/plateau_features.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::trained_model_test {
namespace {

using testing::clouds;
using testing::TemporaryFolder;

constexpr std::int64_t kHourUs = 3600LL * 1'000'000;

// Grasps of objects of 20, 30, .. mm that differ in size (sd .5 mm) and in one more feature,
// measured with an offset.
SampleSet things(int classes, int perClass, double offsetMm, std::uint64_t seed) {
  SampleSet samples = clouds(classes, perClass, 2, 0.0, seed);
  samples.features = {"size_z", "ln_sum"};
  for (Eigen::Index i = 0; i < samples.x.rows(); ++i) {
    const int c = samples.y[static_cast<std::size_t>(i)];
    samples.x(i, 0) = sizeZ(20.0 + 10.0 * c + 0.5 * samples.x(i, 0) + offsetMm);
    samples.x(i, 1) = 8.0 + 0.3 * (c % 3) + 0.1 * samples.x(i, 1);
  }
  return samples;
}

TrainedModel modelOf(const SampleSet& samples, ClassifierKind kind) {
  PipelineOptions options;
  options.classifier = kind;
  TrainedModel model = trainModel(samples, FeatureSet::kBest, "a sensor", options);
  model.inputs = {{"a.dsa", "00", "class 0", 3, 100 * kHourUs, 101 * kHourUs}};
  return model;
}

double shareRight(const std::vector<Prediction>& predictions, const std::vector<int>& y) {
  double right = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) right += predictions[i].label == y[i] ? 1.0 : 0.0;
  return right / static_cast<double>(y.size());
}

TEST(TrainedModel, IsSureInItsOwnSessionOnly) {
  const SampleSet train = things(5, 20, 0.0, 1), test = things(5, 20, 0.0, 2);
  for (const ClassifierKind kind : {ClassifierKind::kGauss, ClassifierKind::kSvm}) {
    const TrainedModel model = modelOf(train, kind);
    const auto here = classifyRows(model, test.x, noOffset(), true);
    EXPECT_GE(shareRight(here, test.y), 0.93) << "a few of a hundred known ones are called unknown";
    EXPECT_GT(std::count_if(here.begin(), here.end(), [](const Prediction& v) { return v.sure; }),
              50)
        << classifierName(kind);
    for (const Prediction& prediction : classifyRows(model, test.x, noOffset(), false))
      EXPECT_FALSE(prediction.sure);
    for (const Prediction& prediction : here) {
      EXPECT_EQ(prediction.ranking.size(), 5u);
      EXPECT_TRUE(std::is_sorted(prediction.p.rbegin(), prediction.p.rend()));
      EXPECT_EQ(prediction.confidence, prediction.p.front());
    }
  }
}

TEST(TrainedModel, CallsWhatItNeverFeltUnknown) {
  const SampleSet train = things(5, 20, 0.0, 1);
  Eigen::MatrixXd strange(1, 2);
  strange << sizeZ(35.0), 20.0;
  for (const ClassifierKind kind :
       {ClassifierKind::kGauss, ClassifierKind::kSvm, ClassifierKind::kQda}) {
    const auto prediction = classifyRows(modelOf(train, kind), strange, noOffset(), true).front();
    EXPECT_EQ(prediction.label, Prediction::kUnknown) << classifierName(kind);
    EXPECT_FALSE(prediction.sure);
    EXPECT_GE(prediction.ranking.size(), 3u)
        << "the likeliest of the known ones are told all the same";
  }
}

TEST(TrainedModel, KnowsItsSessionByTime) {
  const TrainedModel model = modelOf(things(3, 5, 0.0, 1), ClassifierKind::kGauss);
  EXPECT_TRUE(model.sameSession(100 * kHourUs));
  EXPECT_TRUE(model.sameSession(112 * kHourUs));
  EXPECT_FALSE(model.sameSession(114 * kHourUs));
  EXPECT_FALSE(model.sameSession(87 * kHourUs));
}

// The hand measures 5 mm too much in this session, which is half the distance to the next object.
TEST(TrainedModel, AdaptsByLabelledGrasps) {
  const TrainedModel fresh = modelOf(things(6, 20, 0.0, 1), ClassifierKind::kGauss);
  const SampleSet today = things(6, 10, 5.0, 3);
  TrainedModel adapted = fresh;
  std::vector<std::size_t> first;
  for (std::size_t c = 0; c < 3; ++c) first.push_back(10 * c);
  adaptModel(adapted, today.rows(first));
  EXPECT_NEAR(adapted.offset.mm, 5.0, 0.8);
  EXPECT_EQ(adapted.offset.origin, OffsetSource::kReferences);
  EXPECT_TRUE(adapted.offset.trusted);
  EXPECT_LT(shareRight(classifyRows(fresh, today.x, noOffset(), false), today.y), 0.8);
  EXPECT_GT(shareRight(classifyRows(adapted, today.x, adapted.offset, false), today.y), 0.95);
}

TEST(TrainedModel, OneThatCantAdaptSaysSo) {
  TrainedModel model = modelOf(things(4, 8, 0.0, 1), ClassifierKind::kSvm);
  EXPECT_FALSE(model.adaptsToSession());
  try {
    adaptModel(model, things(4, 2, 1.0, 2));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("gauss"), std::string::npos);
  }
  TrainedModel gauss = modelOf(things(4, 8, 0.0, 1), ClassifierKind::kGauss);
  EXPECT_THROW(adaptModel(gauss, things(4, 2, 1.0, 2).rows({})), Error);
}

TEST(TrainedModel, TooFewGraspsMakeAModelThatIsNeverSure) {
  SampleSet samples = things(3, 2, 0.0, 1);
  for (const ClassifierKind kind :
       {ClassifierKind::kGauss, ClassifierKind::kSvm, ClassifierKind::kLda}) {
    const TrainedModel model = modelOf(samples, kind);
    EXPECT_EQ(classifyRows(model, samples.x, noOffset(), true).size(), 6u);
    EXPECT_GT(model.minSureConfidence, 1.0) << classifierName(kind);
  }
}

TEST(TrainedModel, ComesBackFromItsFile) {
  const TemporaryFolder folder;
  const SampleSet train = things(4, 12, 0.0, 1), test = things(4, 4, 2.0, 2);
  for (const ClassifierKind kind :
       {ClassifierKind::kGauss, ClassifierKind::kSvm, ClassifierKind::kQda}) {
    TrainedModel model = modelOf(train, kind);
    model.programVersion = "1.2.3";
    if (model.adaptsToSession()) adaptModel(model, things(4, 2, 2.0, 5));
    model.adaptedFrom = model.inputs;
    const auto path = folder / (std::string(classifierName(kind)) + ".json");
    saveModel(model, path);
    const TrainedModel back = loadModel(path);
    EXPECT_EQ(back.classes, model.classes);
    EXPECT_EQ(back.sensor, "a sensor");
    EXPECT_EQ(back.programVersion, "1.2.3");
    EXPECT_EQ(back.offset.mm, model.offset.mm);
    EXPECT_EQ(back.inputs.front().lastUs, model.inputs.front().lastUs);
    const auto a = classifyRows(model, test.x, model.offset, true);
    const auto b = classifyRows(back, test.x, back.offset, true);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].label, b[i].label);
      EXPECT_EQ(a[i].p, b[i].p);
      EXPECT_EQ(a[i].sure, b[i].sure);
    }
    EXPECT_THROW(saveModel(model, path), FileError) << "never overwrites unasked";
  }
}

EmptyHandZero zeroOf(double mm, std::int64_t timeUs) {
  EmptyHandZero zero;
  zero.mm = mm;
  zero.sdMm = 0.2;
  zero.touches = 2;
  zero.timeUs = timeUs;
  zero.origin = "touch.dsa";
  return zero;
}

// The hand measures 5 mm too much in this session, half the distance to the next object; no
// labelled grasp is needed.
TEST(TrainedModel, AdaptsByTheTouchOfTheEmptyHand) {
  TrainedModel model = modelOf(things(6, 20, 0.0, 1), ClassifierKind::kGauss);
  const SampleSet today = things(6, 10, 5.0, 3);
  EXPECT_THROW(adaptToEmptyHand(model, zeroOf(4.0, 900 * kHourUs)), Error) << "none of training";
  model.trainingZero = zeroOf(-1.0, 100 * kHourUs);
  EmptyHandZero bad = zeroOf(4.0, 900 * kHourUs);
  bad.problem = "no touch";
  EXPECT_THROW(adaptToEmptyHand(model, bad), Error);
  adaptToEmptyHand(model, zeroOf(4.0, 900 * kHourUs));
  EXPECT_NEAR(model.offset.mm, 5.0, 1e-9);
  EXPECT_EQ(model.offset.origin, OffsetSource::kEmptyHand);
  EXPECT_TRUE(model.offset.trusted);
  EXPECT_GT(shareRight(classifyRows(model, today.x, model.offset, true), today.y), 0.95);
  // The offset is valid in that session and in no other, not even in that of training.
  EXPECT_TRUE(model.sameSession(905 * kHourUs));
  EXPECT_FALSE(model.sameSession(100 * kHourUs));
  // Labelled grasps reduce the remaining uncertainty.
  TrainedModel both = model;
  adaptModel(both, today.rows(std::vector<std::size_t>{0}), both.offset);
  EXPECT_LT(both.offset.sdMm, model.offset.sdMm);
  EXPECT_NEAR(both.offset.mm, 5.0, 0.8);
  resetSession(both);
  EXPECT_EQ(both.offset.origin, OffsetSource::kNone);
  EXPECT_FALSE(both.sessionZero);
  EXPECT_TRUE(both.trainingZero) << "its own it keeps";
  EXPECT_TRUE(both.pipeline.sessionAdaptive->data().today.empty());
  EXPECT_TRUE(both.sameSession(100 * kHourUs));
  TrainedModel svm = modelOf(things(4, 8, 0.0, 1), ClassifierKind::kSvm);
  svm.trainingZero = zeroOf(-1.0, 100 * kHourUs);
  EXPECT_THROW(adaptToEmptyHand(svm, zeroOf(4.0, 900 * kHourUs)), Error);
}

TEST(TrainedModel, ZerosTravelWithItAndModelsOfFormat1AreRead) {
  TrainedModel model = modelOf(things(4, 12, 0.0, 1), ClassifierKind::kGauss);
  model.trainingZero = zeroOf(-1.0, 100 * kHourUs);
  adaptToEmptyHand(model, zeroOf(2.0, 900 * kHourUs));
  const TrainedModel back = trainedModelFrom(Json::parse(jsonOf(model).text()));
  ASSERT_TRUE(back.trainingZero && back.sessionZero);
  EXPECT_EQ(back.trainingZero->mm, -1.0);
  EXPECT_EQ(back.sessionZero->mm, 2.0);
  EXPECT_EQ(back.sessionZero->origin, "touch.dsa");
  EXPECT_EQ(back.offset.mm, model.offset.mm);
  EXPECT_EQ(back.offset.gridMm, model.offset.gridMm);
  // Format 1 stored the zero of training among the options, if at all.
  const Json now = jsonOf(model);
  Json old = Json::object();
  for (const std::string& key : now.keys())
    if (key != "training_zero" && key != "today_zero") old.set(key, now.at(key));
  old.set("format_version", 1);
  EXPECT_FALSE(trainedModelFrom(old).trainingZero);
  old.set(
      "options",
      Json::object().set(
          "empty_hand_zero",
          Json::object().set("mm", -2.0).set("sd_mm", 0.3).set("foam_mm", 1.5).set("touches", 1)));
  const TrainedModel read = trainedModelFrom(old);
  ASSERT_TRUE(read.trainingZero);
  EXPECT_EQ(read.trainingZero->mm, -2.0);
  EXPECT_FALSE(read.sessionZero);
  Json damaged = now;
  damaged.set("training_zero", Json::object().set("mm", -2.0));
  EXPECT_THROW(trainedModelFrom(damaged), Error);
}

std::string refusalOf(const Json& json) {
  try {
    trainedModelFrom(json);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(TrainedModel, RefusesDamagedFilesAndOtherVersions) {
  const Json whole = jsonOf(modelOf(things(3, 6, 0.0, 1), ClassifierKind::kGauss));
  ASSERT_EQ(refusalOf(whole), "");
  for (const std::string& key : whole.keys()) {
    Json damaged = Json::object();
    for (const std::string& other : whole.keys())
      if (other != key) damaged.set(other, whole.at(other));
    EXPECT_NE(refusalOf(damaged), "") << key;
  }
  Json later = whole;
  later.set("format_version", 3);
  EXPECT_NE(refusalOf(later).find("version is 3"), std::string::npos) << refusalOf(later);
  Json renamed = whole;
  renamed.set("classes", Json::array().push("a").push("b").push("c"));
  EXPECT_NE(refusalOf(renamed), "");
  Json bare = whole;
  bare.set("options", Json());
  EXPECT_NE(refusalOf(bare), "");
  Json fewer = whole;
  fewer.set("features", Json::array().push("size_z"));
  EXPECT_NE(refusalOf(fewer), "");

  const TemporaryFolder folder;
  testing::writeFile(folder / "cut.json", whole.text().substr(0, 500));
  EXPECT_THROW(loadModel(folder / "cut.json"), FormatError);
  testing::writeFile(folder / "other.json", "{\"kind\":\"calibration\"}");
  EXPECT_THROW(loadModel(folder / "other.json"), FormatError);
  EXPECT_THROW(loadModel(folder / "missing.json"), FileError);
  EXPECT_THROW(loadModel(folder.path()), FileError);
}

TEST(TrainedModel, RefusesAnotherSensorAndOtherFeatures) {
  const TrainedModel model = modelOf(things(3, 6, 0.0, 1), ClassifierKind::kGauss);
  FeatureTable table;
  table.names = model.features;
  table.sensor = "a sensor";
  EXPECT_NO_THROW(requireFits(model, table));
  table.sensor = "another";
  EXPECT_THROW(requireFits(model, table), Error);
  table.sensor = "a sensor";
  table.names = {"size_z"};
  EXPECT_THROW(requireFits(model, table), Error);
}

// analyst M9: the feature has another name than the quantity of `contact --size` now.
TEST(TrainedModel, ModelsOfEarlierReleasesAreRead) {
  SampleSet samples = things(3, 6, 0.0, 1);
  samples.features = {"size_z", "closing_mm"};
  std::string text = jsonOf(modelOf(samples, ClassifierKind::kGauss)).text();
  std::size_t renamed = 0;
  const std::string now = "closing_mm";
  for (std::size_t at = text.find(now); at != std::string::npos; at = text.find(now, at)) {
    text.replace(at, now.size(), "compression_mm");
    ++renamed;
  }
  ASSERT_GE(renamed, 2u) << "of the model and of its classifier";
  EXPECT_EQ(trainedModelFrom(Json::parse(text)).features, samples.features);
}

TEST(TrainedModel, HashesEveryInputOnce) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "x.dsa", "abc");
  FeatureTable table;
  table.rows.resize(2);
  table.rows[0] = {"pen", folder / "x.dsa", 5, 9, 5, 9, 7, {1.0}};
  table.rows[1] = {"pen", folder / "x.dsa", 1, 3, 1, 3, 4, {1.0}};
  const auto inputs = inputsOf(table);
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].grasps, 2u);
  EXPECT_EQ(inputs[0].firstUs, 4);
  EXPECT_EQ(inputs[0].lastUs, 7);
  // FIPS 180-2, appendix B.1
  EXPECT_EQ(inputs[0].sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_THROW(inputsOf(table, [](double) { return false; }), Cancelled);
}

// The declared sizes in a file are checked before memory is allocated for them.
TEST(TrainedModel, ASmallFileThatClaimsALargeMatrixIsRefused) {
  const TemporaryFolder folder;
  std::string rows = "[";
  std::string ones = "[";
  constexpr int kClaimed = 60'000;  // its square in doubles: 29 GB
  for (int i = 0; i < kClaimed; ++i) {
    rows += i == 0 ? "[]" : ",[]";
    ones += i == 0 ? "1" : ",1";
  }
  rows += "]";
  ones += "]";
  const std::string claimed = std::to_string(kClaimed);
  const std::string text =
      R"({"kind":"palpate recognition model","format_version":2,"program_version":"","made_at":"",)"
      R"("sensor":"","feature_set":"best","features":[],"classes":[],"options":{},"validation":{},)"
      R"("sure_confidence":2,"most_novelty":0,"session_offset":)" +
      sessionOffsetJson(noOffset()).text(-1) +
      R"(,"training_zero":null,"today_zero":null,"inputs":[],"adapted_from":[],"pipeline":)"
      R"({"classifier":"svm","classes":2,"features":)" +
      claimed + R"(,"mean":)" + ones + R"(,"scale":)" + ones + R"(,"discriminant":{"components":)" +
      claimed + R"(,"mean":)" + ones + R"(,"directions":)" + rows + R"(,"separation":)" + ones +
      R"(,"shrinkage":0}}})";
  testing::writeFile(folder / "claims.json", text);
  try {
    loadModel(folder / "claims.json");
    FAIL();
  } catch (const FormatError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind((folder / "claims.json").string(), 0), 0u) << what;
    EXPECT_NE(what.find("'directions' has 0 entries instead of 60000"), std::string::npos) << what;
  }
  // A file without end is not read either.
  EXPECT_THROW(loadModel("/dev/zero"), FileError);
}

}  // namespace
}  // namespace palpate::trained_model_test
