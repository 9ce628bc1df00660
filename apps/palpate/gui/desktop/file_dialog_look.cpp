#include "gui/desktop/file_dialog_look.h"

#include <QApplication>
#include <QEvent>
#include <QFileDialog>
#include <QFileSystemModel>
#include <QHeaderView>
#include <QIcon>
#include <QImage>
#include <QPixmap>
#include <QToolButton>
#include <QTreeView>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr int kLargestIcon = 64;  // [px]

QIcon withoutColors(const QIcon& icon) {
  const QPixmap colored = icon.pixmap(kLargestIcon);
  if (colored.isNull()) return icon;
  QImage image = colored.toImage().convertToFormat(QImage::Format_ARGB32);
  for (int y = 0; y < image.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    std::transform(line, line + image.width(), line, [](QRgb pixel) {
      const int grey = qGray(pixel);
      return qRgba(grey, grey, grey, qAlpha(pixel));
    });
  }
  image.setDevicePixelRatio(colored.devicePixelRatio());
  return QIcon(QPixmap::fromImage(image));
}

// Name, size and date; the type is seen by the end of the name.
void fitFileColumns(QFileDialog& dialog) {
  auto* list = dialog.findChild<QTreeView*>("treeView");
  if (!list) return;
  enum Column { kName, kSize, kType, kDate };
  QHeaderView* header = list->header();
  list->setColumnHidden(kType, true);
  header->setStretchLastSection(false);
  const auto fit = [header] {
    header->setSectionResizeMode(kSize, QHeaderView::ResizeToContents);
    header->setSectionResizeMode(kDate, QHeaderView::ResizeToContents);
    header->setSectionResizeMode(kName, QHeaderView::Stretch);
  };
  fit();
  // The name has what sizes and dates leave, which are known once a folder was read.
  if (const auto* files = dialog.findChild<QFileSystemModel*>())
    QObject::connect(files, &QFileSystemModel::directoryLoaded, header, fit, Qt::QueuedConnection);
}

}  // namespace

FileDialogLook::FileDialogLook(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

bool FileDialogLook::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Polish) return false;
  auto* dialog = qobject_cast<QFileDialog*>(watched);
  if (!dialog) return false;
  dialog->setIconProvider(&icons_);
  for (auto* button : dialog->findChildren<QToolButton*>())
    button->setIcon(withoutColors(button->icon()));
  fitFileColumns(*dialog);
  return false;
}

QIcon FileDialogLook::GreyIcons::icon(IconType type) const {
  return withoutColors(QFileIconProvider::icon(type));
}

QIcon FileDialogLook::GreyIcons::icon(const QFileInfo& info) const {
  return withoutColors(QFileIconProvider::icon(info));
}

}  // namespace palpate::gui
