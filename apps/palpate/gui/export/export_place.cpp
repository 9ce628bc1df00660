#include "gui/export/export_place.h"

#include <QDir>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include "gui/desktop/ask.h"
#include "gui/source/recording_settings.h"
#include "gui/widgets/make.h"

namespace palpate::gui {

ExportPlace::ExportPlace(int labelWidth, Ask& ask, QWidget* parent) : QWidget(parent), ask_(ask) {
  // Most file systems allow 255 bytes, of which the ending needs some.
  constexpr int kMaxLetters = 200;
  name_ = named(new QLineEdit(this), "exportName");
  name_->setMaxLength(kMaxLetters);
  ending_ = makeLabel(this, "exportEnding");
  folder_ = named(new QLineEdit(this), "exportFolder");
  auto* browseButton = makeButton(this, "exportBrowse", "&Browse…");
  connect(browseButton, &QPushButton::clicked, this, &ExportPlace::browse);
  const auto line = [labelWidth](const QString& title, QLineEdit* field, QWidget* beside) {
    auto* label = makeTitle(title, field);
    label->setFixedWidth(labelWidth);
    // The same spacing as in a form.
    return inRow({label, Space::kNarrow, {field, 1}, beside});
  };
  setLayout(inColumn({line("&Name", name_, ending_), line("F&older", folder_, browseButton)},
                     {.top = Space::kWide}));
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
