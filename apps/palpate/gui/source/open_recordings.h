// Holds the open recordings, in the order in which they were opened. Several requests may run at
// once; each keeps its purpose (OpenRequest::Then). Knows no widget.
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
    // The first file that can be opened is shown.
    kShowFirst,
    // As kShowFirst, and it plays in a loop.
    kPlayInLoop,
    // The files join the open recordings; the displayed source stays.
    kList,
    // The first file is compared with the displayed recording; the others join the open ones.
    kCompare,
  };
  std::vector<std::filesystem::path> files;
  Then then = Then::kShowFirst;
  // Whether a file that is open already is read again; otherwise its open recording arrives
  // unchanged, unless it was damaged or unfinished: its file may hold more by now.
  bool readAnew = true;
  bool operator==(const OpenRequest&) const = default;
};

// Tells to which request an opened recording belongs.
struct OpenArrival {
  OpenRequest::Then then = OpenRequest::Then::kShowFirst;
  // Index among the files of its request that could be opened.
  std::size_t place = 0;
  // The earlier recording of the same file, which this one replaces; null: the file wasn't open, or
  // its recording stays.
  OpenedRecordingPtr replaced;
};

class OpenRecordings : public QObject {
  Q_OBJECT
 public:
  explicit OpenRecordings(RecordingOpener& opener, QObject* parent = nullptr);

  // Opens the files in the background; arrived() follows for each file that can be opened. A
  // request that is equal to one whose files are still being read (a key pressed twice) is ignored.
  void open(const OpenRequest& request);
  // Closes a recording and returns the one to show instead: the next one, else the last; null: none
  // is left.
  OpenedRecordingPtr close(const OpenedRecordingPtr& recording);

  const std::vector<OpenedRecordingPtr>& all() const noexcept { return all_; }
  // The recording of this file, also when it was opened by another path (a link, a relative path).
  // Null: the file isn't open.
  OpenedRecordingPtr at(const std::filesystem::path& path) const;
  // The recording `step` places after `of`, cyclically; null when `of` isn't open.
  OpenedRecordingPtr neighbour(const OpenedRecordingPtr& of, int step) const;

  // An open file is read again only if mayReadAnew() allows it, and its recording is replaced only
  // if mayReplace() still allows it after reading: it may have unsaved events. Otherwise the open
  // recording arrives unchanged. Empty functions allow everything.
  std::function<bool(const OpenedRecordingPtr&)> mayReadAnew;
  std::function<bool(const OpenedRecordingPtr&)> mayReplace;

 signals:
  void arrived(const palpate::gui::OpenedRecordingPtr& recording,
               const palpate::gui::OpenArrival& arrival);
  // A file was asked for by another path than that by which it is open: the open recording arrived
  // unchanged.
  void openAlready(const palpate::gui::OpenedRecordingPtr& recording,
                   const std::filesystem::path& asked);
  // The recording was closed or is about to be replaced by the present content of its file: drop
  // everything stored for it.
  void gone(const palpate::gui::OpenedRecordingPtr& recording);
  // All requested files have arrived or failed.
  void settled();

 private:
  struct Running {
    OpenRequest request = {};
    std::size_t numArrived = 0;
  };
  void take(const OpenedRecordingPtr& recording, std::uint64_t ticket);
  void arriveAgain(const OpenedRecordingPtr& known,
                   const std::filesystem::path& asked,
                   Running& running);
  void arrive(const OpenedRecordingPtr& recording, OpenedRecordingPtr replaced, Running& running);

  RecordingOpener& opener_;
  std::vector<OpenedRecordingPtr> all_;
  // The requests by the ticket of the opener.
  std::map<std::uint64_t, std::shared_ptr<Running>> running_;
};

}  // namespace palpate::gui
