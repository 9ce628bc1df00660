// The command `palpate classify MODEL.json FILE...` names the grasped objects.
#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recognition/answer_rows.h"
#include "palpate/recognition/model_evaluation.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_work.h"

namespace palpate::commands {
namespace {

// While it isn't known whether the object is a trained one, probabilities among those say nothing.
std::string classifiedText(const TrainedModel& model, const Prediction& prediction) {
  if (prediction.membership == Membership::kNotKnownYet)
    return "not known yet; most similar: " + labelOf(model, prediction.label);
  std::string text = labelOf(model, prediction.label) + (prediction.sure ? " (sure)" : "") + ";";
  for (std::size_t k = 0; k < std::min<std::size_t>(3, prediction.ranking.size()); ++k)
    text += (k == 0 ? " " : ", ") + labelOf(model, prediction.ranking[k]) + " " +
            fixedText(prediction.p[k], 2);
  return text;
}

void printTable(const TrainedModel& model,
                const FeatureTable& table,
                const std::vector<Prediction>& predictions,
                const SessionContext& use) {
  StandardOutput out;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const FeatureRow& row = table.rows[i];
    out.write(row.file.string() + " " + std::to_string(row.begin) + "-" + std::to_string(row.end) +
              ": " + classifiedText(model, predictions[i]) + "\n");
  }
  if (model.adaptsToSession()) {
    const bool byZero = use.offset.origin == OffsetSource::kEmptyHand && model.sessionZero;
    out.write(use.offset.text() +
              (byZero ? "; zero of the empty hand: " + model.sessionZero->text() : std::string()) +
              "\n");
  }
  out.finish();
}

}  // namespace

int classifyCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate classify MODEL.json FILE... [--json] [--session-offset model|none|batch|MM]",
       .purpose =
           "Names the grasped objects: prints a line per grasp, or with --json one object; with -o "
           "OUT.csv it writes a table. All "
           "FILEs of a call (recordings, or folders of them) must be of one session. An answer is "
           "called sure when it is right in 95 of 100 cases. That holds in the session of the "
           "training, or with a reliable session offset. The values of --session-offset:\n\n  "
           "model  what `adapt` stored (default); of a model that was not adapted: 0 in the "
           "session of the training, else as none\n  none   no assumption: the answer is averaged "
           "over all possible offsets\n  batch  estimated from all grasps of this call, without "
           "labels; of fewer than two different objects it warns, and no answer is sure\n  MM     "
           "the hand reads sizes larger by this many mm",
       .options =
           withOneTableOptions({{"session-offset", "WHICH", "model (default), none, batch, or mm"}},
                               "one JSON object instead of lines"),
       .example = "palpate classify objects.json grasp.dsa --json --session-offset batch",
       .minArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("units-row") && !given.has("output"))
    throw UsageError("--units-row needs -o OUT.csv");
  OffsetChoice choice;
  try {
    if (const auto text = given.text("session-offset")) choice = OffsetChoice::from(*text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--session-offset: ") + error.what());
  }
  const TrainedModel model = loadModel(given.words().front());
  const FeatureTable table =
      extractFeatureTable(given, {given.words().begin() + 1, given.words().end()}, model.set);
  const auto [use, predictions] = classifyTable(model, table, choice);
  for (const std::string& warning : use.warnings) sayLine(warning);
  if (!given.has("json") && !given.has("output")) {
    printTable(model, table, predictions, use);
    return codeFor(table);
  }
  if (formOf(given) == TableForm::kCsv)
    return std::max(writeTable(given, *answerTable(model, table, predictions)), codeFor(table));
  Json grasps = Json::array();
  for (std::size_t i = 0; i < predictions.size(); ++i)
    grasps.push(predictionJson(model, table.rows[i], predictions[i]));
  printJson(given,
            Json::object()
                .set("grasps", std::move(grasps))
                .set("session_offset",
                     offsetJson(use.offset,
                                choice.kind == OffsetChoice::Kind::kModel
                                    ? model.sessionZero
                                    : std::optional<EmptyHandZero>()))
                .set("warnings", jsonList(use.warnings)));
  return codeFor(table);
}

}  // namespace palpate::commands
