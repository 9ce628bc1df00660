#include "gui/export_place.h"

#include <QDir>
#include <QFileDialog>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include "gui/recording_settings.h"

namespace palpate::gui {

ExportPlace::ExportPlace(int labelWidth, QWidget* parent) : QWidget(parent) {
  constexpr int kMostLetters = 200;  // a file system takes 255 bytes, and an ending comes behind
  askForFolder = [this](const QString& begin) {
    return QFileDialog::getExistingDirectory(this, "Folder to export to", begin);
  };
  name_ = new QLineEdit(this);
  name_->setObjectName("exportName");
  name_->setMaxLength(kMostLetters);
  ending_ = new QLabel(this);
  ending_->setObjectName("exportEnding");
  ending_->setTextFormat(Qt::PlainText);
  folder_ = new QLineEdit(this);
  folder_->setObjectName("exportFolder");
  auto* browseButton = new QPushButton("&Browse…", this);
  browseButton->setObjectName("exportBrowse");
  browseButton->setAutoDefault(false);
  connect(browseButton, &QPushButton::clicked, this, &ExportPlace::browse);
  auto* nameLabel = new QLabel("&Name", this);
  nameLabel->setBuddy(name_);
  auto* folderLabel = new QLabel("F&older", this);
  folderLabel->setBuddy(folder_);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 10, 0, 0);
  grid->setHorizontalSpacing(12);
  grid->setVerticalSpacing(8);
  grid->setColumnMinimumWidth(0, labelWidth);
  grid->addWidget(nameLabel, 0, 0);
  grid->addWidget(name_, 0, 1);
  grid->addWidget(ending_, 0, 2);
  grid->addWidget(folderLabel, 1, 0);
  grid->addWidget(folder_, 1, 1);
  grid->addWidget(browseButton, 1, 2);
  connect(name_, &QLineEdit::textEdited, this, [this] { nameIsOwn_ = !name_->text().isEmpty(); });
  for (QLineEdit* field : {name_, folder_})
    connect(field, &QLineEdit::textChanged, this, &ExportPlace::changed);
}

void ExportPlace::setName(const QString& name, bool isOwn) {
  nameIsOwn_ = isOwn;
  name_->setText(name);
}

void ExportPlace::suggestName(const QString& name) {
  if (!nameIsOwn_) name_->setText(name);
}

void ExportPlace::setFolder(const QString& folder) { folder_->setText(folder); }

void ExportPlace::setEnding(const QString& ending) { ending_->setText(ending); }

QString ExportPlace::name() const { return name_->text().trimmed(); }

QString ExportPlace::folder() const { return folderFromText(folder_->text()); }

void ExportPlace::browse() {
  // From where the folder is, or was.
  QDir begin(folder());
  while (!begin.exists() && begin.isAbsolute() && !begin.isRoot())
    begin.setPath(begin.filePath(".."));
  const QString chosen =
      askForFolder(begin.isAbsolute() ? QDir::cleanPath(begin.path()) : QDir::homePath());
  if (!chosen.isEmpty()) folder_->setText(chosen);
}

}  // namespace palpate::gui
