// Teaching by a folder with a folder of recordings per object: what it holds, clips that are
// captured into it, the model that learns from it, and how well that goes. All beside the window,
// one after the other.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/recognition/cross_validation.h>
#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/trained_model.h>

#include "gui/source/background_job.h"

namespace palpate::gui {

// A grasp that was captured to teach.
struct TrainingClip {
  enum class State {
    kWaiting,   // something is wrong with it: it is taken when a person says so
    kSaving,    //
    kAccepted,  // it lies in the folder
    kTakenOut,  // it lies beside the folder
    kFailed     // it could not be written
  };
  State state = State::kWaiting;
  QString object;
  std::filesystem::path path;  // where it lies; empty: nowhere yet
  Profile profile;
  double quality = 0.0;  // 0..1
  double seconds = 0.0;
  QString problem;  // why it waits, or failed
};

// Cross-validation over the folder.
struct TrainingValidation {
  std::shared_ptr<const FeatureTable> table;
  SampleSet samples;
  std::optional<ValidationReport> report;
  bool blocks = true;  // protocol B; else S
};

class TrainingController : public QObject {
  Q_OBJECT
 public:
  explicit TrainingController(QSettings& settings, QObject* parent = nullptr);

  const std::filesystem::path& folder() const noexcept { return folder_; }
  // Empty: none. Looks into it.
  void setFolder(const std::filesystem::path& folder);
  void look();  // again
  // Null: not looked into yet, or it can't be.
  const std::shared_ptr<const FeatureTable>& table() const noexcept { return table_; }
  QString problem() const { return problem_; }  // why not
  // Objects and their grasps, those that were captured since included.
  std::map<QString, int> counts() const;

  // A grasp of an object. Good ones are taken at once, the others wait.
  void capture(const QString& object, const Profile& clip);
  const std::vector<TrainingClip>& clips() const noexcept { return clips_; }
  void accept(std::size_t clip);   // one that waits, or was taken out
  void takeOut(std::size_t clip);  // beside the folder: nothing is deleted
  // The newest that is in the folder; nothing: there is none.
  std::optional<std::size_t> newestAccepted() const;

  // Learns from the folder as it is now; trained() follows.
  void train(const std::filesystem::path& out, const std::optional<EmptyHandZero>& zero);
  void check(bool blocks);
  const std::shared_ptr<const TrainingValidation>& checked() const noexcept { return checked_; }

  bool busy() const { return job_.busy(); }
  BackgroundJob& job() noexcept { return job_; }
  bool cancel();
  void settle();

 signals:
  void folderChanged();  // or what it holds
  void clipsChanged();
  void trained(const palpate::TrainedModel& model, const QString& path);
  void checkedChanged();
  void said(const QString& text);
  void failed(const QString& message);

 private:
  std::shared_ptr<const FeatureTable> gather(const std::filesystem::path& folder,
                                             const Progress& progress) const;
  void take(const std::shared_ptr<const FeatureTable>& table);
  void save(std::size_t clip);

  QSettings& settings_;
  std::filesystem::path folder_;
  std::shared_ptr<const FeatureTable> table_;
  QString problem_;
  std::vector<TrainingClip> clips_;
  std::shared_ptr<const TrainingValidation> checked_;
  BackgroundJob job_;
  BackgroundJob saving_;
};

}  // namespace palpate::gui
