// Makes files of views: what has to be read in the window's thread is read at once, the rest is
// work for another.
#pragma once

#include <QPicture>
#include <QString>
#include <cstddef>
#include <functional>

#include <palpate/core/progress.h>

#include "gui/export/export_request.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

struct ExportReport {
  QString path;             // the file; of a series its folder
  std::size_t written = 0;  // files
  std::size_t wanted = 1;
  bool cancelled = false;
  QString failure = {};  // one line; empty: none
};
// One line for the user: "written: a.png", "cancelled: 3 of 20 pictures are in ..".
QString textOf(const ExportReport& report);

// What the view shows now, as it will be drawn.
QPicture pictureOf(const ExportedView& view, const PictureLook& look);

// The work of a request, which runs in any thread and never throws.
using ExportWork = std::function<ExportReport(const Progress&)>;
ExportWork prepareExport(const ExportedView& view, const ExportRequest& request);

}  // namespace palpate::gui
