// The recordings that were open when the window was closed, and the position in each; loaded from
// the settings at the next start.
#pragma once

#include <QSettings>
#include <QString>
#include <cstddef>
#include <optional>
#include <vector>

#include <palpate/model/timing.h>

namespace palpate::gui {

// Position at which the user left a recording.
struct ViewPosition {
  std::size_t frame = 0;
  // Visible span; nothing: the whole recording.
  std::optional<TimeSpan> seen;
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
  // Index of the displayed file; -1: none was shown.
  int current = -1;
  bool operator==(const Session&) const = default;
};

// Entries of the settings that make no sense are left out.
Session loadSession(QSettings& settings);
void saveSession(const Session& session, QSettings& settings);

}  // namespace palpate::gui
