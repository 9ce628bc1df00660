#include "gui/export/export_movie_fields.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <algorithm>

#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr int kExportMovieFieldsFieldHeight = 28;  // [px]

QComboBox* exportMovieFieldsComboBox(const char* name) {
  auto* box = named(new QComboBox, name);
  box->setMinimumHeight(kExportMovieFieldsFieldHeight);
  return box;
}

void chooseValue(QComboBox* box, const QVariant& value) {
  box->setCurrentIndex(std::max(0, box->findData(value)));
}

}  // namespace

ExportMovieFields::ExportMovieFields(QFormLayout& form)
    : QObject(form.parentWidget()), form_(form) {
  speed_ = exportMovieFieldsComboBox("exportSpeed");
  speed_->setToolTip("1× is the recorded speed. Gaps are shown as one second.");
  for (const double speed : kMovieSpeeds) speed_->addItem(QString("%1×").arg(speed), speed);
  rate_ = exportMovieFieldsComboBox("exportRate");
  rate_->setAccessibleName("Pictures per second");
  for (const int rate : kMovieRates) rate_->addItem(QString("%1 pictures/s").arg(rate), rate);
  pace_ = makeBox(inRow({{speed_, 1}, {rate_, 2}}));
  form.addRow("S&peed", pace_);
  qobject_cast<QLabel*>(form.labelForField(pace_))->setBuddy(speed_);
  height_ = exportMovieFieldsComboBox("exportMovieHeight");
  for (const int height : kMovieHeights)
    height_->addItem(QString("%1 px high").arg(height), height);
  form.addRow("Resol&ution", height_);
  for (QComboBox* box : {speed_, rate_, height_})
    connect(box, &QComboBox::currentIndexChanged, this, &ExportMovieFields::changed);
}

void ExportMovieFields::fill(const ExportRequest& request) {
  chooseValue(speed_, request.movieSpeed);
  chooseValue(rate_, request.moviePicturesPerS);
  chooseValue(height_, request.movieHeightPx);
}

void ExportMovieFields::read(ExportRequest& request) const {
  request.movieSpeed = speed_->currentData().toDouble();
  request.moviePicturesPerS = rate_->currentData().toInt();
  request.movieHeightPx = height_->currentData().toInt();
}

void ExportMovieFields::setVisible(bool on) {
  for (QWidget* field : {pace_, static_cast<QWidget*>(height_)}) {
    field->setVisible(on);
    form_.labelForField(field)->setVisible(on);
  }
}

}  // namespace palpate::gui
