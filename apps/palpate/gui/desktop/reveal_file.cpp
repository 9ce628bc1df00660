#include "gui/desktop/reveal_file.h"

#include <QDesktopServices>
#include <QFileInfo>
#include <QProcess>
#include <QUrl>

namespace palpate::gui {

// org.freedesktop.FileManager1 (file-manager-interface of freedesktop.org) selects the file.
void revealInFileManager(const QString& path) {
  const QUrl folder = QUrl::fromLocalFile(QFileInfo(path).absolutePath());
  auto* call = new QProcess;
  const auto orFolder = [call, folder](bool shown) {
    call->deleteLater();
    if (!shown) QDesktopServices::openUrl(folder);
  };
  QObject::connect(call, &QProcess::finished, [orFolder](int code, QProcess::ExitStatus status) {
    orFolder(status == QProcess::NormalExit && code == 0);
  });
  QObject::connect(call, &QProcess::errorOccurred, [orFolder](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) orFolder(false);
  });
  // dbus-send would take a comma as the separator of two files.
  const QString url =
      QString::fromLatin1(QUrl::fromLocalFile(path).toEncoded()).replace(',', "%2C");
  call->start("dbus-send",
              {"--session",
               "--print-reply",
               "--dest=org.freedesktop.FileManager1",
               "--type=method_call",
               "/org/freedesktop/FileManager1",
               "org.freedesktop.FileManager1.ShowItems",
               "array:string:" + url,
               "string:"});
}

}  // namespace palpate::gui
