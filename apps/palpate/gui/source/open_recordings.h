// The recordings that are open, in the order in which they came. What files were asked for travels
// with them: several requests may be under way at once, and each keeps what it is for. No widget.
#pragma once

#include <QObject>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "gui/source/opened_recording.h"
#include "gui/source/recording_opener.h"

namespace palpate::gui {

struct OpenRequest {
  enum class Then {
    kShowFirst,   // of the files, the first that can be opened is shown
    kPlayInLoop,  // likewise, and plays
    kList,        // they join the open ones; what is looked at stays
    kCompare,     // the first is compared with what is shown; the others join
  };
  std::vector<std::filesystem::path> files;
  Then then = Then::kShowFirst;
};

// What comes with a recording that was asked for.
struct OpenArrival {
  OpenRequest::Then then = OpenRequest::Then::kShowFirst;
  std::size_t place = 0;  // among those of its request that could be opened; 0: the first
  // the same file as it was open before; null: it wasn't, or stays as it is
  OpenedRecordingPtr replaced;
};

class OpenRecordings : public QObject {
  Q_OBJECT
 public:
  explicit OpenRecordings(RecordingOpener& opener, QObject* parent = nullptr);

  // In the background; arrived() follows for each file that can be opened.
  void open(const OpenRequest& request);
  // What comes in its place: the one behind it, else the last; null: none is left.
  OpenedRecordingPtr close(const OpenedRecordingPtr& recording);

  const std::vector<OpenedRecordingPtr>& all() const noexcept { return all_; }
  OpenedRecordingPtr at(const std::filesystem::path& path) const;  // null: not open
  // `step` places further, around; null where `of` isn't open.
  OpenedRecordingPtr neighbour(const OpenedRecordingPtr& of, int step) const;

  // A file that is open is read anew only where the first says so before, and its recording is
  // replaced only where the second still says so when it was read: there may be something in it
  // that isn't saved. Else it arrives as it is. Empty: always.
  std::function<bool(const OpenedRecordingPtr&)> mayReadAnew;
  std::function<bool(const OpenedRecordingPtr&)> mayReplace;

 signals:
  void arrived(const palpate::gui::OpenedRecordingPtr& recording,
               const palpate::gui::OpenArrival& arrival);
  // Closed, or about to be replaced by what its file holds now: forget what was kept of it.
  void gone(const palpate::gui::OpenedRecordingPtr& recording);
  // All that was asked for has arrived, or failed.
  void settled();

 private:
  struct Running {
    OpenRequest::Then then = OpenRequest::Then::kShowFirst;
    std::size_t numArrived = 0;
  };
  void take(const OpenedRecordingPtr& recording, std::uint64_t ticket);
  void arrive(const OpenedRecordingPtr& recording, OpenedRecordingPtr replaced, Running& request);

  RecordingOpener& opener_;
  std::vector<OpenedRecordingPtr> all_;
  std::map<std::uint64_t, std::shared_ptr<Running>> running_;  // by the opener's ticket
};

}  // namespace palpate::gui
