#include "commands/demo_recognition.h"

#include <algorithm>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/recognition/model_evaluation.h"

#include "commands/recognition_work.h"

namespace palpate::commands {
namespace {

constexpr int kProbabilityDecimals = 2;

std::size_t lengthInFrames(const FeatureRow& row) { return row.end - row.begin; }

void compareWithObject(const TrainedModel& model, AskedGrasp& asked) {
  const Prediction& prediction = *asked.prediction;
  asked.called = labelOf(model, prediction.label);
  for (std::size_t k = 0; k < prediction.ranking.size(); ++k) {
    if (labelOf(model, prediction.ranking[k]) != asked.known.object) continue;
    asked.rank = k + 1;
    asked.probability = prediction.p[k];
  }
}

// Describes a wrong answer: "the ball is called pen (0.93); at rank 2, 0.05".
std::string wrongText(const AskedGrasp& asked) {
  std::string text = "the " + asked.known.object;
  if (!asked.prediction) return text + " could not be asked about: " + asked.problem;
  text += " is called " + asked.called;
  if (!asked.rank)
    return text + " (" + fixedText(asked.prediction->confidence, kProbabilityDecimals) + ")";
  return text + "; its own name is at rank " + std::to_string(*asked.rank) + " with probability " +
         fixedText(asked.probability, kProbabilityDecimals);
}

}  // namespace

bool AskedGrasp::right() const {
  return prediction &&
         (inTraining ? called == known.object : prediction->label == Prediction::kUnknown);
}

std::size_t DemoRecognition::numInTraining() const {
  return static_cast<std::size_t>(std::count_if(
      grasps.begin(), grasps.end(), [](const AskedGrasp& asked) { return asked.inTraining; }));
}

std::size_t DemoRecognition::numRight(bool inTraining) const {
  return static_cast<std::size_t>(
      std::count_if(grasps.begin(), grasps.end(), [&](const AskedGrasp& asked) {
        return asked.inTraining == inTraining && asked.right();
      }));
}

DemoRecognition askModel(const TrainedModel& model,
                         const std::vector<KnownGrasp>& grasps,
                         const Progress& progress) {
  std::vector<std::filesystem::path> files;
  for (const KnownGrasp& known : grasps) files.push_back(known.file);
  FeatureExtractionOptions gathering;
  gathering.set = model.set;
  FeatureTable table = extractFeatures(files, gathering, progress);

  DemoRecognition result;
  std::vector<FeatureRow> longest;
  for (const KnownGrasp& known : grasps) {
    AskedGrasp& asked = result.grasps.emplace_back();
    asked.known = known;
    asked.inTraining =
        std::find(model.classes.begin(), model.classes.end(), known.object) != model.classes.end();
    const FeatureRow* row = nullptr;
    for (const FeatureRow& each : table.rows)
      if (each.file == known.file && (!row || lengthInFrames(each) > lengthInFrames(*row)))
        row = &each;
    if (row) {
      asked.row = *row;
      longest.push_back(*row);
      continue;
    }
    asked.problem = "no grasp was found in its recording";
    const std::string prefix = known.file.string() + ": ";
    for (const std::string& problem : table.problems)
      if (problem.starts_with(prefix)) asked.problem = problem.substr(prefix.size());
  }
  table.rows = std::move(longest);
  if (table.rows.empty()) return result;
  auto [use, predictions] = classifyTable(model, table, {OffsetChoice::Kind::kGiven, 0.0});
  result.warnings = std::move(use.warnings);
  result.sessionOffset = offsetJson(use.offset);
  auto next = predictions.begin();
  for (AskedGrasp& asked : result.grasps) {
    if (!asked.problem.empty()) continue;
    asked.prediction = std::move(*next++);
    compareWithObject(model, asked);
  }
  return result;
}

std::string demoRecognitionText(const DemoRecognition& recognition) {
  const std::size_t inTraining = recognition.numInTraining();
  std::string named, other;
  bool allSure = true;
  for (const AskedGrasp& asked : recognition.grasps) {
    if (!asked.right()) {
      other += "; wrong: " + wrongText(asked);
    } else if (asked.inTraining) {
      named += (named.empty() ? " (" : ", ") + asked.known.object + " " +
               fixedText(asked.probability, kProbabilityDecimals);
      allSure = allSure && asked.prediction->sure;
    } else {
      other += "; the " + asked.known.object + ", which was not trained, is called unknown";
    }
  }
  std::string text = std::to_string(recognition.numRight(true)) + " of " +
                     std::to_string(inTraining) + " objects named rightly";
  if (!named.empty()) text += named + ")";
  if (recognition.numRight(true) > 0) text += allSure ? ", all surely" : ", not all surely";
  return text + other;
}

Json demoRecognitionJson(const DemoRecognition& recognition,
                         const TrainedModel& model,
                         const std::string& modelName) {
  Json grasps = Json::array();
  for (const AskedGrasp& asked : recognition.grasps) {
    FeatureRow row = asked.row;
    row.file = asked.known.file.filename();
    Json json = asked.prediction ? predictionJson(model, row, *asked.prediction)
                                 : Json::object()
                                       .set("file", row.file.string())
                                       .set("label", Json())
                                       .set("trouble", asked.problem);
    grasps.push(json.set("object", asked.known.object)
                    .set("taught", asked.inTraining)
                    .set("rank", asked.rank ? Json(*asked.rank) : Json())
                    .set("probability", asked.rank ? Json(asked.probability) : Json())
                    .set("right", asked.right()));
  }
  return Json::object()
      .set("model", modelName)
      .set("classes", jsonList(model.classes))
      .set("taught", recognition.numInTraining())
      .set("right", recognition.numRight(true))
      .set("right_of_untaught", recognition.numRight(false))
      .set("grasps", grasps)
      .set("session_offset", recognition.sessionOffset)
      .set("warnings", jsonList(recognition.warnings));
}

}  // namespace palpate::commands
