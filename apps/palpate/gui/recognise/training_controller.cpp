#include "gui/recognise/training_controller.h"

#include <QCoreApplication>
#include <QEventLoop>
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

namespace palpate::gui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrainingControllerFolderKey = "recognise/folder";
constexpr std::size_t kBlocks = 5, kSplits = 10;

// Options with the classifier that also works on recordings of another session, where the features
// do.
PipelineOptions trainingOptions(FeatureSet set) {
  PipelineOptions options;
  options.classifier = set == FeatureSet::kBest ? ClassifierKind::kGauss : ClassifierKind::kSvm;
  options.calibrationBlocks = kBlocks;
  return options;
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
  emit clipsChanged();
  emit checkedChanged();
  look();
}

std::shared_ptr<const FeatureTable> TrainingController::gather(const fs::path& folder,
                                                               const Progress& progress) const {
  return std::make_shared<const FeatureTable>(extractFeatures({folder}, {}, progress));
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
      [this, found, folder = folder_](const Progress& progress) {
        *found = gather(folder, progress);
      },
      [this, found, folder = folder_] {
        if (folder == folder_) take(*found);
      });
  emit folderChanged();
}

void TrainingController::take(const std::shared_ptr<const FeatureTable>& table) {
  table_ = table;
  problem_ = table->rows.empty() ? table->numFiles == 0
                                       ? QString("No recording has been read from the folder yet.")
                                       : QString("No grasp is found in its recordings.")
                                 : QString();
  emit folderChanged();
}

std::map<QString, int> TrainingController::counts() const {
  std::map<QString, int> counts;
  std::map<fs::path, bool> known;
  if (table_)
    for (const FeatureRow& row : table_->rows) {
      ++counts[QString::fromStdString(row.className)];
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
  TrainingClip taught{.object = object, .path = {}, .profile = clip, .problem = {}};
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
          RecordingEvent label;
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
      [this, written, index] {
        if (index >= clips_.size()) return;
        TrainingClip& saved = clips_[index];
        saved.problem = written->problem;
        saved.state = written->problem.isEmpty() ? TrainingClip::State::kAccepted
                                                 : TrainingClip::State::kFailed;
        if (written->problem.isEmpty()) saved.path = written->path;
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

std::optional<std::size_t> TrainingController::newestAccepted() const {
  for (std::size_t i = clips_.size(); i-- > 0;)
    if (clips_[i].state == TrainingClip::State::kAccepted) return i;
  return std::nullopt;
}

void TrainingController::train(const fs::path& out, const std::optional<EmptyHandZero>& zero) {
  struct Made {
    std::shared_ptr<const FeatureTable> table;
    TrainedModel model;
  };
  auto made = std::make_shared<Made>();
  job_.start(
      "the model",
      [this, made, out, zero, folder = folder_](const Progress& progress) {
        const auto part = [&](double from, double to) -> Progress {
          return [&progress, from, to](double fraction) {
            return !progress || progress(from + (to - from) * fraction);
          };
        };
        made->table = gather(folder, part(0.0, 0.5));
        const SampleSet samples = samplesOf(*made->table);
        requireLearnable(samples);
        const PipelineOptions options = trainingOptions(made->table->set);
        made->model =
            trainModel(samples, made->table->set, made->table->sensor, options, part(0.5, 0.9));
        made->model.inputs = inputsOf(*made->table, part(0.9, 1.0));
        made->model.programVersion = PALPATE_VERSION;
        made->model.madeAt = utcText(systemClock().wallUs());
        made->model.options = jsonOf(options).set("path", folder.string());
        made->model.trainingZero = zero;
        saveModel(made->model, out, Overwrite::kReplace);
      },
      [this, made, out] {
        take(made->table);
        emit trained(made->model, QString::fromStdString(out.string()));
      });
}

void TrainingController::check(bool blocks) {
  auto made = std::make_shared<TrainingValidation>();
  made->blocks = blocks;
  job_.start(
      "cross-validation",
      [this, made, folder = folder_](const Progress& progress) {
        made->table =
            gather(folder, [&](double fraction) { return !progress || progress(0.6 * fraction); });
        made->samples = samplesOf(*made->table);
        requireLearnable(made->samples);
        const auto splits = made->blocks ? blockSplits(made->samples.y, kBlocks)
                                         : stratifiedSplits(made->samples.y, kSplits, 0);
        made->report = crossValidate(
            made->samples, trainingOptions(made->table->set), splits, 0, [&](double fraction) {
              return !progress || progress(0.6 + 0.4 * fraction);
            });
      },
      [this, made] {
        take(made->table);
        checked_ = made;
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
