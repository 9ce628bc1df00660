// Prepares the work of an export: reads at once what must be read in the window's thread; the rest
// can run in another thread.
#pragma once

#include <QPicture>
#include <QString>
#include <cstddef>
#include <functional>

#include <palpate/core/progress.h>

#include "gui/export/export_request.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

// The result of an export.
struct ExportReport {
  // The file; for a series its folder.
  QString path;
  // Number of files written.
  std::size_t written = 0;
  std::size_t wanted = 1;
  bool cancelled = false;
  // Why it failed, in one line; empty when it did not.
  QString failure = {};
};
// One line for the user: "written: a.png", "cancelled: 3 of 20 pictures are in ..".
QString textOf(const ExportReport& report);

// Records what the view shows now as a QPicture.
QPicture pictureOf(const ExportedView& view, const PictureLook& look);

// The work of a request; it can run in any thread and never throws.
using ExportWork = std::function<ExportReport(const Progress&)>;
// Reads what the view shows now and returns the remaining work.
ExportWork prepareExport(const ExportedView& view, const ExportRequest& request);

}  // namespace palpate::gui
