#include "gui/recognise/recognition_controller.h"

#include <QCoreApplication>
#include <QEventLoop>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

constexpr const char* kModelKey = "recognise/model";
constexpr const char* kEmulatedModelKey = "recognise/emulated_model";
constexpr const char* kEmulatedModel = "emulated_objects.json";

constexpr const char* kHowToAsk =
    "Choose a grasp in the timeline, or let the hand hold an object; then press What is it? (Q).";
constexpr const char* kNoModel =
    "No model is chosen. Open one (Model), or train one on the page Teach.";

}  // namespace

RecognitionController::RecognitionController(QSettings& settings,
                                             std::filesystem::path dataFolder,
                                             QObject* parent)
    : QObject(parent), settings_(settings), emulatedModel_(dataFolder / kEmulatedModel) {
  answer_.text = hint();
}

const char* RecognitionController::settingsKey() const {
  return emulated_ ? kEmulatedModelKey : kModelKey;
}

bool RecognitionController::isEmulatedModel() const {
  std::error_code ignored;
  return std::filesystem::equivalent(path_, emulatedModel_, ignored);
}

void RecognitionController::setEmulated(bool emulated) {
  if (started_ && emulated == emulated_) return;
  emulated_ = emulated;
  started_ = true;
  takeDefault();
}

void RecognitionController::takeDefault() {
  std::error_code ignored;
  std::filesystem::path path = settings_.value(settingsKey()).toString().toStdString();
  QString gone;
  if (!path.empty() && !std::filesystem::exists(path, ignored))
    gone = "The model " + QString::fromStdString(path.string()) + " isn't there any more";
  const std::filesystem::path last = path;
  if (path.empty() || !gone.isEmpty())
    path = emulated_ && std::filesystem::exists(emulatedModel_, ignored) ? emulatedModel_
                                                                         : std::filesystem::path();
  if (gone.isEmpty() && path == path_ && (session_ || path.empty())) return;
  if (!path.empty()) return readModel(path, gone);
  path_.clear();
  setModel(std::nullopt, gone.isEmpty() ? std::filesystem::path() : last);
  if (gone.isEmpty()) return;
  modelProblem_ = gone + ". Open another one (Model), or train one on the page Teach.";
  emit modelChanged();
  showProblem(modelProblem_);
}

void RecognitionController::useEmulatedModel() { openModel(emulatedModel_); }

void RecognitionController::openModel(const std::filesystem::path& path) { readModel(path, {}); }

void RecognitionController::readModel(const std::filesystem::path& path, const QString& gone) {
  path_ = path;
  modelProblem_.clear();
  fallback_.clear();
  opening_.start(
      [this, path, gone](const Abandonable::Asker&) -> Abandonable::Take {
        return [this, path, gone, model = loadModel(path)] {
          if (path != path_) return;
          // A model that is gone stays the chosen one: its drive may be connected again.
          if (gone.isEmpty())
            settings_.setValue(settingsKey(), QString::fromStdString(path.string()));
          else
            fallback_ =
                gone + "; in use is " + QString::fromStdString(path.filename().string()) + ".";
          setModel(model, path);
          if (gone.isEmpty()) return;
          emit said(fallback_);
          sayHowToAsk();
        };
      },
      [this](const QString& message) {
        setModel(std::nullopt, path_);
        modelProblem_ = message;
        emit modelChanged();
        showProblem(message);
      });
}

void RecognitionController::takeModel(TrainedModel model, const std::filesystem::path& path) {
  opening_.abandon();
  fallback_.clear();
  settings_.setValue(settingsKey(), QString::fromStdString(path.string()));
  setModel(std::move(model), path);
}

void RecognitionController::setModel(std::optional<TrainedModel> model,
                                     const std::filesystem::path& path) {
  path_ = path;
  modelProblem_.clear();
  session_ = model ? std::make_unique<RecognitionSession>(std::move(*model)) : nullptr;
  // The joints of the emulated hand are never referenced again, so that its offset is 0.
  if (session_ && emulated_ && isEmulatedModel() && session_->model().adaptsToSession())
    session_->choose({OffsetChoice::Kind::kGiven, 0.0});
  setPhotoFolder(photoFolder_);
  last_.reset();
  asking_.abandon();
  // The answer of the previous model is removed.
  answer_ = {};
  answer_.text = hint();
  emit modelChanged();
  emit sessionChanged();
  emit answered(answer_);
  if (session_ && waiting_) ask(*std::exchange(waiting_, std::nullopt));
}

void RecognitionController::setPhotoFolder(const std::filesystem::path& folder) {
  photoFolder_ = folder;
  std::vector<std::filesystem::path> folders{path_.parent_path(), folder};
  if (session_ && session_->model().options.at("path").isString())
    folders.emplace_back(session_->model().options.at("path").asString());
  photos_.setFolders(std::move(folders));
}

void RecognitionController::changeSession(const std::function<void(RecognitionSession&)>& change) {
  if (!session_) return showProblem(kNoModel);
  try {
    change(*session_);
  } catch (const std::exception& error) {
    emit said(error.what());
    return;
  }
  emit sessionChanged();
  if (last_) classify(last_->first, last_->second);
}

QString RecognitionController::whyNoModel() const {
  if (session_ || opening_.busy()) return {};
  return modelProblem_.isEmpty() ? kNoModel : modelProblem_;
}

void RecognitionController::ask(const RecogniseQuestion& question) {
  if (!session_) {
    if (!opening_.busy()) return showProblem(whyNoModel());
    waiting_ = question;
    return;
  }
  const std::string sensor = sensorText(question.profile.layout());
  FeatureTable table;
  table.set = session_->model().set;
  table.sensor = sensor;
  try {
    if (table.set == FeatureSet::kStatistics || pinchHandOf(question.profile.hand()))
      table.names = featureNames(table.set, question.profile.hand());
    requireFits(session_->model(), table);
  } catch (const Error& error) {
    return showProblem(error.what());
  }
  asking_.start(
      [this, question, set = table.set, contact = contact_](
          const Abandonable::Asker& asker) -> Abandonable::Take {
        const ChosenGrasp chosen = question.frames && question.profile.numFrames() > 0
                                       ? graspWithin(question.profile,
                                                     question.frames->first,
                                                     question.frames->second,
                                                     set,
                                                     asker.progress)
                                       : graspOf(question.profile, set, asker.progress);
        return [this, chosen, of = question.of, contact] {
          take(chosen, of == kHeldNow && contact != contact_ ? QString(kLastGrasp) : of);
        };
      },
      [this](const QString& message) { showProblem(message); });
}

void RecognitionController::take(const ChosenGrasp& chosen, const QString& of) {
  if (chosen.features.problem.empty()) {
    try {
      session_->add(chosen.features.values, chosen.timeUs);
      emit sessionChanged();
    } catch (const std::invalid_argument&) {
      // The grasp has the features of the previous model.
      return;
    }
  }
  classify(chosen, of);
}

void RecognitionController::classify(const ChosenGrasp& chosen, const QString& of) {
  last_ = {chosen, of};
  if (!chosen.features.problem.empty()) {
    RecognitionAnswer answer;
    answer.kind = RecognitionAnswer::Kind::kProblem;
    answer.text = QString::fromStdString(chosen.features.problem);
    answer.text[0] = answer.text[0].toUpper();
    answer.of = of;
    return showAnswer(answer);
  }
  const Prediction prediction = session_->predict(chosen.features.values, chosen.timeUs);
  RecognitionAnswer answer = answerOf(session_->model(), prediction);
  answer.of = of;
  const bool none = emulated_ && isEmulatedModel() &&
                    session_->offset().origin == OffsetSource::kGiven &&
                    session_->offset().mm == 0.0;
  if (session_->model().adaptsToSession()) answer.offset = offsetText(session_->offset(), none);
  answer.unsure = QString::fromStdString(session_->unsure());
  if (prediction.membership == Membership::kNotKnownYet)
    answer.unsure += (answer.unsure.isEmpty() ? QString() : QString("; ")) +
                     QString::fromStdString(notKnownYetText(session_->model(), session_->offset()));
  const auto& grasps = session_->grasps();
  for (std::size_t i = 0; i < grasps.size(); ++i)
    if (grasps[i].timeUs == chosen.timeUs) answer.grasp = i;
  showAnswer(answer);
}

void RecognitionController::touchBegins() {
  if (answer_.kind == RecognitionAnswer::Kind::kProblem && answer_.of == kHeldNow && !last_)
    sayHowToAsk();
}

void RecognitionController::contactEnded() {
  ++contact_;
  if (answer_.of != kHeldNow) return;
  // The reason why there was no answer yet no longer applies.
  if (answer_.kind == RecognitionAnswer::Kind::kProblem && !last_) return sayHowToAsk();
  if (last_) last_->second = kLastGrasp;
  answer_.of = kLastGrasp;
  emit answered(answer_);
}

void RecognitionController::forgetAnswer() {
  asking_.abandon();
  waiting_.reset();
  last_.reset();
  if (answer_.kind != RecognitionAnswer::Kind::kNothing) sayHowToAsk();
}

QString RecognitionController::hint() const {
  const QString why = whyNoModel();
  if (!why.isEmpty()) return why;
  return fallback_.isEmpty() ? QString(kHowToAsk) : fallback_ + "\n" + kHowToAsk;
}

void RecognitionController::sayHowToAsk() {
  RecognitionAnswer answer;
  answer.text = hint();
  showAnswer(answer);
}

void RecognitionController::showProblem(const QString& text, const QString& of) {
  asking_.abandon();
  RecognitionAnswer answer;
  answer.kind = RecognitionAnswer::Kind::kProblem;
  answer.text = text;
  answer.of = of;
  last_.reset();
  showAnswer(answer);
}

void RecognitionController::showAnswer(RecognitionAnswer answer) {
  answer_ = std::move(answer);
  emit answered(answer_);
}

bool RecognitionController::cancel() {
  if (!asking_.busy()) return false;
  showProblem("Cancelled.");
  return true;
}

void RecognitionController::settle() {
  FileReading::settleAll(photos_);
  while (busy()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

}  // namespace palpate::gui
