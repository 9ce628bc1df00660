// The controller of the dock Recognise: keeps the model in use and its session, and answers
// questions in a worker thread.
#pragma once

#include <QObject>
#include <QSettings>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_collector.h>
#include <palpate/recognition/recognition_session.h>

#include "gui/recognise/object_photo.h"
#include "gui/recognise/recognition_answer.h"
#include "gui/source/abandonable.h"

namespace palpate::gui {

// A question: which object was grasped in these frames.
struct RecogniseQuestion {
  Profile profile;
  // First and last frame, both inclusive; nothing: all frames.
  std::optional<std::pair<std::size_t, std::size_t>> frames;
  // As RecognitionAnswer::of.
  QString of;
};

class RecognitionController : public QObject {
  Q_OBJECT
 public:
  // `dataFolder` contains the model for the emulated hand.
  RecognitionController(QSettings& settings,
                        std::filesystem::path dataFolder,
                        QObject* parent = nullptr);

  // Sets whether the emulated hand is shown. Its own model is then used, unless the user chose
  // another one for it.
  void setEmulated(bool emulated);
  bool emulated() const noexcept { return emulated_; }
  // Opens a model in the background. Without a call, the last used model is opened.
  void openModel(const std::filesystem::path& path);
  void useEmulatedModel();
  // Uses a model that was just trained and saved at `path`.
  void takeModel(TrainedModel model, const std::filesystem::path& path);
  const TrainedModel* model() const { return session_ ? &session_->model() : nullptr; }
  const std::filesystem::path& modelPath() const noexcept { return path_; }
  QString modelProblem() const { return modelProblem_; }
  // Why nothing can be asked, and what to do; empty: there is a model, or one is being opened.
  QString whyNoModel() const;
  // The session with the model; null without a model.
  RecognitionSession* session() noexcept { return session_.get(); }
  // Changes the session by calling `change`, emits sessionChanged(), and evaluates the last grasp
  // again.
  void changeSession(const std::function<void(RecognitionSession&)>& change);

  // Asks a question; answered() follows later. Replaces a running question.
  void ask(const RecogniseQuestion& question);
  // Answers that there is nothing to ask about, and why. `of` is as in RecognitionAnswer::of and
  // may be empty.
  void showProblem(const QString& text, const QString& of = {});
  // A contact has begun: removes a message that nothing is held.
  void touchBegins();
  // The contact has ended: an answer about "held now" becomes one about "the last grasp".
  void contactEnded();
  // Another source is shown: the answer isn't of it.
  void forgetAnswer();
  const RecognitionAnswer& answer() const noexcept { return answer_; }
  PhotoCache& photos() noexcept { return photos_; }
  // Sets the training folder as a folder with photos.
  void setPhotoFolder(const std::filesystem::path& folder);
  bool busy() const { return asking_.busy() || opening_.busy(); }
  bool cancel();
  // Waits until all work is done; for tests and pictures.
  void settle();

 signals:
  void modelChanged();
  void sessionChanged();
  void answered(const palpate::gui::RecognitionAnswer& answer);
  void said(const QString& text);

 private:
  void setModel(std::optional<TrainedModel> model, const std::filesystem::path& path);
  // `gone`: what is missing, where this model takes its place; empty: nothing.
  void readModel(const std::filesystem::path& path, const QString& gone);
  void takeDefault();
  void take(const ChosenGrasp& chosen, const QString& of);
  void classify(const ChosenGrasp& chosen, const QString& of);
  // What the user can do: ask, or choose a model first.
  QString hint() const;
  void sayHowToAsk();
  void showAnswer(RecognitionAnswer answer);
  bool isEmulatedModel() const;
  const char* settingsKey() const;

  QSettings& settings_;
  const std::filesystem::path emulatedModel_;
  bool emulated_ = false;
  bool started_ = false;
  std::filesystem::path path_, photoFolder_;
  QString modelProblem_;
  // The model that was used last isn't there any more, and which one is used instead; may be empty.
  QString fallback_;
  std::unique_ptr<RecognitionSession> session_;
  RecognitionAnswer answer_;
  // The last evaluated grasp, and its RecognitionAnswer::of.
  std::optional<std::pair<ChosenGrasp, QString>> last_;
  // A question that waits until the model is loaded.
  std::optional<RecogniseQuestion> waiting_;
  // Counts contacts: contactEnded() adds one.
  int contact_ = 0;
  PhotoCache photos_{this};
  Abandonable opening_;
  Abandonable asking_;
};

}  // namespace palpate::gui
