#include "gui/open/session_keeper.h"

#include <QFileInfo>
#include <algorithm>

#include "gui/look/path_text.h"
#include "gui/source/session.h"

namespace palpate::gui {

void rememberSession(Bench& bench) {
  Subject& subject = bench.subject;
  subject.noteWhereWeAre();
  Session session;
  for (const OpenedRecordingPtr& recording : bench.recordings.all()) {
    if (recording->path == bench.demoRecording()) continue;
    if (recording == subject.behind()) session.current = static_cast<int>(session.files.size());
    const LeftAt* left = subject.leftAt(recording->path);
    session.files.push_back(
        {QFileInfo(pathText(recording->path)).absoluteFilePath(), left ? *left : LeftAt()});
  }
  saveSession(session, bench.settings);
}

void restoreSession(Bench& bench) {
  const Session session = loadSession(bench.settings);
  std::vector<std::filesystem::path> files;
  QStringList missing;
  for (const Session::File& file : session.files) {
    const std::filesystem::path path = file.path.toStdString();
    if (!RecentFiles::exists(file.path)) {
      missing.append(QFileInfo(file.path).fileName());
      continue;
    }
    bench.subject.setLeftAt(path, file.leftAt);
    files.push_back(path);
    // The first that can be opened is shown: that is the one that was.
    if (session.current >= 0 && &file == &session.files[static_cast<std::size_t>(session.current)])
      std::rotate(files.begin(), files.end() - 1, files.end());
  }
  bench.open(files);
  if (!missing.isEmpty())
    bench.messages.fail("Open last time, and not there any more: " + missing.join(", "));
}

}  // namespace palpate::gui
