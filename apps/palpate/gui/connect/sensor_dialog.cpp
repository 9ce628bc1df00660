#include "gui/connect/sensor_dialog.h"

#include <QFontDatabase>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <utility>

#include "gui/connect/sensor_rows.h"
#include "gui/connect/source_field.h"
#include "gui/source/abandonable.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr int kSensorRowsEveryMs = 250;
constexpr int kSensorLines = 7;  // the state, the columns, five rows

}  // namespace

SensorDialog::SensorDialog(const Sensor& proposal,
                           QStringList taken,
                           PortScan& scan,
                           QWidget* parent)
    : QDialog(parent), taken_(std::move(taken)) {
  setWindowTitle("Add a sensor");
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  name_ = named(new QLineEdit(proposal.name, this),
                "sensorName",
                "A small letter, then small letters, digits and _: wrench");
  form->addRow("&Name", name_);
  source_ = new SourceField("sensor", scan, this);
  source_->addPlaceTo(*form);
  source_->addBaudTo(*form);
  columns_ = named(new QLineEdit(proposal.columns, this),
                   "sensorColumns",
                   "Names of the numbers of a line, if no header line gives them; a column time_ms "
                   "is the sensor's clock");
  columns_->setPlaceholderText("from the header line, or fx [N], fy [N]");
  form->addRow("&Columns", columns_);
  look_ = makeButton(this, "sensorLook", "Show &what arrives");
  look_->setCheckable(true);
  rows_ = makeLines(this, "sensorRows");
  rows_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  rows_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  rows_->setMinimumHeight(kSensorLines * rows_->fontMetrics().lineSpacing());
  problem_ = makeLines(this, "sensorProblem", "problem");
  add_ = makeOk(this, "sensorAdd", "Add");
  auto* cancel = makeCancel(this, "sensorCancel");
  auto* page = inColumn({form, inRow({look_, Stretch{}}), {rows_, 1}}, around(Space::kDialog));
  setLayout(inColumn({{page, 1}, makeDialogFoot(inRow({{problem_, 1}, cancel, add_}, kFootEdges))},
                     Space::kNone));

  source_->setSource(proposal.source, proposal.baud);
  connect(add_, &QPushButton::clicked, this, &QDialog::accept);
  connect(look_, &QPushButton::toggled, this, &SensorDialog::showRows);
  connect(source_, &SourceField::changed, this, &SensorDialog::refresh);
  for (QLineEdit* line : {name_, columns_})
    connect(line, &QLineEdit::textChanged, this, &SensorDialog::refresh);
  timer_.setInterval(kSensorRowsEveryMs);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (preview_) rows_->setText(preview_->text());
  });
  refresh();
}

SensorDialog::~SensorDialog() {
  // A field that has the keyboard emits when it is destroyed.
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
  endPreview();
}

void SensorDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  source_->look();
}

Sensor SensorDialog::sensor() const {
  return {name_->text().trimmed(), source_->source(), source_->baud(), columns_->text().trimmed()};
}

std::shared_ptr<void> SensorDialog::takePreview() {
  timer_.stop();
  return std::exchange(preview_, nullptr);
}

void SensorDialog::refresh() {
  QString wrong = source_->problem();
  if (wrong.isEmpty()) wrong = problemOf(sensor());
  if (wrong.isEmpty() && taken_.contains(sensor().name))
    wrong = "The name " + sensor().name + " is taken: give the sensor a different one.";
  problem_->setText(wrong);
  add_->setEnabled(wrong.isEmpty());
  // What is read belongs to the fields as they were.
  look_->setChecked(false);
  look_->setEnabled(wrong.isEmpty());
}

void SensorDialog::showRows(bool wanted) {
  endPreview();
  rows_->clear();
  if (!wanted) return;
  try {
    preview_ = std::make_shared<SensorRows>(optionsOf(sensor()));
    rows_->setText(preview_->text());
    timer_.start();
  } catch (const std::exception& failure) {
    problem_->setText(QString::fromUtf8(failure.what()).simplified());
  }
}

// Closing a port may take a moment, for which the window does not wait.
void SensorDialog::endPreview() {
  if (std::shared_ptr<void> preview = takePreview())
    Abandonable::run([preview = std::move(preview)]() mutable { preview.reset(); });
}

}  // namespace palpate::gui
