// The controller of the pages Teach and Check: manages a training folder (one subfolder of
// recordings for each object), captures clips into it, trains a model and validates it. The work
// runs in a worker thread, one task after the other.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/recognition/cross_validation.h>
#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/trained_model.h>
#include <palpate/recognition/training_choice.h>

#include "gui/source/background_job.h"

namespace palpate::gui {

// A captured grasp for training.
struct TrainingClip {
  enum class State {
    // It has a problem and is stored only when the user accepts it.
    kWaiting,
    // It is being written.
    kSaving,
    // It is in the training folder.
    kAccepted,
    // It was moved to a folder next to the training folder.
    kTakenOut,
    // It could not be written.
    kFailed
  };
  State state = State::kWaiting;
  // Tells it from all other clips of the controller, also after the list has changed.
  int id = 0;
  QString object;
  // Path of the file; empty when there is none yet.
  std::filesystem::path path;
  Profile profile;
  double quality = 0.0;  // 0..1
  double seconds = 0.0;
  // Why it waits or failed.
  QString problem;
};

// Results of a cross-validation over the training folder.
struct TrainingValidation {
  // Without the grasps that are left out.
  std::shared_ptr<const FeatureTable> table;
  SampleSet samples;
  PipelineOptions options;
  std::optional<ValidationReport> report;
  // Protocol B (blocks in time); otherwise S (random splits).
  bool blocks = true;
};

class TrainingController : public QObject {
  Q_OBJECT
 public:
  explicit TrainingController(QSettings& settings, QObject* parent = nullptr);

  const std::filesystem::path& folder() const noexcept { return folder_; }
  // What is trained and checked with; the settings keep it. Another set reads the folder again.
  const TrainingChoice& choice() const noexcept { return choice_; }
  void setChoice(const TrainingChoice& choice);
  // The set that is used: the chosen one, else that of the folder's hand.
  FeatureSet set() const;
  // Sets and reads the training folder; empty: none.
  void setFolder(const std::filesystem::path& folder);
  // Reads the folder again.
  void look();
  // Features of the folder's grasps; null when it is not read yet or cannot be read.
  const std::shared_ptr<const FeatureTable>& table() const noexcept { return table_; }
  // Why the folder cannot be read.
  QString problem() const { return problem_; }
  // Grasps of the folder that neither train nor test; the settings keep them for each folder.
  const std::set<LeftOutGrasp>& leftOut() const noexcept { return leftOut_; }
  bool isLeftOut(const FeatureRow& row) const { return leftOut_.contains({row.file, row.begin}); }
  // Leaves grasps out, or takes them in again: rows of the table.
  void setLeftOut(const std::vector<std::size_t>& rows, bool out);
  // Takes the last change of setLeftOut() back.
  bool canUndoLeavingOut() const noexcept { return !leavingOut_.empty(); }
  void undoLeavingOut();
  // Does again what undoLeavingOut() took back last, until the next change.
  void redoLeavingOut();
  // The objects with their number of grasps that train, including those captured since the folder
  // was read.
  std::map<QString, int> counts() const;

  // Captures a grasp of an object. Good ones are stored at once; others wait for the user.
  void capture(const QString& object, const Profile& clip);
  const std::vector<TrainingClip>& clips() const noexcept { return clips_; }
  // Stores a clip that waits or was taken out.
  void accept(std::size_t clip);
  // Moves a clip out of the training folder; nothing is deleted.
  void takeOut(std::size_t clip);

  // Trains with the present content of the folder; emits trained().
  void train(const std::filesystem::path& out, const std::optional<EmptyHandZero>& zero);
  void check(bool blocks);
  const std::shared_ptr<const TrainingValidation>& checked() const noexcept { return checked_; }

  bool busy() const { return job_.busy(); }
  BackgroundJob& job() noexcept { return job_; }
  bool cancel();
  void settle();

 signals:
  // Another folder, or its content has changed.
  void folderChanged();
  void choiceChanged();
  void leftOutChanged();
  void clipsChanged();
  void trained(const palpate::TrainedModel& model, const QString& path);
  void checkedChanged();
  void said(const QString& text);
  void failed(const QString& message);

 private:
  void take(const std::shared_ptr<const FeatureTable>& table);
  void save(std::size_t clip);
  void readLeftOut();
  void changeLeftOut(const std::vector<LeftOutGrasp>& grasps, bool out);

  QSettings& settings_;
  std::filesystem::path folder_;
  TrainingChoice choice_;
  std::set<LeftOutGrasp> leftOut_;
  // The changes, newest last, each with whether it left the grasps out.
  std::vector<std::pair<std::vector<LeftOutGrasp>, bool>> leavingOut_;
  // The changes that were taken back, the last one last.
  std::vector<std::pair<std::vector<LeftOutGrasp>, bool>> takenBack_;
  std::shared_ptr<const FeatureTable> table_;
  QString problem_;
  std::vector<TrainingClip> clips_;
  int lastClipId_ = 0;
  std::shared_ptr<const TrainingValidation> checked_;
  BackgroundJob job_;
  BackgroundJob saving_;
};

}  // namespace palpate::gui
