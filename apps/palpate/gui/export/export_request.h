// What shall be written: which view, in which form and size, under which name. As it is asked for
// and remembered.
#pragma once

#include <QSettings>
#include <QSizeF>
#include <QString>
#include <array>
#include <filesystem>

#include <palpate/capture/movie_timing.h>
#include <palpate/core/file_series.h>

#include "gui/picture/exported_view.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {

enum class ExportFormat { kPng, kSvg, kPdf, kCsv, kMovie };
inline constexpr std::array kAllExportForms = {ExportFormat::kPng,
                                               ExportFormat::kSvg,
                                               ExportFormat::kPdf,
                                               ExportFormat::kMovie,
                                               ExportFormat::kCsv};
QString nameOf(ExportFormat form);         // "PNG", "MP4"; also the key in the settings
QString endingOf(ExportFormat form);       // ".png"
QString descriptionOf(ExportFormat form);  // "A drawing that can be edited"

enum class ExportFrames { kShown, kSelected, kAll };

// Sizes that journals and slides ask for.
struct PaperPreset {
  const char* name;
  double widthMm;   // 0: as on screen
  double heightMm;  // 0: in proportion to the view
  double textPt;    // 0: as on screen
};
inline constexpr std::array kPaperPresets = {PaperPreset{"as on screen", 0.0, 0.0, 0.0},
                                             PaperPreset{"single column, 85 mm", 85.0, 0.0, 7.0},
                                             PaperPreset{"one and a half, 114 mm", 114.0, 0.0, 7.0},
                                             PaperPreset{"double column, 174 mm", 174.0, 0.0, 8.0},
                                             PaperPreset{"slide 16:9", 254.0, 143.0, 16.0},
                                             PaperPreset{"own size", 120.0, 90.0, 8.0}};
inline constexpr int kScreenPreset = 0;
inline constexpr int kOwnPreset = static_cast<int>(kPaperPresets.size()) - 1;
inline constexpr std::array kExportDpi = {150, 300, 600};
inline constexpr std::array kMovieSpeeds = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0};
inline constexpr std::array kMovieRates = {24, 25, 30, 50, 60};            // pictures per second
inline constexpr std::array kMovieHeights = {480, 720, 1080, 1440, 2160};  // [px]

struct ExportRequest {
  QString view;  // ExportedView::name
  ExportFormat form = ExportFormat::kPng;
  int preset = kScreenPreset;  // index into kPaperPresets
  QSizeF sizeMm{120.0, 90.0};  // unless as on screen
  double textPt = 8.0;         // unless as on screen; in halves
  int dpi = 300;               // of PNG
  bool forPrint = true;        // white ground and dark ink
  bool titled = true;          // a line that says what of
  ExportFrames frames = ExportFrames::kShown;
  double movieSpeed = 1.0;     // of kMovieSpeeds; 1: as long as it took
  int moviePicturesPerS = 30;  // of kMovieRates
  int movieHeightPx = 1080;    // of kMovieHeights; its width is in proportion
  QString table = {};          // ExportedTable::name; unknown: the first
  QString folder = {};         // whole path
  QString name = {};           // without folder and ending
  bool nameIsOwn = false;      // chosen by hand: kept when the frame changes
  bool replace = false;        // files that are there already; never remembered

  bool isSeries() const noexcept {
    return form == ExportFormat::kPng && frames != ExportFrames::kShown;
  }
  bool isMovie() const noexcept { return form == ExportFormat::kMovie; }
  // Of frames: selected or all ones.
  bool ofFrames() const noexcept { return isSeries() || isMovie(); }
  bool operator==(const ExportRequest&) const = default;
};

// A settings file never stops the program: what makes no sense there is replaced by the defaults.
ExportRequest loadExportRequest(const QSettings& settings);
void saveExportRequest(const ExportRequest& request, QSettings& settings);

// What the picture of a view of that size [px on screen] is painted on, and how.
PicturePaper paperOf(const ExportRequest& request, const QSizeF& sizeOnScreen);
PictureLook lookOf(const ExportRequest& request, const QSizeF& sizeOnScreen);

// Where one file goes; for a series its folder, which lies in request.folder and has the request's
// name.
std::filesystem::path pathOf(const ExportRequest& request);
FileSeries seriesOf(const ExportRequest& request, const FrameSpan& span);
// Which frames are asked for; nothing when they aren't there (no selection, no frame). A movie of
// the one that is shown would be none: it is of the selected ones, else of all.
std::optional<FrameSpan> spanOf(const ExportRequest& request, const FramePictures& pictures);

// How the movie's pictures lie in time.
MovieOptions movieOptionsOf(const ExportRequest& request);
// What a file of this view is called, when the user doesn't say.
QString suggestedName(const ExportRequest& request, const ExportedView& view);

// Why there can't be a movie of the view now; empty: there can.
QString movieProblem(const ExportedView& view);
// What stands in the way, in one line that says what to do; empty: nothing. Looks at the disk.
QString problemOf(const ExportRequest& request, const ExportedView& view);
// Whether so many bytes don't fit on its disk; empty: they do.
QString spaceProblemOf(const ExportRequest& request, double bytes);

// "142 kB", "1.3 MB"
QString bytesText(double bytes);

}  // namespace palpate::gui
