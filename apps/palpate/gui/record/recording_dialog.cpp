#include "gui/record/recording_dialog.h"

#include <QCheckBox>
#include <QDir>
#include <QFileInfo>
#include <QFrame>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScreen>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/record/key_labels.h"
#include "gui/record/recording_timing.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/elided_text.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr const char* kLooking = "Looking at the folder …";
constexpr int kRecordingDialogWidth = 580;  // [px]
// Largest number of letters in a field; the file name is shortened to less.
constexpr int kRecordingDialogMostLetters = 200;
constexpr int kNoteLines = 3;
// Least height of the fields, where they are scrolled [px].
constexpr int kRecordingDialogLeastScroll = 150;
// Room that the frame of the desktop takes around the dialog [px].
constexpr int kRecordingDialogFrame = 44;
// [ms]; {time} changes, and other programs may write into the folder
constexpr int kRecordingDialogRefreshMs = 1000;

// Less free space than this is said [bytes].
constexpr double kLittleSpace = 1e9;
constexpr double kMegabyte = 1e6;

// Style of the dialog's own parts, with palette colours so that it follows the theme.
constexpr const char* kRecordingDialogStyle = R"(
QLineEdit, QPlainTextEdit { background: palette(base); border: 1px solid palette(mid); border-radius: 4px; }
QLineEdit { padding: 4px 6px; }
QPlainTextEdit { padding: 1px 2px; }
QLineEdit:focus, QPlainTextEdit:focus { border-color: palette(highlight); }
#recordingPreview { background: palette(base); border: 1px solid palette(mid); border-radius: 6px; }
#recordingInsert { padding-right: 22px; }
#recordingInsert::menu-indicator { subcontrol-origin: border; subcontrol-position: right center; right: 9px; }
)";

// The notes: a few lines, more when the dialog is made taller.
class NotesField : public QPlainTextEdit {
 public:
  using QPlainTextEdit::QPlainTextEdit;
  QSize sizeHint() const override {
    return {QPlainTextEdit::sizeHint().width(), kNoteLines * fontMetrics().lineSpacing() + 14};
  }
  QSize minimumSizeHint() const override { return sizeHint(); }
};

struct Placeholder {
  const char* text;
  const char* what;
};
constexpr std::array kPlaceholders = {Placeholder{"{date}", "Date"},
                                      Placeholder{"{time}", "Time"},
                                      Placeholder{"{operator}", "Operator"},
                                      Placeholder{"{object}", "Object"},
                                      Placeholder{"{run}", "Run number"}};

QLabel* muted(const QString& text, QWidget* parent) { return makeLabel(parent, {}, "muted", text); }

// Lets the label become narrower than its text, which is elided.
void letShrink(QLabel* label) {
  label->setTextFormat(Qt::PlainText);
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
}

}  // namespace

RecordingDialog::RecordingDialog(const RecordingSettings& settings,
                                 const QString& okText,
                                 Ask& ask,
                                 QWidget* parent,
                                 const Clock& clock)
    : QDialog(parent),
      ask_(ask),
      clock_(clock),
      looking_(
          [](const Look& look, const Progress&, const auto&) {
            Next next{previewNextPath(look.settings, look.nowUs)};
            next.free = look.freeBytes(next.path.parent_path());
            return next;
          },
          [this](const Next& next) { take(next); },
          [this](const QString& why) {
            Next next;
            next.problem = why;
            take(next);
          },
          nullptr,
          LatestAnswer<Look, Next>::Turns::kAtOnce) {
  setWindowTitle("Recording");
  setStyleSheet(kRecordingDialogStyle);
  auto* content = new QWidget;
  auto* fields = makeFields();
  timing_ = new RecordingTiming(content);
  marks_ = new KeyLabels(content);
  content->setLayout(inColumn({{fields, 1}, timing_, marks_},
                              Space::kWide,
                              {.left = Space::kDialog,
                               .top = Space::kDialog,
                               .right = Space::kDialog,
                               .bottom = Space::kNarrow}));
  scroll_ = new ContentScroll(content, {0, kRecordingDialogLeastScroll}, this);
  auto* preview = inColumn({makePreview()},
                           {.left = Space::kDialog,
                            .top = Space::kUsual,
                            .right = Space::kDialog,
                            .bottom = Space::kWide});
  // On a small screen the fields are scrolled; the name and the buttons stay.
  setLayout(inColumn({{scroll_, 1}, preview, makeFoot(okText)}, Space::kNone));
  fill(settings);
  for (QLineEdit* field : {operator_, object_, template_, folder_})
    connect(field, &QLineEdit::textChanged, this, &RecordingDialog::refresh);
  // Where a part is opened, the dialog becomes taller instead of the notes smaller.
  for (FoldingPart* part : {static_cast<FoldingPart*>(timing_), static_cast<FoldingPart*>(marks_)})
    connect(part, &FoldingPart::folded, this, [this] {
      fitHeight(std::max(0, notes_->height() - notes_->sizeHint().height()));
    });
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] {
    if (!looking_.busy()) refresh();
  });
  timer->start(kRecordingDialogRefreshMs);
  caption_->setText(kLooking);
  refresh();
  resize(kRecordingDialogWidth, height());
  fitHeight();
}

QLineEdit* RecordingDialog::makeField(const char* name, int maxLetters) {
  auto* field = named(new QLineEdit(this), name);
  field->setMaxLength(maxLetters);
  return field;
}

QWidget* RecordingDialog::makeFields() {
  auto* fields = new QWidget(this);
  auto* grid = new QGridLayout(fields);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(12);
  grid->setVerticalSpacing(8);
  grid->setColumnStretch(1, 1);
  int row = 0;
  const auto add = [&](const QString& title, QWidget* field, QWidget* button = nullptr) {
    auto* label = makeTitle(title, field);
    if (qobject_cast<QPlainTextEdit*>(field)) label->setContentsMargins(0, 5, 0, 0);
    grid->addWidget(
        label, row, 0, qobject_cast<QPlainTextEdit*>(field) ? Qt::AlignTop : Qt::Alignment());
    grid->addWidget(field, row, 1, 1, button ? 1 : 2);
    if (button) grid->addWidget(button, row, 2);
    ++row;
  };
  operator_ = makeField("recordingOperator", kRecordingDialogMostLetters);
  operator_->setPlaceholderText("who records");
  add("O&perator", operator_);
  object_ = makeField("recordingObject", kRecordingDialogMostLetters);
  object_->setPlaceholderText("what is grasped");
  add("&Object", object_);
  notes_ = named(new NotesField(fields), "recordingNotes");
  notes_->setToolTip("Kept in this recording, not in the next ones. Ctrl+Enter: done");
  notes_->setTabChangesFocus(true);
  notes_->setPlaceholderText("any other notes");
  notes_->installEventFilter(this);
  notes_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  add("No&tes", notes_);
  grid->setRowStretch(row - 1, 1);
  template_ = makeField("recordingTemplate", kRecordingDialogMostLetters);
  auto* placeholders = makeButton(fields,
                                  "recordingInsert",
                                  "&Insert",
                                  "Add a part to the name that changes with each recording");
  placeholders_ = makePlaceholders();
  placeholders->setMenu(placeholders_);
  add("File &name", template_, placeholders);
  folder_ = makeField("recordingFolder", 4096);
  auto* browse = makeButton(fields, "recordingBrowse", "&Browse…");
  connect(browse, &QPushButton::clicked, this, &RecordingDialog::browse);
  add("&Folder", folder_, browse);
  mcap_ = named(new QCheckBox("Also an M&CAP file, for Foxglove and ROS 2", fields),
                "recordingMcap",
                "Saved next to the recording, under the same name");
  grid->addWidget(mcap_, row, 1, 1, 2);
  return fields;
}

QMenu* RecordingDialog::makePlaceholders() {
  auto* menu = new QMenu(this);
  for (const Placeholder& placeholder : kPlaceholders) {
    QAction* action = menu->addAction(QString(placeholder.what) + "\t" + placeholder.text);
    action->setData(placeholder.text);
    connect(
        action, &QAction::triggered, this, [this, action] { insert(action->data().toString()); });
  }
  // Each placeholder may be used once.
  connect(menu, &QMenu::aboutToShow, this, [this, menu] {
    for (QAction* action : menu->actions())
      action->setEnabled(!template_->text().contains(action->data().toString()));
  });
  return menu;
}

QWidget* RecordingDialog::makePreview() {
  auto* frame = named(new QFrame(this), "recordingPreview");
  caption_ = muted({}, frame);
  caption_->setObjectName("recordingCaption");
  name_ = makeLabel(frame, "recordingNextName");
  QFont bold = name_->font();
  bold.setBold(true);
  name_->setFont(bold);
  letShrink(name_);
  place_ = muted({}, frame);
  place_->setObjectName("recordingNextFolder");
  letShrink(place_);
  problem_ = makeLines(frame, "recordingProblem", "problem");
  // A path may be of any length.
  problem_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  problem_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  // A problem replaces both lines, so that nothing moves.
  problem_->setFixedHeight(2 * fontMetrics().lineSpacing() + 3);
  frame->setLayout(inColumn({caption_, name_, place_, problem_}, Space::kNarrow, kPageEdges));
  return frame;
}

QWidget* RecordingDialog::makeFoot(const QString& okText) {
  askEachTime_ = named(new QCheckBox("&Ask before each recording", this),
                       "recordingAsk",
                       "If off, Record starts immediately with these settings");
  auto* cancel = makeCancel(this, "recordingCancel");
  ok_ = makeOk(this, "recordingOk", okText);
  connect(ok_, &QPushButton::clicked, this, &RecordingDialog::accept);
  return makeDialogFoot(inRow({{askEachTime_, 1}, cancel, ok_}, kFootEdges));
}

void RecordingDialog::fill(const RecordingSettings& settings) {
  operator_->setText(settings.operatorName);
  object_->setText(settings.object);
  run_ = settings.run;
  repetition_ = settings.repetition;
  // Only the plan of recordings gives a repetition.
  if (!repetition_.isEmpty()) {
    object_->setEnabled(false);
    object_->setToolTip("The plan of recordings gives the object (Ctrl+Alt+P)");
  }
  notes_->setPlainText(settings.notes);
  template_->setText(settings.nameTemplate);
  folder_->setText(settings.folder);
  timing_->fill(settings);
  mcap_->setChecked(settings.withMcap);
  askEachTime_->setChecked(settings.askEachTime);
  marks_->setLabels(settings.markLabels);
}

RecordingSettings RecordingDialog::settings() const {
  RecordingSettings settings;
  settings.operatorName = operator_->text().simplified();
  settings.object = object_->text().simplified();
  settings.run = run_;
  settings.repetition = repetition_;
  settings.notes = notes_->toPlainText().trimmed();
  settings.nameTemplate = template_->text().trimmed();
  settings.folder = folderFromText(folder_->text());
  timing_->readInto(settings);
  settings.withMcap = mcap_->isChecked();
  settings.askEachTime = askEachTime_->isChecked();
  settings.markLabels = marks_->labels();
  return settings;
}

void RecordingDialog::insert(const QString& placeholder) {
  const auto joins = [](QChar letter) { return letter == '_' || letter == '-'; };
  const QString text = template_->text();
  const qsizetype from =
      template_->hasSelectedText() ? template_->selectionStart() : template_->cursorPosition();
  const qsizetype to = template_->hasSelectedText() ? template_->selectionEnd() : from;
  QString put = placeholder;
  if (from > 0 && !joins(text[from - 1])) put.prepend('_');
  if (to < text.size() && !joins(text[to])) put.append('_');
  template_->insert(put);
  template_->setFocus();
}

void RecordingDialog::browse() {
  // Starts at the folder or, if it does not exist, at its nearest existing parent.
  QDir begin(folderFromText(folder_->text()));
  while (!begin.exists() && begin.isAbsolute() && !begin.isRoot())
    begin.setPath(QFileInfo(begin.path()).path());
  const QString chosen =
      ask_.folder("Folder for recordings", begin.isAbsolute() ? begin.path() : QDir::homePath());
  if (!chosen.isEmpty()) folder_->setText(chosen);
}

void RecordingDialog::fitHeight(int extraPx) {
  scroll_->widget()->layout()->activate();
  scroll_->updateGeometry();
  layout()->activate();
  const int most = screen()->availableGeometry().height() - kRecordingDialogFrame;
  resize(width(), std::min(sizeHint().height() + extraPx, most));
}

void RecordingDialog::refresh() {
  isAccepting_ = false;
  looking_.ask({settings(), clock_.wallUs(), freeBytes});
}

void RecordingDialog::take(const Next& next) {
  next_ = next;
  const bool good = next_.problem.isEmpty();
  caption_->setText(good ? "The next recording will be"
                         : "Recording isn't possible with these entries");
  name_->setVisible(good);
  place_->setVisible(good);
  problem_->setVisible(!good);
  problem_->setText(next_.problem);
  problem_->setToolTip(next_.problem);
  ok_->setEnabled(good);
  showTexts();
  if (std::exchange(isAccepting_, false) && good) QDialog::accept();
}

void RecordingDialog::showTexts() {
  // The dialog is still being built.
  if (!askEachTime_) return;
  showElided(
      name_, QString::fromStdString(next_.path.filename().string()), name_->contentsRect().width());
  const QString folder = QString::fromStdString(next_.path.parent_path().string());
  QString place = "in " + folder;
  if (next_.folderWillBeMade) place += ", which will be created";
  const bool isLittle = next_.free && static_cast<double>(*next_.free) < kLittleSpace;
  if (isLittle)
    place += ": only " + figure(static_cast<double>(*next_.free) / kMegabyte, 1) + " MB free";
  place_->setStyleSheet(isLittle ? "color: palette(bright-text);" : "");
  showElided(place_, place, place_->contentsRect().width());
}

void RecordingDialog::accept() {
  // The folder may have been deleted meanwhile.
  refresh();
  isAccepting_ = true;
  caption_->setText(kLooking);
}

void RecordingDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  // The object changes most often.
  QLineEdit* first = operator_->text().isEmpty() ? operator_ : object_;
  first->setFocus();
  first->selectAll();
  refresh();
  // The button that stops the hand may have come to it.
  fitHeight(std::max(0, notes_->height() - notes_->sizeHint().height()));
}

void RecordingDialog::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  layout()->activate();
  showTexts();
}

bool RecordingDialog::eventFilter(QObject* watched, QEvent* event) {
  if (watched == notes_ && event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool enter = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
    if (enter && key->modifiers().testFlag(Qt::ControlModifier)) {
      accept();
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

}  // namespace palpate::gui
