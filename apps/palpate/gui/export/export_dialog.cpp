#include "gui/export/export_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFileInfo>
#include <QFormLayout>
#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

#include "gui/export/export_forms.h"
#include "gui/export/export_movie_fields.h"
#include "gui/export/export_place.h"
#include "gui/export/export_preview.h"
#include "gui/widgets/elided_text.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr QSize kExportDialogUsualSize(900, 580);
constexpr int kExportDialogMargin = 20;       // [px]
constexpr int kFormWidth = 372;               // [px]
constexpr int kExportDialogFieldHeight = 28;  // [px]

constexpr const char* kExportDialogStyle = R"(
QLineEdit { background: palette(base); border: 1px solid palette(mid); border-radius: 4px; padding: 4px 6px; }
QLineEdit:focus { border-color: palette(highlight); }
#exportSide { background: palette(window); border-left: 1px solid palette(mid); }
)";

QDoubleSpinBox* spinBox(const char* name, double least, double most, int decimals) {
  auto* box = named(new QDoubleSpinBox, name);
  box->setRange(least, most);
  box->setDecimals(decimals);
  box->setMinimumHeight(kExportDialogFieldHeight);
  box->setKeyboardTracking(false);
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);
  return box;
}

QComboBox* exportDialogComboBox(const char* name) {
  auto* box = named(new QComboBox, name);
  box->setMinimumHeight(kExportDialogFieldHeight);
  return box;
}

}  // namespace

ExportDialog::ExportDialog(std::vector<const ExportedView*> views,
                           const ExportRequest& suggestion,
                           Ask& ask,
                           QWidget* parent)
    : QDialog(parent), views_(std::move(views)), first_(suggestion) {
  setWindowTitle("Export");
  setStyleSheet(kExportDialogStyle);
  auto* side = named(new QFrame(this), "exportSide");
  preview_ = named(new ExportPreview(side), "exportPreview");
  summary_ = makeLabel(side, "exportSummary");
  target_ = makeLabel(side, "exportTarget", "muted");
  for (QLabel* label : {summary_, target_}) {
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    label->setAlignment(Qt::AlignHCenter);
  }
  side->setLayout(inColumn({{preview_, 1}, summary_, target_},
                           Space::kNarrow,
                           {.left = Space::kNarrow,
                            .top = Space::kNarrow,
                            .right = Space::kNarrow,
                            .bottom = Space::kWide}));
  setLayout(
      inColumn({{inRow({makeForm(ask), {side, 1}}, Space::kNone), 1}, makeFoot()}, Space::kNone));
  fill(suggestion);
  connectFields();
  resize(kExportDialogUsualSize);
  refresh();
  preview_->installEventFilter(this);
}

QWidget* ExportDialog::makeForm(Ask& ask) {
  auto* form = new QWidget(this);
  fields_ = new QFormLayout(form);
  fields_->setContentsMargins(kExportDialogMargin, kExportDialogMargin, kExportDialogMargin, 14);
  fields_->setHorizontalSpacing(12);
  fields_->setVerticalSpacing(8);
  fields_->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  fields_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  view_ = exportDialogComboBox("exportView");
  for (const ExportedView* each : views_) view_->addItem(each->name);
  fields_->addRow("&View", view_);
  form_ = new ExportForms(form);
  fields_->addRow("Format", form_);
  frames_ = exportDialogComboBox("exportFrames");
  fields_->addRow("F&rames", frames_);
  table_ = exportDialogComboBox("exportTable");
  fields_->addRow("Ro&ws", table_);
  preset_ = exportDialogComboBox("exportPreset");
  for (const PaperPreset& preset : kPaperPresets) preset_->addItem(preset.name);
  fields_->addRow("&Size", preset_);
  size_ = makeSize();
  fields_->addRow("", size_);
  text_ = spinBox("exportText", kMinTextPt, kMaxTextPt, 1);
  text_->setSingleStep(0.5);
  text_->setSuffix(" pt");
  fields_->addRow("&Text", text_);
  dpi_ = exportDialogComboBox("exportDpi");
  for (const int dpi : kExportDpi) dpi_->addItem(QString::number(dpi) + " dpi", dpi);
  fields_->addRow("Reso&lution", dpi_);
  movie_ = new ExportMovieFields(*fields_);
  colors_ = exportDialogComboBox("exportColors");
  colors_->addItems({"for print: white background, dark lines", "as on screen"});
  fields_->addRow("&Colours", colors_);
  titled_ = named(new QCheckBox("T&itle line", form),
                  "exportTitled",
                  "Name of the recording, frame and time above the picture");
  fields_->addRow("", titled_);
  // Aligns the fields for all rows, so that they don't move when rows are shown or hidden.
  int labelWidth = 0;
  for (int row = 0; row < fields_->rowCount(); ++row)
    if (const auto* label = fields_->itemAt(row, QFormLayout::LabelRole))
      labelWidth = std::max(labelWidth, label->widget()->sizeHint().width());
  for (int row = 0; row < fields_->rowCount(); ++row)
    if (const auto* label = fields_->itemAt(row, QFormLayout::LabelRole))
      label->widget()->setMinimumWidth(labelWidth);
  place_ = new ExportPlace(labelWidth, ask, form);
  fields_->addRow(place_);
  // Larger text needs more; a name of a view may be longer than that.
  const int fieldWidth = std::max(form_->sizeHint().width(), colors_->sizeHint().width());
  form->setFixedWidth(
      std::max(kFormWidth,
               labelWidth + fields_->horizontalSpacing() + fieldWidth + 2 * kExportDialogMargin));
  return form;
}

QWidget* ExportDialog::makeSize() {
  width_ = spinBox("exportWidth", kMinPaperMm, kMaxPaperMm, 1);
  height_ = spinBox("exportHeight", kMinPaperMm, kMaxPaperMm, 1);
  width_->setAccessibleName("Width in mm");
  height_->setAccessibleName("Height in mm");
  return makeBox(inRow({{width_, 1}, "×", {height_, 1}, "mm"}));
}

QWidget* ExportDialog::makeFoot() {
  problem_ = makeLabel(this, "exportProblem", "problem");
  problem_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  replace_ = named(new QCheckBox("R&eplace", this), "exportReplace");
  auto* cancel = makeCancel(this, "exportCancel");
  ok_ = makeOk(this, "exportOk", "Export");
  connect(ok_, &QPushButton::clicked, this, &ExportDialog::accept);
  return makeDialogFoot(inRow({{problem_, 1}, replace_, Space::kUsual, cancel, ok_}, kFootEdges));
}

void ExportDialog::fill(const ExportRequest& suggestion) {
  filling_ = true;
  view_->setCurrentIndex(std::max(0, view_->findText(suggestion.view)));
  form_->choose(suggestion.form);
  movie_->fill(suggestion);
  wanted_ = suggestion.frames;
  dpi_->setCurrentIndex(std::max(0, dpi_->findData(suggestion.dpi)));
  colors_->setCurrentIndex(suggestion.forPrint ? 0 : 1);
  titled_->setChecked(suggestion.titled);
  place_->setName(suggestion.name, suggestion.nameIsOwn);
  place_->setFolder(suggestion.folder);
  showSize(suggestion.size());
  filling_ = false;
  useView();
  table_->setCurrentIndex(std::max(0, table_->findText(suggestion.table)));
  suggestName();
}

void ExportDialog::connectFields() {
  connect(view_, &QComboBox::currentIndexChanged, this, [this] {
    // A name from an earlier export is for the view that it was typed for; one that was typed just
    // now is for this export.
    if (first_.nameIsOwn && place_->name() == first_.name) place_->setName({}, false);
    useView();
    if (sizeIsChosen_) return usePreset();
    showSize(sizeFor(view(), first_));
    refresh();
  });
  connect(form_, &ExportForms::changed, this, [this] {
    fillFrames();
    suggestName();
    refresh();
  });
  connect(movie_, &ExportMovieFields::changed, this, &ExportDialog::refresh);
  connect(frames_, &QComboBox::currentIndexChanged, this, [this] {
    wanted_ = static_cast<ExportFrames>(frames_->currentData().toInt());
    suggestName();
    refresh();
  });
  connect(preset_, &QComboBox::currentIndexChanged, this, [this] {
    if (filling_) return;
    sizeIsChosen_ = true;
    usePreset();
  });
  connect(width_, &QDoubleSpinBox::valueChanged, this, [this] {
    if (filling_) return;
    sizeIsChosen_ = true;
    const QSignalBlocker blocked(preset_);
    preset_->setCurrentIndex(kOwnPreset);
    refresh();
  });
  for (QDoubleSpinBox* box : {height_, text_})
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] {
      sizeIsChosen_ = sizeIsChosen_ || !filling_;
      refresh();
    });
  for (QComboBox* box : {table_, dpi_, colors_})
    connect(box, &QComboBox::currentIndexChanged, this, &ExportDialog::refresh);
  connect(titled_, &QCheckBox::toggled, this, &ExportDialog::refresh);
  connect(replace_, &QCheckBox::toggled, this, &ExportDialog::showProblem);
  connect(place_, &ExportPlace::changed, this, &ExportDialog::showProblem);
  connect(preview_, &ExportPreview::summaryChanged, this, &ExportDialog::showProblem);
}

const ExportedView& ExportDialog::view() const {
  return *views_[static_cast<std::size_t>(std::max(0, view_->currentIndex()))];
}

// Offers the choices that the view allows.
void ExportDialog::useView() {
  const ExportedView& now = view();
  const auto tables = now.tablesNow();
  const QSignalBlocker blocked(table_);
  table_->clear();
  for (const ExportedTable& table : tables) table_->addItem(table.name);
  form_->use(now);
  fillFrames();
  suggestName();
}

// Offers the frames that the view and the form allow.
void ExportDialog::fillFrames() {
  const auto pictures = view().framePicturesNow();
  const QSignalBlocker blocked(frames_);
  frames_->clear();
  if (form_->chosen() != ExportFormat::kMovie)
    frames_->addItem("the shown frame", static_cast<int>(ExportFrames::kShown));
  if (pictures && pictures->selected) {
    const FrameSpan span = *pictures->selected;
    frames_->addItem(
        QString("the selected %1, %2 to %3").arg(span.count()).arg(span.first).arg(span.last),
        static_cast<int>(ExportFrames::kSelected));
  }
  if (pictures && pictures->numFrames > 0)
    frames_->addItem(QString("all %1").arg(pictures->numFrames),
                     static_cast<int>(ExportFrames::kAll));
  frames_->setCurrentIndex(std::max(0, frames_->findData(static_cast<int>(wanted_))));
}

void ExportDialog::usePreset() {
  const int preset = preset_->currentIndex();
  if (const auto sizeMm = sizeOfPreset(preset, view()))
    showSize({preset, *sizeMm, kPaperPresets[static_cast<std::size_t>(preset)].textPt});
  refresh();
}

void ExportDialog::showSize(const ExportSize& size) {
  const bool before = std::exchange(filling_, true);
  width_->setValue(size.sizeMm.width());
  height_->setValue(size.sizeMm.height());
  text_->setValue(size.textPt);
  preset_->setCurrentIndex(size.preset);
  filling_ = before;
}

void ExportDialog::suggestName() { place_->suggestName(suggestedName(request(), view())); }

ExportRequest ExportDialog::request() const {
  ExportRequest request = first_;
  request.view = view().name;
  request.form = form_->chosen();
  movie_->read(request);
  request.preset = preset_->currentIndex();
  request.sizeMm = {width_->value(), height_->value()};
  request.textPt = text_->value();
  request.dpi = dpi_->currentData().toInt();
  request.forPrint = colors_->currentIndex() == 0;
  request.titled = titled_->isChecked();
  request.frames = static_cast<ExportFrames>(frames_->currentData().toInt());
  request.table = table_->currentText();
  request.folder = place_->folder();
  request.name = place_->name();
  request.nameIsOwn = place_->nameIsOwn();
  request.replace = replace_->isChecked();
  return request;
}

void ExportDialog::refresh() {
  if (filling_) return;
  const ExportRequest now = request();
  const bool isPicture = now.form != ExportFormat::kCsv;
  const bool asOnScreen = now.preset == kScreenPreset;
  const auto show = [this](QWidget* field, bool on) {
    field->setVisible(on);
    if (QWidget* label = fields_->labelForField(field)) label->setVisible(on);
  };
  show(frames_, now.isMovie() || (now.form == ExportFormat::kPng && frames_->count() > 1));
  show(table_, !isPicture);
  show(preset_, isPicture);
  show(size_, isPicture && !asOnScreen);
  show(text_, isPicture && !asOnScreen);
  show(dpi_, now.form == ExportFormat::kPng);
  movie_->setVisible(now.isMovie());
  show(colors_, isPicture);
  show(titled_, isPicture);
  place_->setEnding(now.isSeries() ? "_00000.png" : endingOf(now.form));
  preview_->show(view(), now);
  showProblem();
}

QString ExportDialog::problem() const { return problemOf(request(), view()); }

void ExportDialog::showProblem() {
  const ExportRequest now = request();
  ExportRequest replacing = now;
  replacing.replace = true;
  ExportRequest keeping = now;
  keeping.replace = false;
  const QString inTheWay = problemOf(now, view());
  // Offers to replace only when a file exists.
  replace_->setVisible(problemOf(keeping, view()) != problemOf(replacing, view()));
  const double needed = preview_->bytes() * static_cast<double>(preview_->numFiles());
  QString text = inTheWay.isEmpty() ? spaceProblemOf(now, needed) : inTheWay;
  if (text.isEmpty()) text = heightHintOf(now, view());
  problem_->setText(text);
  problem_->setToolTip(text);
  ok_->setEnabled(inTheWay.isEmpty());
  summary_->setText(preview_->summary());
  const QString path = QString::fromStdString(pathOf(now).string());
  const bool makes = now.isSeries() && !QFileInfo::exists(path);
  showElided(target_,
             "in " + (now.isSeries() ? path : now.folder) + (makes ? ", a new folder" : ""),
             preview_->width());
}

void ExportDialog::accept() {
  // A file may have been created meanwhile.
  showProblem();
  if (problem().isEmpty()) QDialog::accept();
}

// The lines below the preview are as wide as it.
bool ExportDialog::eventFilter(QObject* watched, QEvent* event) {
  if (watched == preview_ && event->type() == QEvent::Resize) showProblem();
  return QDialog::eventFilter(watched, event);
}

}  // namespace palpate::gui
