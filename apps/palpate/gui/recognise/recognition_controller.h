// What stands behind the dock Recognise: the model in use, the day with it, and questions that are
// answered beside the window.
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
#include "gui/source/background_job.h"

namespace palpate::gui {

struct RecogniseQuestion {
  Profile profile;
  std::optional<std::pair<std::size_t, std::size_t>> frames;  // both inclusive; nothing: all
  QString of;                                                 // as RecognitionAnswer::of
};

class RecognitionController : public QObject {
  Q_OBJECT
 public:
  // `dataFolder` has the model of emulated objects.
  RecognitionController(QSettings& settings,
                        std::filesystem::path dataFolder,
                        QObject* parent = nullptr);

  // The emulated hand is what is connected and shown: its model is taken, as long as nobody chose
  // another for it.
  void setEmulated(bool emulated);
  bool emulated() const noexcept { return emulated_; }
  // Of its own accord it takes the last one; in the background.
  void openModel(const std::filesystem::path& path);
  void useEmulatedModel();
  // Made here, and saved there.
  void takeModel(TrainedModel model, const std::filesystem::path& path);
  const TrainedModel* model() const { return session_ ? &session_->model() : nullptr; }
  const std::filesystem::path& modelPath() const noexcept { return path_; }
  QString modelProblem() const { return modelProblem_; }
  // Null without a model.
  RecognitionSession* session() noexcept { return session_.get(); }
  // After day() was changed: tells it, and judges the last grasp anew.
  void changeSession(const std::function<void(RecognitionSession&)>& change);

  // Answered by answered(), later. Replaces a question that is at work.
  void ask(const RecogniseQuestion& question);
  // There is nothing to ask about: why. `of` as RecognitionAnswer::of; may be empty.
  void sayTrouble(const QString& text, const QString& of = {});
  // Something is held from now on: that nothing was is over.
  void touchBegins();
  // Nothing is held any more: what was asked of "held now" is from here on of "the last grasp".
  void contactEnded();
  const RecognitionAnswer& answer() const noexcept { return answer_; }
  PhotoCache& photos() noexcept { return photos_; }
  void setPhotoFolder(const std::filesystem::path& folder);  // of teaching
  bool busy() const { return asking_.busy() || opening_.busy(); }
  bool cancel();
  void settle();  // for tests and pictures

 signals:
  void modelChanged();
  void sessionChanged();
  void answered(const palpate::gui::RecognitionAnswer& answer);
  void said(const QString& text);

 private:
  void setModel(std::optional<TrainedModel> model, const std::filesystem::path& path);
  void takeDefault();
  void classify(const ChosenGrasp& chosen, const QString& of);
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
  std::unique_ptr<RecognitionSession> session_;
  RecognitionAnswer answer_;
  std::optional<std::pair<ChosenGrasp, QString>> last_;  // that was judged, and what it is of
  std::optional<RecogniseQuestion> waiting_;             // for the model
  int generation_ = 0;
  int contact_ = 0;  // counts what the hand held: one more with each contactEnded()
  PhotoCache photos_;
  BackgroundJob opening_;
  BackgroundJob asking_;
};

}  // namespace palpate::gui
