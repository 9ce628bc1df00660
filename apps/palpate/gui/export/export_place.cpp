#include "gui/export/export_place.h"

#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "gui/desktop/ask.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {

ExportPlace::ExportPlace(int labelWidth, Ask& ask, QWidget* parent) : QWidget(parent), ask_(ask) {
  // Most file systems allow 255 bytes, of which the ending needs some.
  constexpr int kMostLetters = 200;
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
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 10, 0, 0);
  column->setSpacing(8);
  const auto add = [&](QLabel* label, QLineEdit* field, QWidget* beside) {
    label->setFixedWidth(labelWidth);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    row->addWidget(label);
    // The same spacing as in a form.
    row->addSpacing(4);
    row->addWidget(field, 1);
    row->addWidget(beside);
    column->addLayout(row);
  };
  add(nameLabel, name_, ending_);
  add(folderLabel, folder_, browseButton);
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
  // Starts at the folder or, if it does not exist, at its nearest existing parent.
  QDir begin(folder());
  while (!begin.exists() && begin.isAbsolute() && !begin.isRoot())
    begin.setPath(QFileInfo(begin.path()).path());
  const QString chosen =
      ask_.folder("Folder to export to", begin.isAbsolute() ? begin.path() : QDir::homePath());
  if (!chosen.isEmpty()) folder_->setText(chosen);
}

}  // namespace palpate::gui
