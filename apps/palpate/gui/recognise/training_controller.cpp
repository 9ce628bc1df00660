#include "gui/recognise/training_controller.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <algorithm>
#include <system_error>
#include <utility>

#include <palpate/capture/recording_name.h>
#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/recognition/grasp_collector.h>
#include <palpate/recognition/model_search.h>
#include <palpate/recognition/recognition_session.h>
#include <palpate/recognition/take_quality.h>
#include <palpate/recording/recording.h>

#include "gui/appearance/settings_file.h"

namespace palpate::gui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrainingControllerFolderKey = "recognise/folder";
constexpr std::size_t kBlocks = 5, kSplits = 10;

constexpr const char* kTrainingSetKey = "recognise/featureSet";
constexpr const char* kTrainingClassifierKey = "recognise/classifier";

std::shared_ptr<const FeatureTable> gatherTraining(const fs::path& folder,
                                                   const TrainingChoice& choice,
                                                   const Progress& progress) {
  return std::make_shared<const FeatureTable>(
      extractFeatures({folder}, {.set = choice.set}, progress));
}

Progress trainingPart(const Progress& progress, double from, double to) {
  return [&progress, from, to](double fraction) {
    return !progress || progress(from + (to - from) * fraction);
  };
}

// Chooses what is left open by cross-validation.
ChosenPipeline chosenFor(const SampleSet& samples,
                         FeatureSet set,
                         const TrainingChoice& choice,
                         const Progress& progress) {
  ChosenPipeline chosen = choosePipeline(samples, searchOptions(set, choice.classifier), progress);
  chosen.options.calibrationBlocks = kBlocks;
  return chosen;
}

Json leftOutJson(const std::set<LeftOutGrasp>& grasps) {
  return jsonList(grasps, [](const LeftOutGrasp& grasp) {
    return Json::object().set("file", grasp.file.string()).set("begin", grasp.begin);
  });
}

fs::path objectFolder(const fs::path& folder, const QString& object) {
  return folder / fileNamePart(object.toStdString());
}

// The folder for clips that were taken out: "objects_taken_out" next to "objects".
fs::path takenOutFolder(const fs::path& folder) {
  return folder.parent_path() / (folder.filename().string() + "_taken_out");
}

fs::path teachingDeskFreePlace(const fs::path& wanted) {
  fs::path place = wanted;
  for (int i = 2; fs::exists(place); ++i)
    place = wanted.parent_path() /
            (wanted.stem().string() + "-" + std::to_string(i) + wanted.extension().string());
  return place;
}

}  // namespace

TrainingController::TrainingController(QSettings& settings, QObject* parent)
    : QObject(parent), settings_(settings) {
  folder_ = settings.value(kTrainingControllerFolderKey).toString().toStdString();
  choice_.set = featureSetNamed(settings.value(kTrainingSetKey).toString().toStdString());
  choice_.classifier =
      classifierNamed(settings.value(kTrainingClassifierKey).toString().toStdString());
  readLeftOut();
  connect(&job_, &BackgroundJob::failed, this, &TrainingController::failed);
  connect(&saving_, &BackgroundJob::failed, this, &TrainingController::failed);
}

void TrainingController::setFolder(const fs::path& folder) {
  fs::path plain = folder.lexically_normal();
  if (!plain.has_filename()) plain = plain.parent_path();
  folder_ = plain;
  settings_.setValue(kTrainingControllerFolderKey, QString::fromStdString(plain.string()));
  table_.reset();
  clips_.clear();
  checked_.reset();
  readLeftOut();
  emit leftOutChanged();
  emit clipsChanged();
  emit checkedChanged();
  look();
}

void TrainingController::setChoice(const TrainingChoice& choice) {
  if (choice == choice_) return;
  const bool otherSet = choice.set != choice_.set;
  choice_ = choice;
  const auto text = [](std::string_view name) {
    return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
  };
  settings_.setValue(kTrainingSetKey, choice.set ? text(featureSetName(*choice.set)) : QString());
  settings_.setValue(kTrainingClassifierKey,
                     choice.classifier ? text(classifierName(*choice.classifier)) : QString());
  emit choiceChanged();
  if (otherSet) look();
}

FeatureSet TrainingController::set() const {
  return choice_.set ? *choice_.set : table_ ? table_->set : FeatureSet::kBest;
}

// The settings have a list of "FRAME RECORDING" for each folder; recordings are relative to it.
void TrainingController::readLeftOut() {
  leftOut_.clear();
  leavingOut_.clear();
  takenBack_.clear();
  for (const QString& text :
       settings_.value(leftOutKeyOf(QString::fromStdString(folder_.string()))).toStringList()) {
    bool isNumber = false;
    const auto begin = text.section(' ', 0, 0).toULongLong(&isNumber);
    const QString file = text.section(' ', 1);
    if (isNumber && !file.isEmpty()) leftOut_.insert({folder_ / file.toStdString(), begin});
  }
}

void TrainingController::changeLeftOut(const std::vector<LeftOutGrasp>& grasps, bool out) {
  for (const LeftOutGrasp& grasp : grasps) {
    if (out)
      leftOut_.insert(grasp);
    else
      leftOut_.erase(grasp);
  }
  QStringList texts;
  for (const LeftOutGrasp& each : leftOut_)
    texts << QString::number(each.begin) + ' ' +
                 QString::fromStdString(each.file.lexically_relative(folder_).string());
  const QString key = leftOutKeyOf(QString::fromStdString(folder_.string()));
  if (texts.isEmpty())
    settings_.remove(key);
  else
    settings_.setValue(key, texts);
  emit leftOutChanged();
  emit folderChanged();
}

void TrainingController::setLeftOut(const std::vector<std::size_t>& rows, bool out) {
  std::vector<LeftOutGrasp> changed;
  for (const std::size_t row : rows) {
    const FeatureRow& grasp = table_->rows.at(row);
    if (isLeftOut(grasp) != out) changed.push_back({grasp.file, grasp.begin});
  }
  if (changed.empty()) return;
  leavingOut_.emplace_back(changed, out);
  takenBack_.clear();
  changeLeftOut(changed, out);
}

void TrainingController::undoLeavingOut() {
  if (leavingOut_.empty()) return;
  const auto [grasps, out] = leavingOut_.back();
  leavingOut_.pop_back();
  takenBack_.emplace_back(grasps, out);
  changeLeftOut(grasps, !out);
}

void TrainingController::redoLeavingOut() {
  if (takenBack_.empty()) return;
  const auto [grasps, out] = takenBack_.back();
  takenBack_.pop_back();
  leavingOut_.emplace_back(grasps, out);
  changeLeftOut(grasps, out);
}

void TrainingController::look() {
  problem_.clear();
  std::error_code none;
  if (!folder_.empty() && !fs::is_directory(folder_, none))
    problem_ = "The folder doesn't exist: choose one with Folder.";
  if (folder_.empty() || !problem_.isEmpty()) {
    table_.reset();
    emit folderChanged();
    return;
  }
  auto found = std::make_shared<std::shared_ptr<const FeatureTable>>();
  job_.start(
      "the recordings of the folder",
      [found, folder = folder_, choice = choice_](const Progress& progress) {
        *found = gatherTraining(folder, choice, progress);
      },
      [this, found, folder = folder_, set = choice_.set] {
        if (folder == folder_ && set == choice_.set) take(*found);
      });
  emit folderChanged();
}

void TrainingController::take(const std::shared_ptr<const FeatureTable>& table) {
  table_ = table;
  const std::string noFeatures = whyNoFeatures(table->set, table->handPinches);
  problem_ = !noFeatures.empty() ? QString::fromStdString("No features: " + noFeatures + ".")
             : table->rows.empty()
                 ? table->numFiles == 0 ? QString("No recording has been read from the folder yet.")
                                        : QString("No grasp is found in its recordings.")
                 : QString();
  emit folderChanged();
}

std::map<QString, int> TrainingController::counts() const {
  std::map<QString, int> counts;
  std::map<fs::path, bool> known;
  if (table_)
    for (const FeatureRow& row : table_->rows) {
      counts[QString::fromStdString(row.className)] += isLeftOut(row) ? 0 : 1;
      known[row.file] = true;
    }
  for (const TrainingClip& clip : clips_) {
    const bool in = clip.state == TrainingClip::State::kAccepted;
    if (in && !known.contains(clip.path)) ++counts[clip.object];
    if (!in && known.contains(clip.path)) --counts[clip.object];
  }
  return counts;
}

void TrainingController::capture(const QString& object, const Profile& clip) {
  const ChosenGrasp grasp = graspOf(clip, defaultFeatureSet(clip.hand()));
  TrainingClip taught{
      .id = ++lastClipId_, .object = object, .path = {}, .profile = clip, .problem = {}};
  taught.quality = grasp.quality;
  taught.seconds = static_cast<double>(clip.durationUs()) / kUsPerS;
  if (!grasp.features.problem.empty())
    taught.problem = QString::fromStdString(grasp.features.problem);
  else if (grasp.quality < kGoodGraspQuality)
    taught.problem = "low quality";
  clips_.push_back(std::move(taught));
  if (clips_.back().problem.isEmpty()) save(clips_.size() - 1);
  emit clipsChanged();
}

void TrainingController::save(std::size_t index) {
  TrainingClip& clip = clips_[index];
  clip.state = TrainingClip::State::kSaving;
  struct Written {
    fs::path path;
    QString problem;
  };
  auto written = std::make_shared<Written>();
  saving_.start(
      "a grasp",
      [written, profile = clip.profile, object = clip.object, from = clip.path, folder = folder_](
          const Progress& progress) {
        try {
          const fs::path place = objectFolder(folder, object);
          fs::create_directories(place);
          // The clip was taken out before.
          if (!from.empty()) {
            written->path = teachingDeskFreePlace(place / from.filename());
            fs::rename(from, written->path);
            return;
          }
          const std::int64_t timeUs = profile.frameTimeUs(0);
          written->path = nextRecordingPath(
              place, "{date}_{object}_{run}", {timeUs, std::string(), object.toStdString()});
          Event label;
          label.tUs = label.t1Us = timeUs;
          label.kind = "label";
          label.text = object.toStdString();
          saveRecording(profile, std::vector{label}, written->path, Overwrite::kRefuse, progress);
        } catch (const Cancelled&) {
          throw;
        } catch (const std::exception& error) {
          written->problem = QString::fromUtf8(error.what());
        }
      },
      [this, written, id = clip.id, object = clip.object] {
        const auto saved = std::find_if(
            clips_.begin(), clips_.end(), [id](const auto& each) { return each.id == id; });
        if (saved == clips_.end()) {
          // Another folder was chosen meanwhile.
          if (!written->problem.isEmpty())
            emit failed("a grasp of " + object + " was not stored: " + written->problem);
          return;
        }
        saved->problem = written->problem;
        saved->state = written->problem.isEmpty() ? TrainingClip::State::kAccepted
                                                  : TrainingClip::State::kFailed;
        if (written->problem.isEmpty()) saved->path = written->path;
        emit clipsChanged();
        emit folderChanged();
      });
}

void TrainingController::accept(std::size_t index) {
  const auto state = clips_.at(index).state;
  if (state == TrainingClip::State::kAccepted || state == TrainingClip::State::kSaving) return;
  save(index);
  emit clipsChanged();
}

void TrainingController::takeOut(std::size_t index) {
  TrainingClip& clip = clips_.at(index);
  if (clip.state != TrainingClip::State::kAccepted) return;
  try {
    const fs::path place = takenOutFolder(folder_) / objectFolder(folder_, clip.object).filename();
    fs::create_directories(place);
    const fs::path to = teachingDeskFreePlace(place / clip.path.filename());
    fs::rename(clip.path, to);
    clip.path = to;
    clip.state = TrainingClip::State::kTakenOut;
    emit said("moved to " + QString::fromStdString(to.string()));
  } catch (const fs::filesystem_error& error) {
    emit failed("could not be moved: " + QString::fromStdString(error.code().message()));
  }
  emit clipsChanged();
  emit folderChanged();
}

void TrainingController::train(const fs::path& out, const std::optional<EmptyHandZero>& zero) {
  struct Made {
    std::shared_ptr<const FeatureTable> table;
    TrainedModel model;
  };
  auto made = std::make_shared<Made>();
  job_.start(
      "the model",
      [made, out, zero, folder = folder_, choice = choice_, leftOut = leftOut_](
          const Progress& progress) {
        made->table = gatherTraining(folder, choice, trainingPart(progress, 0.0, 0.5));
        const FeatureTable kept = without(*made->table, leftOut);
        const SampleSet samples = samplesOf(kept);
        requireLearnable(samples);
        const ChosenPipeline chosen =
            chosenFor(samples, kept.set, choice, trainingPart(progress, 0.5, 0.7));
        made->model = trainModel(
            samples, kept.set, kept.sensor, chosen.options, trainingPart(progress, 0.7, 0.9));
        made->model.inputs = inputsOf(kept, trainingPart(progress, 0.9, 1.0));
        made->model.programVersion = PALPATE_VERSION;
        made->model.madeAt = utcText(systemClock().wallUs());
        made->model.options = jsonOf(chosen.options).set("path", folder.string());
        if (!chosen.report.candidates.empty())
          made->model.options.set("chosen_from", jsonOf(chosen.report));
        if (!leftOut.empty()) made->model.options.set("left_out", leftOutJson(leftOut));
        made->model.trainingZero = zero;
        saveModel(made->model, out, Overwrite::kReplace);
      },
      [this, made, out, set = choice_.set] {
        if (set == choice_.set) take(made->table);
        emit trained(made->model, QString::fromStdString(out.string()));
      });
}

void TrainingController::check(bool blocks) {
  struct Made {
    std::shared_ptr<const FeatureTable> whole;
    std::shared_ptr<TrainingValidation> validation = std::make_shared<TrainingValidation>();
  };
  auto made = std::make_shared<Made>();
  made->validation->blocks = blocks;
  job_.start(
      "cross-validation",
      [made, folder = folder_, choice = choice_, leftOut = leftOut_](const Progress& progress) {
        made->whole = gatherTraining(folder, choice, trainingPart(progress, 0.0, 0.5));
        TrainingValidation& check = *made->validation;
        check.table = std::make_shared<const FeatureTable>(without(*made->whole, leftOut));
        check.samples = samplesOf(*check.table);
        requireLearnable(check.samples);
        check.options =
            chosenFor(check.samples, check.table->set, choice, trainingPart(progress, 0.5, 0.7))
                .options;
        const auto splits = check.blocks ? blockSplits(check.samples.y, kBlocks)
                                         : stratifiedSplits(check.samples.y, kSplits, 0);
        check.report = crossValidate(
            check.samples, check.options, splits, 0, trainingPart(progress, 0.7, 1.0));
      },
      [this, made, set = choice_.set] {
        if (set == choice_.set) take(made->whole);
        checked_ = made->validation;
        emit checkedChanged();
      });
}

bool TrainingController::cancel() {
  if (!job_.busy()) return false;
  job_.cancel();
  emit said("cancelled");
  return true;
}

void TrainingController::settle() {
  while (job_.busy() || saving_.busy())
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

}  // namespace palpate::gui
