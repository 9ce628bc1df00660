#include "gui/connect/replay_page.h"

#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>

#include "gui/desktop/ask.h"
#include "gui/widgets/make.h"
#include "gui/widgets/state_mark.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui {

ReplayPage::ReplayPage(const QStringList& recent, Ask& ask, QWidget* parent) : QWidget(parent) {
  path_ = named(new QComboBox(this), "recording");
  path_->setEditable(true);
  path_->setInsertPolicy(QComboBox::NoInsert);
  path_->setCompleter(nullptr);
  path_->setItemDelegate(new TwoLineDelegate(path_));
  path_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  path_->setMinimumContentsLength(30);
  path_->lineEdit()->setPlaceholderText("a recording (.palpate, .dsa)");
  for (const QString& path : recent) {
    path_->addItem(path);
    const bool there = QFileInfo(path).isFile();
    path_->setItemData(path_->count() - 1,
                       QFileInfo(path).fileName() + (there ? "" : " · missing"),
                       TwoLineDelegate::kDetailRole);
  }
  path_->setCurrentIndex(-1);
  auto* browse = makeButton(this, "browseRecording", "Bro&wse…");
  mark_ = new StateMark(this);
  state_ = makeLines(this, "recordingState", "muted");
  auto* what = makeLines(
      this,
      {},
      "muted",
      "Its frames are played at their recorded times, as if they came from a hand: views, filters "
      "and alarms work the same. Nothing moves.");
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(7);
  grid->setVerticalSpacing(4);
  grid->addWidget(makeTitle("Recordin&g", path_), 0, 0, 1, 3);
  grid->addWidget(path_, 1, 0, 1, 2);
  grid->addWidget(browse, 1, 2);
  grid->addWidget(mark_, 2, 0, Qt::AlignTop);
  grid->addWidget(state_, 2, 1, 1, 2);
  grid->setRowMinimumHeight(3, 10);
  grid->addWidget(what, 4, 0, 1, 3);
  grid->setRowStretch(5, 1);
  grid->setColumnStretch(1, 1);
  connect(path_, &QComboBox::editTextChanged, this, &ReplayPage::refresh);
  connect(browse, &QPushButton::clicked, this, [this, &ask] {
    const QString chosen =
        ask.file("Choose a recording",
                 QFileInfo(recording()).path(),
                 "Recordings (*.palpate *.dsa *.h5 *.hdf5 *.mcap);;All files (*)");
    if (!chosen.isEmpty()) setRecording(chosen);
  });
  refresh();
}

ReplayPage::~ReplayPage() { path_->disconnect(this); }

void ReplayPage::setRecording(const QString& path) {
  path_->setEditText(path);
  refresh();
}

QString ReplayPage::recording() const {
  const QString text = path_->currentText().trimmed();
  return text.startsWith("~/") ? QDir::homePath() + text.mid(1) : text;
}

QString ReplayPage::problem() const {
  if (recording().isEmpty()) return {};
  const QFileInfo file(recording());
  if (file.isDir()) return "This is a folder: choose a recording in it.";
  if (!file.exists()) return "This file doesn't exist.";
  if (!file.isFile()) return "This isn't a file.";
  if (!file.isReadable()) return "You have no permission to read this file.";
  if (file.size() == 0) return "This file is empty.";
  return {};
}

void ReplayPage::refresh() {
  const QString fault = problem();
  if (recording().isEmpty()) {
    mark_->setState(StateMark::State::kNone);
    state_->setText("Choose one of the last recordings, or browse for another.");
  } else {
    mark_->setState(fault.isEmpty() ? StateMark::State::kGood : StateMark::State::kBad);
    const QFileInfo file(recording());
    state_->setText(fault.isEmpty()
                        ? QString("%1, %2").arg(file.fileName(),
                                                QLocale::c().formattedDataSize(
                                                    file.size(), 1, QLocale::DataSizeSIFormat))
                        : fault);
  }
  emit changed();
}

}  // namespace palpate::gui
