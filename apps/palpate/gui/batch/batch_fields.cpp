#include "gui/batch/batch_fields.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <algorithm>
#include <utility>
#include <vector>

#include <palpate/recording/recording.h>
#include <palpate/slip/slip_method.h>

#include "gui/batch/batch_pictures.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

QComboBox* batchComboBox(const char* name, const std::vector<std::pair<QString, QString>>& items) {
  auto* box = named(new QComboBox, name);
  // A long item must not widen the dialog.
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(10);
  for (const auto& [text, value] : items) box->addItem(text, value);
  return box;
}

QCheckBox* batchCheckBox(const char* name, const QString& text, const QString& tip = {}) {
  return named(new QCheckBox(text), name, tip);
}

QDoubleSpinBox* limitBox(const char* name, double least, double most, const QString& tip) {
  auto* box = named(new QDoubleSpinBox, name, tip, tip);
  box->setRange(least, most);
  box->setDecimals(3);
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);
  return box;
}

std::vector<std::pair<QString, QString>> formItems() {
  std::vector<std::pair<QString, QString>> items;
  for (const RecordingFormat* format : recordingFormats())
    for (const char* ending : format->endings)
      items.emplace_back(QString("%1: %2").arg(ending, format->purpose), ending + 1);
  return items;
}

std::vector<std::pair<QString, QString>> mapItems() {
  std::vector<std::pair<QString, QString>> items;
  for (const ColorMapName map : kAllColorMaps) items.emplace_back(nameOf(map), nameOf(map));
  return items;
}

std::vector<std::pair<QString, QString>> methodItems() {
  std::vector<std::pair<QString, QString>> items;
  for (const SlipMethod method : slipMethods()) {
    const QString name = QString::fromStdString(std::string(nameOf(method)));
    items.emplace_back(name, name);
  }
  return items;
}

void chooseBatchValue(QComboBox& box, const QString& value) {
  box.setCurrentIndex(std::max(0, box.findData(value)));
}

}  // namespace

BatchFields::BatchFields(QWidget* parent)
    : QWidget(parent), windowFilters([] { return QString(); }), form_(new QFormLayout(this)) {
  form_->setContentsMargins(0, 0, 0, 0);
  form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  work_ = batchComboBox("batchWork",
                        {{"convert: recordings in another format", "convert"},
                         {"signals: a table of each matrix over time", "signals"},
                         {"slip: a table of how contacts move", "slip"},
                         {"features: a table of the grasps", "features"},
                         {"render: a picture or a movie", "render"}});
  picture_ = batchComboBox("batchPicture",
                           {{".png: the frame of the largest sum, pixels", "png"},
                            {".svg: the frame of the largest sum, vectors", "svg"},
                            {".pdf: the frame of the largest sum, vectors", "pdf"},
                            {".mp4: a movie of all frames", "mp4"}});
  map_ = batchComboBox("batchMap", mapItems());
  speed_ = limitBox(
      "batchSpeed", kMinBatchSpeed, kMaxBatchSpeed, "Speed of the movie; 1: as it was recorded");
  speed_->setDecimals(2);
  ending_ = batchComboBox("batchForm", formItems());
  table_ = batchComboBox("batchTableForm",
                         {{".csv: text for spreadsheets", "csv"},
                          {".json: text with units and meanings", "json"},
                          {".npz: arrays for NumPy", "npz"},
                          {".mat: a structure for MATLAB and Octave", "mat"},
                          {".h5: data sets with units and meanings", "h5"},
                          {".mcap: messages for Foxglove", "mcap"}});
  filtersRow_ = makeFilters();
  smooth_ = named(new QLineEdit, "batchSmooth", "Filters over time of the signals themselves");
  smooth_->setPlaceholderText("none; e.g. kalman:q=0.05");
  matrix_ = named(new QSpinBox, "batchMatrix");
  matrix_->setRange(-1, kMaxBatchMatrix);
  matrix_->setSpecialValueText("all");
  matrix_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  method_ = batchComboBox("batchMethod", methodItems());
  reference_ = batchComboBox("batchReference", {{"first", "first"}, {"rest", "rest"}});
  reference_->setEditable(true);
  reference_->setToolTip(
      "first: the first frame with an active taxel; rest: each contact when it rests; or the "
      "number of a frame");
  limits_ = makeLimits();
  set_ = batchComboBox("batchSet",
                       {{"default of the hand", ""},
                        {"best", "best"},
                        {"study", "study"},
                        {"session", "session"},
                        {"statistics", "statistics"}});
  eachGrasp_ = batchCheckBox("batchEachGrasp",
                             "A file for eac&h grasp",
                             "Its names contain {n}, the number of the grasp; labels are copied");
  interpolated_ = batchCheckBox("batchInterpolated", "Smooth between &taxels");
  values_ = batchCheckBox("batchValues", "The &value of each active taxel");
  segments_ = batchCheckBox("batchSegments", "A row per sl&ip instead of one per frame");
  signals_ = batchCheckBox("batchSignals", "With the characteristic &signals");
  slip_ = batchCheckBox("batchSlip", "With the sl&ip");
  unitsRow_ = batchCheckBox("batchUnitsRow", "A second row with the &units");
  form_->addRow("&Make", work_);
  form_->addRow("F&ormat", ending_);
  form_->addRow("F&ormat", table_);
  form_->addRow("F&ormat", picture_);
  form_->addRow("Colour ma&p", map_);
  form_->addRow("Mov&ie speed", speed_);
  form_->addRow("Fi&lters", filtersRow_);
  form_->addRow("Smoo&th", smooth_);
  form_->addRow("Matri&x", matrix_);
  form_->addRow("Met&hod", method_);
  form_->addRow("Refere&nce", reference_);
  form_->addRow("Limits", limits_);
  form_->addRow("Featur&es", set_);
  for (QCheckBox* box : {eachGrasp_, interpolated_, values_, segments_, signals_, slip_, unitsRow_})
    form_->addRow("", box);
  const auto changed = [this] {
    showFields();
    emit edited();
  };
  for (QComboBox* box : {work_, ending_, table_, picture_, map_, method_, set_})
    connect(box, &QComboBox::currentIndexChanged, this, changed);
  connect(reference_, &QComboBox::currentTextChanged, this, changed);
  for (QLineEdit* field : {filters_, smooth_})
    connect(field, &QLineEdit::textChanged, this, changed);
  connect(matrix_, &QSpinBox::valueChanged, this, changed);
  for (QDoubleSpinBox* box : {speed_, step_, limit_, rotation_})
    connect(box, &QDoubleSpinBox::valueChanged, this, changed);
  for (QCheckBox* box : {eachGrasp_, interpolated_, values_, segments_, signals_, slip_, unitsRow_})
    connect(box, &QCheckBox::toggled, this, changed);
  // Before the layouts around it ask for its height: that of the rows that are seen.
  showFields();
}

QWidget* BatchFields::makeFilters() {
  filters_ = named(new QLineEdit, "batchFilters");
  filters_->setPlaceholderText("none; as median:size=3 | kalman");
  auto* take = makeButton(
      nullptr, "batchTakeFilters", "As sho&wn", "The filters currently applied in the window");
  connect(take, &QPushButton::clicked, this, [this] { filters_->setText(windowFilters()); });
  auto* row = makeBox(inRow({{filters_, 1}, take}));
  row->setFocusProxy(filters_);
  return row;
}

QWidget* BatchFields::makeLimits() {
  step_ = limitBox("batchStep", kMinBatchTaxels, kMaxBatchTaxels, "Threshold per frame [taxels]");
  limit_ = limitBox(
      "batchLimit", kMinBatchTaxels, kMaxBatchTaxels, "Threshold since the reference [taxels]");
  rotation_ = limitBox("batchRotation", kMinBatchDeg, kMaxBatchDeg, "Threshold of turning [deg]");
  rotation_->setSuffix("°");
  return makeBox(inRow({{step_, 1}, {limit_, 1}, {rotation_, 1}}));
}

void BatchFields::fill(const BatchChoices& choices) {
  const QSignalBlocker quiet(this);
  work_->setCurrentIndex(static_cast<int>(choices.work));
  chooseBatchValue(*ending_, choices.form);
  chooseBatchValue(*table_, choices.table);
  chooseBatchValue(*picture_, choices.picture);
  chooseBatchValue(*map_, choices.map);
  speed_->setValue(choices.speed);
  eachGrasp_->setChecked(choices.eachGrasp);
  interpolated_->setChecked(choices.interpolated);
  values_->setChecked(choices.printedValues);
  filters_->setText(choices.filters);
  smooth_->setText(choices.smooth);
  matrix_->setValue(choices.matrix);
  chooseBatchValue(*method_, choices.method);
  reference_->setCurrentText(choices.reference);
  segments_->setChecked(choices.segments);
  step_->setValue(choices.stepTaxels);
  limit_->setValue(choices.limitTaxels);
  rotation_->setValue(choices.rotationDeg);
  chooseBatchValue(*set_, choices.featureSet);
  signals_->setChecked(choices.withSignals);
  slip_->setChecked(choices.withSlip);
  unitsRow_->setChecked(choices.unitsRow);
  showFields();
}

void BatchFields::readInto(BatchChoices& choices) const {
  choices.work = static_cast<BatchWork>(work_->currentIndex());
  choices.form = ending_->currentData().toString();
  choices.table = table_->currentData().toString();
  choices.picture = picture_->currentData().toString();
  choices.map = map_->currentData().toString();
  choices.speed = speed_->value();
  choices.eachGrasp = eachGrasp_->isChecked();
  choices.interpolated = interpolated_->isChecked();
  choices.printedValues = values_->isChecked();
  choices.filters = filters_->text().trimmed();
  choices.smooth = smooth_->text().trimmed();
  choices.matrix = matrix_->value();
  choices.method = method_->currentData().toString();
  choices.reference = reference_->currentText().trimmed();
  choices.segments = segments_->isChecked();
  choices.stepTaxels = step_->value();
  choices.limitTaxels = limit_->value();
  choices.rotationDeg = rotation_->value();
  choices.featureSet = set_->currentData().toString();
  choices.withSignals = signals_->isChecked();
  choices.withSlip = slip_->isChecked();
  choices.unitsRow = unitsRow_->isChecked();
}

void BatchFields::showFields() {
  BatchChoices now;
  readInto(now);
  const bool ofSlip = now.work == BatchWork::kSlip;
  form_->setRowVisible(ending_, now.work == BatchWork::kConvert);
  form_->setRowVisible(table_, makesTables(now));
  const bool drawn = now.work == BatchWork::kRender;
  form_->setRowVisible(picture_, drawn);
  form_->setRowVisible(map_, drawn);
  form_->setRowVisible(speed_, drawn && now.picture == "mp4");
  form_->setRowVisible(eachGrasp_, now.work == BatchWork::kConvert);
  form_->setRowVisible(interpolated_, drawn);
  form_->setRowVisible(values_, drawn);
  form_->setRowVisible(filtersRow_, usesFilters(now));
  form_->setRowVisible(smooth_, now.work == BatchWork::kSignals);
  form_->setRowVisible(matrix_, usesMatrix(now));
  form_->setRowVisible(method_, ofSlip);
  form_->setRowVisible(reference_, ofSlip);
  form_->setRowVisible(limits_, ofSlip);
  form_->setRowVisible(set_, now.work == BatchWork::kFeatures);
  form_->setRowVisible(segments_, ofSlip);
  form_->setRowVisible(signals_, usesSeries(now));
  form_->setRowVisible(slip_, usesSeries(now));
  form_->setRowVisible(unitsRow_, usesUnitsRow(now));
  updateGeometry();
}

}  // namespace palpate::gui
