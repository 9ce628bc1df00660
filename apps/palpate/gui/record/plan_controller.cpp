#include "gui/record/plan_controller.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/core/output_file.h>
#include <palpate/core/text_file.h>
#include <palpate/recording/recording.h>

#include "gui/appearance/settings_table.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPlanKey = "recording/plan";
constexpr const char* kLastTakeKey = "recording/plan_last_take";
constexpr const char* kFollowPlanKey = "recording/follow_plan";

void limitFields(SettingsTable& table, TakeCheckOptions& limits) {
  // validate() knows the ranges.
  constexpr double kAny = 1e9;
  table.number("recording/plan_limits/taxels", limits.contact.taxels, -kAny, kAny);
  table.number("recording/plan_limits/least_s", limits.leastS, -kAny, kAny);
  table.number("recording/plan_limits/most_lost", limits.mostLost, -kAny, kAny);
  table.number("recording/plan_limits/most_saturated", limits.mostSaturated, -kAny, kAny);
  table.number("recording/plan_limits/least_quality", limits.leastQuality, -kAny, kAny);
}

TakeCheckOptions keptLimits(const QSettings& settings) {
  const auto limits = loadFields<TakeCheckOptions>(settings, limitFields);
  try {
    limits.validate();
  } catch (const std::invalid_argument&) {
    return {};  // a settings file never stops the program
  }
  return limits;
}

std::int64_t lostIn(const RecordingReport& report) {
  const auto fromHand = report.counters.find("lost");
  return report.lost + (fromHand == report.counters.end() ? 0 : fromHand->second);
}

// The take that was made last, where only the plan is known: rows are recorded from the top.
std::optional<fs::path> lastTakeOf(const RecordingPlan& plan) {
  for (auto row = plan.rows().rbegin(); row != plan.rows().rend(); ++row)
    if (!row->takes.empty())
      return row->takes.back().rejected ? std::nullopt : std::optional(row->takes.back().file);
  return std::nullopt;
}

// The plan of a table. Throws Error with one line for the user.
RecordingPlan planIn(const fs::path& path) {
  const std::string name = path.filename().string() + ": ";
  PlanTable table;
  try {
    table = readPlanTable(readTextFile(path, kMaxPlanTableBytes));
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw Error(name + error.what());
  }
  if (const std::size_t problems = table.problems.size(); problems > 0)
    throw Error(
        name + (table.more ? "more than " + counted(problems, "problem") + ", the first: " : "") +
        table.problems.front() +
        (problems > 1 && !table.more ? ", and " + counted(problems - 1, "more problem") : "") +
        "; the plan is as it was");
  if (table.rows.empty()) throw Error(name + "has no rows; the plan is as it was");
  RecordingPlan plan;
  for (PlanRow& row : table.rows) plan.addRow(std::move(row));
  return plan;
}

}  // namespace

PlanController::PlanController(QSettings& settings, QObject* parent)
    : QObject(parent), settings_(settings) {
  const QByteArray kept = settings.value(kPlanKey).toString().toUtf8();
  try {
    if (!kept.isEmpty()) plan_ = RecordingPlan::fromJson({kept.data(), std::size_t(kept.size())});
  } catch (const Error&) {
    // A settings file never stops the program.
  }
  if (settings.contains(kLastTakeKey)) {
    const fs::path last = settings.value(kLastTakeKey).toString().toStdString();
    const PlannedTake* take = plan_.find(last);
    if (take && !take->rejected) lastTake_ = last;
  } else {
    lastTake_ = lastTakeOf(plan_);
  }
  followed_ = settings.value(kFollowPlanKey, false).toBool();
  limits_ = keptLimits(settings);
  // A take that can't be checked is one with a problem; see end().
  connect(&checking_, &BackgroundJob::finished, this, &PlanController::changed);
  connect(&reading_, &FileReading::finished, this, &PlanController::changed);
}

void PlanController::save() {
  settings_.setValue(kPlanKey, QString::fromStdString(plan_.json()));
  settings_.setValue(kLastTakeKey, QString::fromStdString(lastTake_ ? lastTake_->string() : ""));
  emit changed();
}

void PlanController::setFollowed(bool on) {
  followedNow_ = on;
  followedWith_.reset();
  if (on == followed_) return;
  followed_ = on;
  settings_.setValue(kFollowPlanKey, on);
  emit followedChanged(on);
  emit changed();
}

QString PlanController::doubt(const QString& hand) const {
  if (!followedNow_) return "in an earlier session";
  return followedWith_.value_or(hand) == hand ? QString() : "with another hand";
}

void PlanController::followWith(const QString& hand) {
  followedNow_ = true;
  followedWith_ = hand;
}

void PlanController::setLimits(const TakeCheckOptions& limits) {
  if (limits == limits_) return;
  limits_ = limits;
  saveFields(settings_, limits, limitFields);
  emit changed();
}

void PlanController::addRow(const PlanRow& row) {
  plan_.addRow(row);
  save();
}

void PlanController::setRow(std::size_t row, const PlanRow& now) {
  plan_.setRow(row, now);
  save();
}

void PlanController::removeRow(std::size_t row) {
  plan_.removeRow(row);
  if (row_ == row)
    row_.reset();
  else if (row_ && *row_ > row)
    --*row_;
  if (lastTake_ && !plan_.find(*lastTake_)) lastTake_.reset();
  save();
}

void PlanController::importCsv(const fs::path& path) {
  const std::string asked = plan_.json();
  reading_.start(
      [this, path, asked]() -> FileReading::Take {
        return [this, path, asked, plan = planIn(path)] {
          const QString name =
              QString::fromStdString(path.filename().string()) + ": not imported: ";
          if (row_) return emit imported(name + "a take of the plan is being recorded");
          if (plan_.json() != asked) return emit imported(name + "the plan has since changed");
          plan_ = plan;
          lastTake_.reset();
          save();
          emit imported({});
        };
      },
      [this](const QString& problem) { emit imported(problem); });
  emit changed();
}

void PlanController::exportCsv(const fs::path& path) const {
  OutputFile out(path, Overwrite::kReplace);
  out.write(planCsv(plan_));
  out.commit();
}

void PlanController::beginAnew() {
  plan_.forgetTakes();
  lastTake_.reset();
  save();
}

std::optional<RecordingSettings> PlanController::nextSettings(const RecordingSettings& last) const {
  const auto next = step();
  if (!followed_ || !next) return std::nullopt;
  const PlanRow& row = plan_.rows()[next->row];
  RecordingSettings settings = last;
  settings.object = QString::fromStdString(row.object);
  settings.run = QString::fromStdString(row.run);
  settings.repetition = QString("%1 of %2").arg(next->repetition).arg(row.repetitions);
  if (!row.notes.empty()) settings.notes = QString::fromStdString(row.notes);
  return settings;
}

std::optional<PlanStep> PlanController::step() const {
  if (!row_) return plan_.next();
  const PlanRow& row = plan_.rows()[*row_];
  return PlanStep{*row_, row.numDone() + row.numUndecided() + 1};
}

void PlanController::hold() {
  if (const auto next = step()) row_ = next->row;
  emit changed();
}

void PlanController::release() {
  if (!row_) return;
  row_.reset();
  emit changed();
}

void PlanController::begin(std::optional<double> leastS) {
  if (const auto next = step()) row_ = next->row;
  leastS_ = leastS;
  emit changed();
}

void PlanController::end(const RecordingReport& report) {
  const auto row = std::exchange(row_, std::nullopt);
  if (!row || report.paths.empty()) {
    emit changed();
    return;
  }
  const fs::path file = report.paths.front();
  plan_.addTake(*row, {.file = file});
  lastTake_ = file;
  save();
  auto problem = std::make_shared<std::string>(report.openGapText());
  TakeCheckOptions limits = limits_;
  limits.leastS = leastS_.value_or(limits.leastS);
  checking_.start(
      "the take",
      [problem, paths = report.paths, lost = lostIn(report), limits](const Progress& progress) {
        try {
          std::vector<Profile> parts;
          for (const fs::path& path : paths) parts.push_back(openRecording(path));
          const std::string found = checkTake(parts, lost, limits, progress).problem();
          *problem += (problem->empty() || found.empty() ? "" : "; ") + found;
        } catch (const Cancelled&) {
          throw;
        } catch (const std::exception& error) {
          *problem = std::string("can't be checked: ") + error.what();
        }
      },
      [this, problem, file] {
        // It may have been discarded or renamed meanwhile.
        if (!plan_.setProblem(file, *problem)) return;
        save();
        emit checked(file, QString::fromStdString(*problem));
      });
}

void PlanController::reject(const fs::path& file) {
  if (!plan_.reject(file)) return;
  if (lastTake_ == file) lastTake_.reset();
  save();
}

void PlanController::keep(const fs::path& file) {
  if (plan_.keep(file)) save();
}

std::optional<fs::path> PlanController::undecided() const {
  if (lastTake_)
    if (const PlannedTake* last = plan_.find(*lastTake_); last && last->undecided())
      return lastTake_;
  for (const PlanRow& row : plan_.rows())
    for (const PlannedTake& take : row.takes)
      if (take.undecided()) return take.file;
  return std::nullopt;
}

void PlanController::rename(const fs::path& from, const fs::path& to) {
  if (!plan_.rename(from, to)) return;
  if (lastTake_ == from) lastTake_ = to;
  save();
}

void PlanController::forget(const fs::path& file) {
  if (!plan_.forget(file)) return;
  if (lastTake_ == file) lastTake_.reset();
  save();
}

QString PlanController::progressText() const {
  if (plan_.rows().empty()) return {};
  return QString("%1 of %2").arg(plan_.numDone()).arg(plan_.total());
}

QString PlanController::nextText() const {
  if (plan_.rows().empty()) return {};
  const auto next = step();
  const int undecided = plan_.numUndecided();
  const QString open = undecided == 0
                           ? QString()
                           : QString::number(undecided) +
                                 (undecided == 1 ? " take is" : " takes are") + " to be decided";
  if (!next) return open.isEmpty() ? "the plan is done" : open;
  const QString text = (row_ ? "now: " : "next: ") + nextTake();
  return open.isEmpty() ? text : text + "; " + open;
}

QString PlanController::nextTake() const {
  const auto next = step();
  if (!next) return {};
  const PlanRow& row = plan_.rows()[next->row];
  QString text = QString::fromStdString(row.object);
  if (!row.run.empty()) text += ", " + QString::fromStdString(row.run);
  if (row.repetitions > 1) text += QString(", %1 of %2").arg(next->repetition).arg(row.repetitions);
  return text;
}

void PlanController::settle() {
  reading_.settle();
  while (checking_.busy()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

}  // namespace palpate::gui
