// The plan of recordings in the window: keeps it in the settings, gives each planned recording its
// object, run and notes, checks each take in the background, and tells what comes next.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <filesystem>
#include <optional>

#include <palpate/capture/recorder.h>
#include <palpate/capture/recording_plan.h>
#include <palpate/recognition/take_quality.h>

#include "gui/source/background_job.h"
#include "gui/source/file_reading.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {

class PlanController : public QObject {
  Q_OBJECT
 public:
  // Reads the plan from the settings, which must outlive this object.
  explicit PlanController(QSettings& settings, QObject* parent = nullptr);

  const RecordingPlan& plan() const noexcept { return plan_; }
  // Whether Record makes the next recording of the plan. It is remembered.
  bool followed() const noexcept { return followed_; }
  void setFollowed(bool on);
  // Why it is to be asked whether the plan is followed with `hand`, too (any text that tells hands
  // apart): "in an earlier session", "with another hand". Empty: it is.
  QString doubt(const QString& hand) const;
  void followWith(const QString& hand);

  // The limits of the check of a take; the settings keep them beside the plan. Values out of range
  // become the usual ones.
  const TakeCheckOptions& limits() const noexcept { return limits_; }
  void setLimits(const TakeCheckOptions& limits);

  // These throw Error with one line for the user; then nothing has changed.
  void addRow(const PlanRow& row);
  void setRow(std::size_t row, const PlanRow& now);
  void exportCsv(const std::filesystem::path& path) const;
  void removeRow(std::size_t row);
  // Replaces the plan by a table, which is read in the background; imported() follows. Refused
  // when a take is being recorded then, or the plan has changed meanwhile.
  void importCsv(const std::filesystem::path& path);
  bool importing() const noexcept { return reading_.busy(); }
  // The takes are forgotten, their files stay.
  void beginAnew();

  // `last` with object, run and notes of the next take; nothing: the plan isn't followed, or done.
  std::optional<RecordingSettings> nextSettings(const RecordingSettings& last) const;
  // From hold() to release() or end(), the next take is one of the row that is next now: editing
  // the row changes the take, editing other rows doesn't make another row the next one.
  void hold();
  void release();
  // False also when the row was removed meanwhile.
  bool holds() const noexcept { return row_.has_value(); }
  // The recording that begins is that take; it must not be shorter than `leastS` [s], where this is
  // given, else than the limits say.
  void begin(std::optional<double> leastS);
  // It ended, or could not be begun (no paths). A take is checked; checked() follows.
  void end(const RecordingReport& report);

  // Repeats a take: it counts no longer.
  void reject(const std::filesystem::path& file);
  // Keeps a take in spite of its problem: it counts.
  void keep(const std::filesystem::path& file);
  // A take that is to be decided: the last one, or the first from the top; nothing: none.
  std::optional<std::filesystem::path> undecided() const;
  // The newest take, if it was not rejected; remembered with the plan. Nothing: none.
  const std::optional<std::filesystem::path>& lastTake() const noexcept { return lastTake_; }
  void rename(const std::filesystem::path& from, const std::filesystem::path& to);
  void forget(const std::filesystem::path& file);

  // "3 of 12", "next: ball, left, 2 of 3; 1 take is to be decided" ("now: ..", while that take is
  // counted down or recorded) or "the plan is done"; empty: the plan has no row.
  QString progressText() const;
  QString nextText() const;

  // The take that comes next: "ball, left, 2 of 3"; empty: none does.
  QString nextTake() const;

  // Waits for the check and the import that run.
  void settle();

 signals:
  void changed();
  void followedChanged(bool on);
  // `problem`: one line for the user, and the plan is as it was; empty: it is the table's.
  void imported(const QString& problem);
  // `problem` is empty for a good take.
  void checked(const std::filesystem::path& file, const QString& problem);

 private:
  void save();
  // The take that is held, else the next one of the plan.
  std::optional<PlanStep> step() const;

  QSettings& settings_;
  RecordingPlan plan_;
  bool followed_ = false;
  // In this session; by which hand, if that is known already.
  bool followedNow_ = false;
  std::optional<QString> followedWith_;
  // The take that is being recorded.
  std::optional<std::size_t> row_;
  std::optional<double> leastS_;
  TakeCheckOptions limits_;
  std::optional<std::filesystem::path> lastTake_;
  BackgroundJob checking_;
  FileReading reading_{this};
};

}  // namespace palpate::gui
