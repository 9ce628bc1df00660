#include "gui/batch/batch_dialog.h"

#include <QCheckBox>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QStyle>
#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <memory>
#include <utility>

#include <palpate/core/number_text.h>

#include "gui/batch/batch_fields.h"
#include "gui/batch/batch_results.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/dialog_properties.h"
#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr QSize kBatchDialogSize(900, 600);
constexpr int kFirstNames = 4;  // lines of the preview
constexpr int kCalmMs = 200;    // without changes, before the names are looked for
constexpr int kBarSteps = 1000;
constexpr const char* kBatchFoldersKey = "batch/lastFolder";

constexpr const char* kBatchStyle = R"(
#batchFolder, #batchNames, #batchFilters, #batchSmooth { background: palette(base); border: 1px solid palette(mid); border-radius: 4px; padding: 3px 6px; }
#batchFolder:focus, #batchNames:focus, #batchFilters:focus, #batchSmooth:focus { border-color: palette(highlight); }
QListWidget { background: palette(base); border: 1px solid palette(mid); border-radius: 4px; }
#batchSaid[problem="true"] { color: palette(bright-text); }
)";

constexpr const char* kFieldsTip =
    "{name}: the recording's name without its ending\n"
    "{folder}: the folders between the given folder and the recording\n"
    "{ending}: the recording's ending: dsa, palpate\n"
    "{date}, {time}: when the recording begins, 2014-11-27 and 10-31-05\n"
    "{n}: the number of the grasp, where there is a file for each grasp\n"
    "Names without {folder} keep the folders of the recordings.";

QStringList pathsOf(const QMimeData& data) {
  QStringList paths;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  return paths;
}

}  // namespace

BatchDialog::BatchDialog(QSettings& settings,
                         BatchController& controller,
                         Ask& ask,
                         QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      controller_(controller),
      ask_(ask),
      pages_(new QTabWidget) {
  setWindowTitle("Batch");
  setObjectName("batchDialog");
  setStyleSheet(kBatchStyle);
  setProperty(kWantsStopProperty, true);
  setAcceptDrops(true);
  setSizeGripEnabled(true);
  results_ = named(new BatchResults(ask), "batchResults");
  pages_->setObjectName("batchPages");
  pages_->setDocumentMode(true);
  pages_->addTab(makeChoices(), "&Choices");
  pages_->addTab(results_, "Res&ults");
  setLayout(inColumn({{pages_, 1}, makeFoot()}, Space::kNone, {.top = Space::kUsual}));
  delay_.setSingleShot(true);
  delay_.setInterval(kCalmMs);
  connect(&delay_, &QTimer::timeout, this, &BatchDialog::look);
  setChoices(loadBatchChoices(settings));
  connectFields();
  connectController();
  resize(kBatchDialogSize);
  changed();
}

// A field that loses the focus while the dialog is destroyed says once more that it was edited.
BatchDialog::~BatchDialog() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

QWidget* BatchDialog::makeChoices() {
  recordings_ = makeRecordings();
  fields_ = new BatchFields;
  auto* upper = inRow({{recordings_, 1}, {inColumn({fields_, Stretch{}}), 1}}, Space::kDialog);
  place_ = makePlace();
  return makeBox(inColumn({{upper, 1}, place_}, Space::kWide, kPageEdges));
}

QWidget* BatchDialog::makeRecordings() {
  paths_ = named(new QListWidget, "batchPaths", {}, "Recordings and folders");
  paths_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  paths_->setTextElideMode(Qt::ElideMiddle);
  paths_->setMinimumHeight(90);
  auto* hint =
      makeLabel(paths_->viewport(), "batchHint", "muted", "Drop recordings and folders here");
  hint->setAttribute(Qt::WA_TransparentForMouseEvents);
  auto* centre = new QVBoxLayout(paths_->viewport());
  centre->addWidget(hint, 0, Qt::AlignCenter);
  const auto showHint = [this, hint] { hint->setVisible(paths_->count() == 0); };
  connect(paths_->model(), &QAbstractItemModel::rowsInserted, hint, showHint);
  connect(paths_->model(), &QAbstractItemModel::rowsRemoved, hint, showHint);
  connect(paths_->model(), &QAbstractItemModel::modelReset, hint, showHint);
  count_ = makeLabel(nullptr, "batchCount");
  count_->setProperty("role", "muted");
  auto* files = makeButton(this, "batchAddFiles", "Add &files…");
  auto* folder = makeButton(this, "batchAddFolder", "Add fol&der…");
  remove_ = makeButton(this, "batchRemove", "&Remove");
  auto* side = makeBox(inColumn({{paths_, 1}, count_, inRow({files, folder, remove_, Stretch{}})}));
  keepKeys(*paths_, {Qt::Key_Delete}, [this] { removeChosen(); });
  connect(remove_, &QPushButton::clicked, this, &BatchDialog::removeChosen);
  connect(files, &QPushButton::clicked, this, [this] {
    addPaths(ask_.files("Recordings to read",
                        settings_.value(kBatchFoldersKey).toString(),
                        "Recordings (*.palpate *.dsa);;All files (*)"));
  });
  connect(folder, &QPushButton::clicked, this, [this] {
    const QString chosen =
        ask_.folder("Choose a folder", settings_.value(kBatchFoldersKey).toString());
    if (!chosen.isEmpty()) addPaths({chosen});
  });
  connect(paths_, &QListWidget::itemSelectionChanged, this, &BatchDialog::showState);
  return side;
}

QWidget* BatchDialog::makePlace() {
  auto* part = new QWidget;
  auto* form = new QFormLayout(part);
  form->setContentsMargins(0, 0, 0, 0);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  folder_ = named(new QLineEdit, "batchFolder");
  folder_->setPlaceholderText("folder for the results (created if missing)");
  auto* browse = makeButton(this, "batchBrowse", "&Browse…");
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString chosen = ask_.folder("Choose a folder", folder_->text());
    if (!chosen.isEmpty()) folder_->setText(chosen);
  });
  auto* folderRow = inRow({{folder_, 1}, browse});
  names_ = named(new QLineEdit, "batchNames", kFieldsTip);
  ending_ = makeLabel(nullptr, "batchEnding");
  auto* help =
      makeLabel(nullptr, "batchFieldsHelp", "muted", "{name} {folder} {ending} {date} {time}");
  help->setToolTip(kFieldsTip);
  auto* namesRow = inRow({{names_, 1}, ending_, Space::kWide, help});
  preview_ = makeLabel(nullptr, "batchPreview", "muted");
  preview_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  preview_->setFixedHeight(preview_->fontMetrics().lineSpacing() * (kFirstNames + 1));
  preview_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  resume_ = named(new QCheckBox("&Keep complete results"), "batchResume");
  resume_->setToolTip(
      "Skip results that were already made from the same recording with the same choices");
  replace_ = named(new QCheckBox("Rep&lace other files"), "batchReplace");
  replace_->setToolTip("Overwrite existing files, including files not created by a batch");
  threads_ = named(new QSpinBox, "batchThreads", "Recordings at the same time");
  threads_->setRange(0, kMaxBatchThreads);
  threads_->setSpecialValueText("one per core");
  threads_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  auto* options = inRow({resume_,
                         Space::kWide,
                         replace_,
                         Stretch{},
                         makeTitle("At the same ti&me", threads_),
                         threads_});
  form->addRow(makeTitle("Into fold&er", folder_), folderRow);
  form->addRow(makeTitle("N&ames", names_), namesRow);
  form->addRow("", preview_);
  form->addRow("", options);
  return part;
}

QWidget* BatchDialog::makeFoot() {
  bar_ = named(new QProgressBar, "batchDialogProgress");
  bar_->setRange(0, kBarSteps);
  bar_->setTextVisible(false);
  bar_->setFixedHeight(8);
  QSizePolicy kept = bar_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);
  bar_->setSizePolicy(kept);
  said_ = makeLines(nullptr, "batchSaid");
  said_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  said_->setMinimumHeight(2 * said_->fontMetrics().lineSpacing());
  cancel_ = makeButton(this, "batchCancel", "Cancel");
  close_ = makeButton(this, "batchClose", "Close", "A running batch continues");
  start_ = makeOk(this, "batchStart", "&Start");
  connect(cancel_, &QPushButton::clicked, &controller_, &BatchController::cancel);
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(start_, &QPushButton::clicked, this, &BatchDialog::start);
  return makeDialogFoot(
      inColumn({bar_, inRow({{said_, 1}, Space::kUsual, cancel_, close_, start_})}, kPageEdges));
}

void BatchDialog::connectFields() {
  connect(fields_, &BatchFields::edited, this, &BatchDialog::changed);
  for (QLineEdit* field : {folder_, names_})
    connect(field, &QLineEdit::textChanged, this, &BatchDialog::changed);
  for (QCheckBox* box : {resume_, replace_})
    connect(box, &QCheckBox::toggled, this, &BatchDialog::changed);
  connect(threads_, &QSpinBox::valueChanged, this, &BatchDialog::changed);
  connect(&job_, &BackgroundJob::finished, this, &BatchDialog::showState);
  connect(results_, &BatchResults::said, this, [this](const QString& text) { say(text, false); });
}

void BatchDialog::connectController() {
  connect(&controller_, &BatchController::started, this, [this] {
    bar_->setValue(0);
    results_->begin();
    showState();
    say("Reading the folders …", false);
  });
  connect(&controller_, &BatchController::progressed, this, &BatchDialog::showProgress);
  connect(&controller_, &BatchController::ended, this, [this] {
    results_->show(controller_.outcome());
    pages_->setCurrentWidget(results_);
    const BatchReport& report = controller_.outcome()->report;
    say((report.cancelled ? "Cancelled: " : "Ended: ") + countsText(report.status), false);
  });
  connect(&controller_, &BatchController::failed, this, [this](const QString& message) {
    pages_->setCurrentIndex(0);
    say(message, true);
  });
  connect(&controller_, &BatchController::finished, this, [this] {
    const QString text = said_->text();
    const bool isProblem = said_->property("problem").toBool();
    results_->show(controller_.outcome());
    showState();
    say(text, isProblem);
  });
}

BatchChoices BatchDialog::choices() const {
  BatchChoices choices;
  fields_->readInto(choices);
  for (int row = 0; row < paths_->count(); ++row)
    choices.paths << paths_->item(row)->data(Qt::UserRole).toString();
  choices.folder = folder_->text().trimmed();
  choices.names = names_->text().trimmed();
  choices.resume = resume_->isChecked();
  choices.replace = replace_->isChecked();
  choices.threads = threads_->value();
  return choices;
}

void BatchDialog::setChoices(const BatchChoices& choices) {
  filling_ = true;
  fields_->fill(choices);
  setPaths(choices.paths);
  folder_->setText(choices.folder);
  names_->setText(choices.names);
  resume_->setChecked(choices.resume);
  replace_->setChecked(choices.replace);
  threads_->setValue(choices.threads);
  filling_ = false;
  changed();
}

void BatchDialog::setPaths(const QStringList& paths) {
  paths_->clear();
  addPaths(paths);
  changed();
}

void BatchDialog::addPaths(const QStringList& paths) {
  for (const QString& each : paths) {
    const QFileInfo file(each);
    const QString path = file.absoluteFilePath();
    bool known = false;
    for (int row = 0; row < paths_->count(); ++row)
      known = known || paths_->item(row)->data(Qt::UserRole).toString() == path;
    if (known) continue;
    auto* item = new QListWidgetItem(file.isDir() && path != "/" ? path + "/" : path, paths_);
    item->setData(Qt::UserRole, path);
    item->setToolTip(path);
    if (!filling_) settings_.setValue(kBatchFoldersKey, file.absolutePath());
  }
  changed();
}

void BatchDialog::removeChosen() {
  qDeleteAll(paths_->selectedItems());
  changed();
}

void BatchDialog::changed() {
  if (filling_) return;
  ++change_;
  // A file for each grasp needs its number in the name.
  const bool eachGrasp = usesEachGrasp(choices());
  if (eachGrasp != std::exchange(eachGrasp_, eachGrasp)) {
    const QString names = names_->text().trimmed();
    if (eachGrasp && !names.contains("{n}")) names_->setText(names + "_{n}");
    if (!eachGrasp && names.endsWith("_{n}")) names_->setText(names.chopped(4));
  }
  ending_->setText(endingOf(choices()));
  delay_.start();
  showState();
}

void BatchDialog::look() {
  job_.cancel();
  auto look = std::make_shared<BatchLook>();
  const std::size_t change = change_;
  job_.start(
      "look",
      [choices = choices(), look](const Progress& progress) {
        *look = lookAtBatch(choices, progress);
      },
      [this, look, change] {
        if (change != change_) return;
        shown_ = change;
        look_ = std::move(*look);
        showLook();
      });
}

void BatchDialog::showLook() {
  const std::size_t count = look_.plan.items.size();
  count_->setText(count == 0 ? "" : QString::fromStdString(counted(count, "recording")));
  QStringList lines = firstNames(look_.plan, kFirstNames);
  const std::size_t listed = static_cast<std::size_t>(lines.size());
  if (count > listed) lines << QString("and %1 more").arg(count - listed);
  QStringList shown;
  for (const QString& line : lines)
    shown << preview_->fontMetrics().elidedText(line, Qt::ElideMiddle, preview_->width());
  preview_->setText(shown.join("\n"));
  preview_->setToolTip(lines.join("\n"));
  showState();
}

QString BatchDialog::problem() const {
  if (controller_.busy()) return "a batch is running";
  if (shown_ != change_) return "reading the folders";
  return look_.problem;
}

void BatchDialog::showState() {
  const bool busy = controller_.busy();
  recordings_->setEnabled(!busy);
  fields_->setEnabled(!busy);
  place_->setEnabled(!busy);
  bar_->setVisible(busy);
  cancel_->setVisible(busy);
  remove_->setEnabled(!paths_->selectedItems().isEmpty());
  const QString text = problem();
  start_->setEnabled(text.isEmpty());
  // What isn't filled in yet is no mistake: then the text is a hint.
  const bool missing = paths_->count() == 0 || folder_->text().trimmed().isEmpty();
  if (!busy) say(text, !text.isEmpty() && shown_ == change_ && !missing);
}

void BatchDialog::showProgress(const BatchStatus& status) {
  if (!controller_.busy()) return;
  bar_->setValue(static_cast<int>(status.fraction * kBarSteps));
  say(QString::fromStdString(statusText(status)), false);
}

void BatchDialog::say(const QString& text, bool isProblem) {
  said_->setText(text);
  if (said_->property("problem").toBool() == isProblem) return;
  said_->setProperty("problem", isProblem);
  said_->style()->unpolish(said_);
  said_->style()->polish(said_);
}

void BatchDialog::start() {
  if (!problem().isEmpty()) return;
  const BatchChoices now = choices();
  saveBatchChoices(now, settings_);
  controller_.start(now);
}

void BatchDialog::dragEnterEvent(QDragEnterEvent* event) {
  if (!controller_.busy() && !pathsOf(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void BatchDialog::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  addPaths(pathsOf(*event->mimeData()));
}

}  // namespace palpate::gui
