#include "gui/import/import_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <algorithm>
#include <utility>

#include <palpate/core/number_text.h>
#include <palpate/model/hand_file.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/import/import_fields.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr QSize kImportDialogSize(940, 640);
constexpr const char* kDetected = "found by names";
constexpr double kHighestImportRateHz = 1e6;

QComboBox* importComboBox(const char* name, const std::vector<std::pair<QString, QString>>& items) {
  auto* box = named(new QComboBox, name);
  for (const auto& [text, value] : items) box->addItem(text, value);
  return box;
}

void chooseImportValue(QComboBox& box, const QString& value) {
  box.setCurrentIndex(std::max(0, box.findData(value)));
}

QString sampleText(const ImportPreview& preview) {
  const ImportReport& sample = preview.sample;
  QString text = QString("%1 %2: %3, %4 Hz, %5")
                     .arg(preview.isWhole ? "All" : "The first",
                          QString::fromStdString(counted(sample.rows, "row")),
                          QString::fromStdString(counted(sample.frames, "frame")),
                          QString::number(preview.rateHz, 'f', 1),
                          QString::fromStdString(counted(sample.gaps, "gap")));
  return text;
}

}  // namespace

ImportDialog::ImportDialog(QSettings& settings,
                           std::vector<std::filesystem::path> folders,
                           Ask& ask,
                           QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      ask_(ask),
      folders_(std::move(folders)),
      looking_(
          [folders = folders_](const ImportRequest& request, const Progress&, const auto&) {
            return lookAtImport(request, folders);
          },
          [this](const ImportLook& look) { take(look); },
          [this](const QString& why) {
            ImportLook look;
            look.problem = why;
            take(look);
          },
          nullptr,
          LatestAnswer<ImportRequest, ImportLook>::Turns::kAtOnce) {
  setWindowTitle("Import");
  const ImportRequest last = loadImportRequest(settings);
  fields_ = new ImportFields(this);
  setLayout(inColumn({inRow({{makeFile(), 3}, {fields_, 4}}), {makePreview(), 1}, makeFoot()},
                     kPageEdges));
  for (const KnownHand& each : knownHands(folders_))
    hand_->addItem(QString::fromStdString(each.key));
  strict_->setChecked(last.strict);
  listPresets("");
  showMapping(last.mapping);
  if (!last.hand.isEmpty()) setHand(last.hand);
  connectFields();
  resize(kImportDialogSize);
  look();
}

// A field that loses the focus while the dialog is destroyed says once more that it was edited.
ImportDialog::~ImportDialog() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

QWidget* ImportDialog::makeFile() {
  auto* side = new QWidget(this);
  auto* form = new QFormLayout(side);
  form->setContentsMargins(0, 0, 8, 0);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const auto withButton = [&](QWidget* field, const QString& text, const char* name, auto pressed) {
    auto* button = makeButton(nullptr, name, text);
    auto* row = inRow({{field, 1}, button});
    connect(button, &QPushButton::clicked, this, pressed);
    return row;
  };
  data_ = named(new QLineEdit, "importData");
  data_->setPlaceholderText("CSV, text, .npy, .npz, HDF5");
  form->addRow(makeTitle("&File", data_), withButton(data_, "Bro&wse…", "importBrowse", [this] {
                 const QString chosen =
                     ask_.file("Choose a file to import",
                               loadImportRequest(settings_).data,
                               "Tables (*.csv *.tsv *.txt *.log *.dat *.npy *.npz *.h5 *.hdf5 "
                               "*.mat);;All files (*)");
                 if (!chosen.isEmpty()) setData(chosen);
               }));
  hand_ = named(new QComboBox, "importHand");
  form->addRow(makeTitle("&Hand", hand_), withButton(hand_, "Fol&der…", "importHandFolder", [this] {
                 const QString chosen = ask_.folder("Folder of a hand", {});
                 if (!chosen.isEmpty()) setHand(chosen);
               }));
  preset_ = named(new QComboBox, "importPreset");
  auto* presets = withButton(preset_, "&Save…", "importSavePreset", [this] {
    const QString now = preset_->currentData().toString();
    const QString name = ask_.text("Save the mapping", "Name", now).value_or(QString());
    if (name.isEmpty()) return;
    importPresets(settings_).save(name, request().mapping);
    listPresets(name);
  });
  removePreset_ = makeButton(nullptr, "importRemovePreset", "Forget");
  connect(removePreset_, &QPushButton::clicked, this, [this] {
    importPresets(settings_).remove(preset_->currentData().toString());
    listPresets("");
  });
  presets->addWidget(removePreset_);
  form->addRow(makeTitle("&Mapping", preset_), presets);
  delimiter_ = importComboBox("importDelimiter",
                              {{"detected", "detect"},
                               {"comma", "comma"},
                               {"semicolon", "semicolon"},
                               {"tab", "tab"},
                               {"blanks", "blank"}});
  decimal_ = importComboBox("importDecimal", {{"decimal point", "."}, {"decimal comma", ","}});
  header_ = importComboBox(
      "importHeader",
      {{"names: detected", "detect"}, {"first line: names", "present"}, {"no names", "absent"}});
  auto* text = inRow({{delimiter_, 1}, {decimal_, 1}, {header_, 1}});
  form->addRow(makeTitle("Te&xt", delimiter_), text);
  components_ = importComboBox("importComponents",
                               {{"by the names of the columns", ""},
                                {"x, y, z of each taxel", "interleaved"},
                                {"all x, then all y, then all z", "planar"}});
  components_->setAccessibleName("Components of the taxels");
  form->addRow("Components", components_);
  form->setRowVisible(components_, false);
  time_ = named(new QLineEdit, "importTime");
  time_->setPlaceholderText(kDetected);
  timeUnit_ = importComboBox("importTimeUnit",
                             {{"unit: detected", ""},
                              {"s", "s"},
                              {"ms", "ms"},
                              {"µs", "us"},
                              {"ns", "ns"},
                              {"min", "min"},
                              {"h", "h"},
                              {"date (ISO 8601)", "iso"},
                              {"date, day first", "dmy"},
                              {"date, month first", "mdy"}});
  rate_ = named(new QDoubleSpinBox, "importRate", "Rows per second, if the file has no times");
  rate_->setRange(0.0, kHighestImportRateHz);
  rate_->setDecimals(3);
  rate_->setSuffix(" Hz");
  rate_->setSpecialValueText("times of the file");
  rate_->setKeyboardTracking(false);
  auto* time = inRow({{time_, 2}, {timeUnit_, 1}, {rate_, 1}});
  form->addRow(makeTitle("&Time", time_), time);
  form->addRow("Series", makeSeries());
  return side;
}

// Other tables to import with the data, each with the times of its rows.
QWidget* ImportDialog::makeSeries() {
  series_ = named(new QTableWidget(0, 3),
                  "importSeries",
                  "Other tables, each a series of the recording with the times of its rows",
                  "Files as series");
  series_->setHorizontalHeaderLabels({"name", "rate [Hz]", "file"});
  series_->horizontalHeader()->setStretchLastSection(true);
  series_->verticalHeader()->hide();
  series_->setSelectionBehavior(QAbstractItemView::SelectRows);
  series_->setTabKeyNavigation(false);
  fitToText(*series_, [this] {
    constexpr int kLines = 4;  // the names of the columns, and three series
    series_->setFixedHeight(kLines * 2 * series_->fontMetrics().lineSpacing());
  });
  auto* add = makeButton(nullptr, "importAddSeries", "Add a file as series…");
  connect(add, &QPushButton::clicked, this, [this] {
    const QString chosen = ask_.file("Choose a table that becomes a series",
                                     loadImportRequest(settings_).data,
                                     "Tables (*.csv *.tsv *.txt *.log *.dat *.npy *.npz *.h5 "
                                     "*.hdf5 *.mat);;All files (*)");
    if (!chosen.isEmpty()) addSeries(chosen);
  });
  removeSeries_ = makeButton(nullptr, "importRemoveSeries", "Remove");
  removeSeries_->setEnabled(false);
  connect(removeSeries_, &QPushButton::clicked, this, [this] {
    series_->removeRow(series_->currentRow());
    look();
  });
  connect(series_, &QTableWidget::itemSelectionChanged, this, [this] {
    removeSeries_->setEnabled(series_->currentRow() >= 0);
  });
  connect(series_, &QTableWidget::itemChanged, this, [this] { look(); });
  return makeBox(inColumn({series_, inRow({add, removeSeries_, Stretch{}})}, Space::kNarrow));
}

void ImportDialog::addSeries(const QString& file) {
  const std::string proposed = seriesName(QFileInfo(file).completeBaseName().toStdString());
  QString name = QString::fromStdString(proposed);
  for (int i = 2; std::ranges::count(series(), name.toStdString(), &SeriesFile::name) > 0; ++i)
    name = QString::fromStdString(proposed) + "_" + QString::number(i);
  filling_ = true;
  const int row = series_->rowCount();
  series_->insertRow(row);
  series_->setItem(row, 0, new QTableWidgetItem(name));
  auto* rate = new QTableWidgetItem;
  rate->setToolTip("Rows per second from the first frame on, if the file has no times");
  series_->setItem(row, 1, rate);
  auto* path = new QTableWidgetItem(QFileInfo(file).fileName());
  path->setData(Qt::UserRole, file);
  path->setToolTip(file);
  path->setFlags(path->flags() & ~Qt::ItemIsEditable);
  series_->setItem(row, 2, path);
  filling_ = false;
  look();
}

std::vector<SeriesFile> ImportDialog::series() const {
  std::vector<SeriesFile> files;
  for (int row = 0; row < series_->rowCount(); ++row) {
    SeriesFile file{series_->item(row, 0)->text().trimmed().toStdString(),
                    series_->item(row, 2)->data(Qt::UserRole).toString().toStdString(),
                    std::nullopt};
    const QString rate = series_->item(row, 1)->text().trimmed();
    if (!rate.isEmpty()) file.rateHz = parseDouble(rate.toStdString()).value_or(0.0);
    files.push_back(std::move(file));
  }
  return files;
}

QString ImportDialog::seriesProblem() const {
  const std::vector<SeriesFile> files = series();
  for (const SeriesFile& each : files) {
    const QString name = QString::fromStdString(each.name);
    if (const std::string valid = seriesName(each.name); valid != each.name)
      return "the series \"" + name + "\" needs a name of small letters, digits and _: \"" +
             QString::fromStdString(valid) + "\"";
    if (std::ranges::count(files, each.name, &SeriesFile::name) > 1)
      return "two series have the name " + name + ": give each its own";
    constexpr double kLowestRateHz = 1e-6;
    if (each.rateHz && !(*each.rateHz >= kLowestRateHz && *each.rateHz <= kHighestImportRateHz))
      return "the rate of the series " + name + " must be a number from 1e-6 to 1e6 Hz, or empty";
  }
  return {};
}

QWidget* ImportDialog::makePreview() {
  form_ = makeLines(nullptr, "importForm");
  columns_ = named(new QTableWidget, "importColumns");
  columns_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  columns_->setTabKeyNavigation(false);
  choices_ = makeLines(nullptr, "importChoices");
  warnings_ = makeLines(nullptr, "importWarnings", "warning");
  warnings_->hide();
  return makeBox(inColumn({form_, {columns_, 1}, choices_, warnings_}), this);
}

QWidget* ImportDialog::makeFoot() {
  out_ = named(new QLineEdit, "importOut");
  replace_ = named(new QCheckBox("R&eplace"), "importReplace");
  strict_ = named(new QCheckBox("Stop at the first row that &can't be used"), "importStrict");
  problem_ = makeLines(nullptr, "importProblem");
  auto* cancel = makeCancel(this, "importCancel");
  ok_ = makeOk(this, "importOk", "Import");
  connect(ok_, &QPushButton::clicked, this, &ImportDialog::accept);
  return makeBox(inColumn({inRow({makeTitle("Sa&ve as", out_), out_, replace_, strict_}),
                           inRow({{problem_, 1}, cancel, ok_})}));
}

void ImportDialog::connectFields() {
  const auto changed = [this] { look(); };
  connect(data_, &QLineEdit::editingFinished, this, [this] {
    takeRateOfMapping();
    proposeOut();
    look();
  });
  connect(time_, &QLineEdit::editingFinished, this, changed);
  for (QComboBox* box : {hand_, delimiter_, decimal_, header_, components_, timeUnit_})
    connect(box, &QComboBox::currentIndexChanged, this, changed);
  connect(rate_, &QDoubleSpinBox::valueChanged, this, changed);
  connect(fields_, &ImportFields::edited, this, changed);
  connect(preset_, &QComboBox::activated, this, &ImportDialog::usePreset);
  connect(out_, &QLineEdit::textChanged, this, &ImportDialog::showProblem);
  connect(replace_, &QCheckBox::toggled, this, &ImportDialog::showProblem);
}

// A rate that was typed belongs to the file before.
void ImportDialog::takeRateOfMapping() {
  if (std::exchange(dataBefore_, data_->text()) == data_->text()) return;
  const auto chosen = importPresets(settings_).load(preset_->currentData().toString());
  filling_ = true;
  rate_->setValue(chosen ? chosen->time.rateHz.value_or(0.0) : 0.0);
  filling_ = false;
}

void ImportDialog::setData(const QString& path) {
  data_->setText(path);
  takeRateOfMapping();
  out_->clear();
  proposeOut();
  look();
}

void ImportDialog::proposeOut() {
  const QFileInfo file(data_->text().trimmed());
  if (!file.isFile() || (!out_->text().trimmed().isEmpty() && out_->text() != proposed_)) return;
  proposed_ = file.path() + "/" + file.completeBaseName() + ".palpate";
  out_->setText(proposed_);
}

QString ImportDialog::out() const {
  QString out = out_->text().trimmed();
  if (out.isEmpty()) return out;
  if (QFileInfo(out).suffix().isEmpty()) out += ".palpate";
  // A name without a folder is saved beside the table.
  return QFileInfo(data_->text().trimmed()).absoluteDir().filePath(out);
}

void ImportDialog::setHand(const QString& nameOrFolder) {
  if (hand_->findText(nameOrFolder) < 0) hand_->addItem(nameOrFolder);
  hand_->setCurrentText(nameOrFolder);
}

void ImportDialog::listPresets(const QString& chosen) {
  preset_->clear();
  preset_->addItem("none", "");
  const auto presets = importPresets(settings_);
  for (const QString& name : presets.names())
    if (presets.load(name)) preset_->addItem(name, name);
  chooseImportValue(*preset_, chosen);
  removePreset_->setEnabled(preset_->currentIndex() > 0);
}

void ImportDialog::usePreset() {
  const QString name = preset_->currentData().toString();
  removePreset_->setEnabled(!name.isEmpty());
  if (const auto mapping = importPresets(settings_).load(name)) {
    showMapping(*mapping);
    look();
  }
}

void ImportDialog::showMapping(const ImportMapping& mapping) {
  filling_ = true;
  first_ = mapping;
  chooseImportValue(
      *delimiter_,
      QString::fromLatin1(delimiterName(mapping.text.delimiter).data(),
                          static_cast<qsizetype>(delimiterName(mapping.text.delimiter).size())));
  chooseImportValue(*decimal_, QString(QChar(mapping.text.decimal)));
  header_->setCurrentIndex(static_cast<int>(mapping.text.header));
  components_->setCurrentIndex(static_cast<int>(mapping.components));
  time_->setText(QString::fromStdString(mapping.time.column));
  chooseImportValue(*timeUnit_, QString::fromStdString(mapping.time.unit));
  rate_->setValue(mapping.time.rateHz.value_or(0.0));
  fields_->setMapping(mapping);
  filling_ = false;
}

ImportRequest ImportDialog::request() const {
  ImportRequest request;
  request.data = data_->text();
  request.hand = hand_->currentText();
  request.mapping = first_;
  request.mapping.text.delimiter =
      delimiterNamed(delimiter_->currentData().toString().toStdString()).value_or('\0');
  request.mapping.text.decimal = decimal_->currentData().toString() == "," ? ',' : '.';
  request.mapping.text.header = static_cast<HeaderChoice>(header_->currentIndex());
  request.mapping.components = static_cast<ComponentOrder>(components_->currentIndex());
  request.mapping.time.column = time_->text().trimmed().toStdString();
  request.mapping.time.unit = timeUnit_->currentData().toString().toStdString();
  request.mapping.time.rateHz.reset();
  if (rate_->value() > 0.0) request.mapping.time.rateHz = rate_->value();
  fields_->readInto(request.mapping);
  if (seriesProblem().isEmpty()) request.series = series();
  request.out = out();
  request.strict = strict_->isChecked();
  request.replace = replace_->isChecked();
  return request;
}

// Starts a new preview.
void ImportDialog::look() {
  if (filling_) return;
  looking_.ask(request());
  showProblem();
}

void ImportDialog::take(const ImportLook& look) {
  const bool otherHand = look.hand && (!looked_.hand || looked_.hand->name != look.hand->name);
  looked_ = look;
  if (otherHand) {
    fields_->setHand(*look.hand);
    const SensorLayout& layout = *look.hand->layout;
    static_cast<QFormLayout*>(components_->parentWidget()->layout())
        ->setRowVisible(components_, layout.numReadings() != layout.numCells());
  }
  QString form;
  QString choices;
  QString warnings;
  if (look.preview) {
    const ImportPreview& preview = *look.preview;
    form = QString::fromStdString(preview.form);
    QStringList lines;
    for (const std::string& line : preview.choices) lines << QString::fromStdString(line);
    if (!preview.time.empty()) lines << "time: " + QString::fromStdString(preview.time);
    for (const std::string& note : preview.notes) lines << QString::fromStdString(note);
    if (preview.problem.empty()) {
      lines << sampleText(preview);
      for (const ImportedSeries& series : preview.sample.series)
        lines << QString::fromStdString(series.text());
    }
    choices = inWindowWords(lines.join("\n"));
    if (preview.problem.empty())
      warnings = inWindowWords(QString::fromStdString(preview.sample.lossText()));
    showColumns(preview);
  } else {
    columns_->setRowCount(0);
    columns_->setColumnCount(0);
  }
  form_->setText(form);
  choices_->setText(choices);
  warnings_->setText(warnings);
  warnings_->setVisible(!warnings.isEmpty());
  showProblem();
}

void ImportDialog::showColumns(const ImportPreview& preview) {
  const std::size_t shown = preview.rows.empty() ? 0 : preview.rows.front().size();
  columns_->setColumnCount(static_cast<int>(shown));
  columns_->setRowCount(static_cast<int>(preview.rows.size()));
  QStringList names;
  for (std::size_t c = 0; c < shown; ++c) {
    const TableColumn& column = preview.columns[c];
    QString name = QString::fromStdString(column.name);
    if (!column.unit.empty()) name += "\n" + QString::fromStdString(column.unit);
    if (column.numRows) {
      name += "\n" + QString::number(*column.numRows);
      for (const std::size_t size : column.shape) name += " × " + QString::number(size);
    }
    names << name;
  }
  columns_->setHorizontalHeaderLabels(names);
  for (std::size_t r = 0; r < preview.rows.size(); ++r)
    for (std::size_t c = 0; c < shown; ++c)
      columns_->setItem(static_cast<int>(r),
                        static_cast<int>(c),
                        new QTableWidgetItem(QString::fromStdString(preview.rows[r][c])));
}

QString ImportDialog::problem() const {
  if (const QString wrong = fields_->problem(); !wrong.isEmpty()) return wrong;
  if (const QString wrong = seriesProblem(); !wrong.isEmpty()) return wrong;
  if (busy()) return "reading the file";
  if (!looked_.problem.isEmpty()) return looked_.problem;
  const QString out = this->out();
  if (out.isEmpty()) return "choose where to save the recording";
  if (!out.endsWith(".palpate", Qt::CaseInsensitive))
    return "an import is saved as .palpate: change the ending of the name";
  const QFileInfo file(out);
  if (!file.absoluteDir().exists())
    return file.absolutePath() + " does not exist: choose another folder";
  if (file.exists() && !replace_->isChecked())
    return file.fileName() + " exists already: replace it, or choose another name";
  return {};
}

void ImportDialog::showProblem() {
  const QString text = problem();
  problem_->setText(inWindowWords(text));
  ok_->setEnabled(text.isEmpty());
  replace_->setVisible(QFileInfo::exists(out()));
}

void ImportDialog::accept() {
  showProblem();
  if (problem().isEmpty()) QDialog::accept();
}

}  // namespace palpate::gui
