// What was open when the window was closed, and where the user was in it.
#pragma once

#include <QSettings>
#include <QString>
#include <cstddef>
#include <optional>
#include <vector>

#include <palpate/model/time_span.h>

namespace palpate::gui {

// Where a recording was left.
struct ViewPosition {
  std::size_t frame = 0;
  std::optional<TimeSpan> seen;  // nothing: the whole
  std::optional<TimeSpan> selection;
  bool operator==(const ViewPosition&) const = default;
};

struct Session {
  struct File {
    QString path;
    ViewPosition viewPosition;
    bool operator==(const File&) const = default;
  };
  static constexpr int kMaxFiles = 50;
  std::vector<File> files;
  int current = -1;  // index; -1: none was shown
  bool operator==(const Session&) const = default;
};

// What makes no sense in the settings is left out.
Session loadSession(QSettings& settings);
void saveSession(const Session& session, QSettings& settings);

}  // namespace palpate::gui
