#include "commands/recognition_work.h"

#include <algorithm>
#include <cstdlib>

#include "palpate/core/error.h"
#include "palpate/core/hash.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/recording.h"

#include "commands/recording_list.h"

namespace palpate::commands {

void runInterruptibly(const CommandLine& given,
                      const std::string& label,
                      const std::function<void(const Progress&)>& work) {
  Interruption interruption;
  ProgressLine line(label, given.quiet());
  const Progress show = line.callback();
  work([&](double fraction) {
    if (interruption.waitForSignal(0)) return false;
    return !show || show(fraction);
  });
}

FeatureTable extractFeatureTable(const CommandLine& given,
                                 const std::vector<std::filesystem::path>& paths,
                                 std::optional<FeatureSet> set) {
  FeatureTable table;
  FeatureExtractionOptions options;
  options.set = set;
  runInterruptibly(given, "features", [&](const Progress& progress) {
    table = extractFeatures(paths, options, progress);
  });
  for (const std::string& problem : table.problems) sayLine(problem);
  if (table.rows.empty())
    throw Error("no grasp with features in " + std::to_string(table.numFiles) +
                (table.numFiles == 1 ? " recording" : " recordings") +
                "; look at 'palpate grasps' for why");
  return table;
}

OptionSpec zeroOptionSpec() {
  return {"empty-hand-zero",
          "FILE",
          "recording of the same day in which the empty hand closes until its pads touch"};
}

std::optional<EmptyHandZero> zeroGiven(const CommandLine& given) {
  const auto path = given.text("empty-hand-zero");
  if (!path) return std::nullopt;
  EmptyHandZero zero;
  runInterruptibly(given, "empty hand", [&](const Progress& progress) {
    const Profile profile = openRecording(*path);
    reportOpened(*path, profile, given.quiet());
    zero = emptyHandZero(profile, {}, progress);
    zero.sha256 = sha256OfFile(*path);
  });
  if (!zero.problem.empty()) throw FileError(*path, "no zero of the empty hand: " + zero.problem);
  zero.origin = std::filesystem::path(*path).filename().string();
  if (!given.quiet()) sayLine("the empty hand's zero: " + zero.text());
  return zero;
}

void requireSameSession(const EmptyHandZero& zero, const FeatureTable& table) {
  constexpr std::int64_t kHalfDayUs = 12LL * 3600 * 1'000'000;
  if (std::none_of(table.rows.begin(), table.rows.end(), [&](const FeatureRow& row) {
        return std::abs(row.timeUs - zero.timeUs) <= kHalfDayUs;
      }))
    throw Error(zero.origin +
                ": the empty hand was closed in another session than the objects; give a recording "
                "within 12 h of theirs");
}

Json offsetJson(const SessionOffset& offset, const std::optional<EmptyHandZero>& today) {
  Json json = Json::object()
                  .set("mm", offset.mm)
                  .set("sd_mm", offset.sdMm)
                  .set("origin", offsetSourceName(offset.origin))
                  .set("grasps", offset.grasps)
                  .set("objects", offset.objects)
                  .set("trusted", offset.trusted);
  if (today) json.set("empty_hand", emptyHandZeroJson(*today));
  return json;
}

void sayNotes(const CommandLine& given, FeatureSet set, const SampleSet& samples) {
  if (given.quiet()) return;
  if (set == FeatureSet::kSession) sayLine(std::string(sessionSetWarning()));
  for (const std::string& note : learningNotes(samples)) sayLine(note);
}

std::vector<OptionSpec> pipelineOptionSpecs() {
  return {worded("classifier", "NAME", "", kClassifierWords),
          rangedWhole("lda",
                      "N",
                      "components of a discriminant analysis before the classifier (not for gauss)",
                      PipelineOptions::kComponents),
          ranged("c", "C", "cost of the svm", SvmOptions::kC, numberText(SvmOptions{}.c)),
          {"shrinkage",
           "S",
           "shrinkage of the discriminant analysis, or auto (Ledoit and Wolf)" +
               detail::rangeText(DiscriminantOptions::kShrinkage, "0", false)}};
}

void takePipelineOptions(const CommandLine& given, PipelineOptions& options) {
  options.classifier = given.chosen("classifier", kClassifierWords).value_or(options.classifier);
  if (const auto count = given.integer("lda", PipelineOptions::kComponents))
    options.components = static_cast<std::size_t>(*count);
  options.svm.c = given.number("c", SvmOptions::kC).value_or(options.svm.c);
  if (const auto text = given.text("shrinkage")) {
    const auto share = parseDouble(*text);
    if (*text == "auto")
      options.discriminant.shrinkage.reset();
    else if (share && DiscriminantOptions::kShrinkage.contains(*share))
      options.discriminant.shrinkage = *share;
    else
      throw UsageError("--shrinkage takes a number from 0 to 1, or auto");
  }
  if (options.components && options.classifier == ClassifierKind::kGauss)
    throw UsageError("gauss takes no --lda: choose --classifier svm, qda or lda");
}

int codeFor(const FeatureTable& table) { return table.problems.empty() ? kDone : kPartlyDone; }

}  // namespace palpate::commands
