// An export request: which view is written, in which form and size, and under which name. The
// Export dialog edits it; the settings store it.
#pragma once

#include <QSettings>
#include <QSizeF>
#include <QString>
#include <array>
#include <filesystem>
#include <map>
#include <optional>

#include <palpate/core/file_series.h>
#include <palpate/playback/movie_timing.h>

#include "gui/picture/exported_view.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {

// The kinds of files that can be written.
enum class ExportFormat { kPng, kSvg, kPdf, kCsv, kMovie };
inline constexpr std::array kAllExportForms = {ExportFormat::kPng,
                                               ExportFormat::kSvg,
                                               ExportFormat::kPdf,
                                               ExportFormat::kMovie,
                                               ExportFormat::kCsv};
// The name of a form, "PNG" or "MP4"; it is also stored in the settings.
QString nameOf(ExportFormat form);
// The ending of its files, ".png".
QString endingOf(ExportFormat form);
// A description for the user, "A drawing that can be edited".
QString descriptionOf(ExportFormat form);

// Which frames are written: the shown one, those of the selected time span, or all.
enum class ExportFrames { kShown, kSelected, kAll };

// Page sizes that journals and slides require.
struct PaperPreset {
  const char* name;
  double widthMm;   // [mm]; 0: as on screen
  double heightMm;  // [mm]; 0: in proportion to the view
  double textPt;    // [pt]; 0: as on screen
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
inline constexpr std::array kMovieRates = {24, 25, 30, 50, 60};            // [pictures/s]
inline constexpr std::array kMovieHeights = {480, 720, 1080, 1440, 2160};  // [px]

// Ranges of a size on paper [mm], [pt].
inline constexpr double kMinPaperMm = 20.0, kMaxPaperMm = 1200.0;
inline constexpr double kMinTextPt = 4.0, kMaxTextPt = 40.0;

// A size on paper, as it was exported last.
struct ExportSize {
  int preset = kScreenPreset;  // index into kPaperPresets
  QSizeF sizeMm{120.0, 90.0};
  double textPt = 8.0;
  bool operator==(const ExportSize&) const = default;
};

// All choices of an export.
struct ExportRequest {
  // The name of the view, ExportedView::name.
  QString view;
  ExportFormat form = ExportFormat::kPng;
  // Index into kPaperPresets.
  int preset = kScreenPreset;
  QSizeF sizeMm{120.0, 90.0};  // [mm]; not used for the preset "as on screen"
  double textPt = 8.0;         // [pt], in steps of 0.5; not used for "as on screen"
  // Resolution of a PNG file [dots per inch].
  int dpi = 300;
  // White background and dark lines.
  bool forPrint = true;
  // A title line names the recording.
  bool titled = true;
  ExportFrames frames = ExportFrames::kShown;
  // One of kMovieSpeeds; 1 is real time.
  double movieSpeed = 1.0;
  // One of kMovieRates [pictures/s].
  int moviePicturesPerS = 30;
  // One of kMovieHeights [px]; the width is in proportion.
  int movieHeightPx = 1080;
  // The name of the table, ExportedTable::name; the first table when it is unknown.
  QString table = {};
  // Absolute path.
  QString folder = {};
  // File name without folder and ending.
  QString name = {};
  // The user typed the name, so that it is kept when the frame changes. It is for `view` of
  // `source` only.
  bool nameIsOwn = false;
  // The recording that is exported from; empty: a connected hand.
  QString source = {};
  // Of each view that was exported before, by its name.
  std::map<QString, ExportSize> sizes = {};
  // Overwrites existing files; never stored.
  bool replace = false;

  ExportSize size() const { return {preset, sizeMm, textPt}; }
  void setSize(const ExportSize& size) {
    preset = size.preset;
    sizeMm = size.sizeMm;
    textPt = size.textPt;
  }
  bool isSeries() const noexcept {
    return form == ExportFormat::kPng && frames != ExportFrames::kShown;
  }
  bool isMovie() const noexcept { return form == ExportFormat::kMovie; }
  // Whether several frames (the selected ones or all) are written.
  bool ofFrames() const noexcept { return isSeries() || isMovie(); }
  bool operator==(const ExportRequest&) const = default;
};

// Loads the stored request. Invalid values are replaced by the defaults, so that a damaged settings
// file never stops the program.
ExportRequest loadExportRequest(const QSettings& settings);
void saveExportRequest(const ExportRequest& request, QSettings& settings);

// The size of the last export of `view`; of a view that was not exported yet, preset and text of
// `request` with a height that suits the view.
ExportSize sizeFor(const ExportedView& view, const ExportRequest& request);
// The size of a preset for a view [mm]; nothing for the presets that leave it open.
std::optional<QSizeF> sizeOfPreset(int preset, const ExportedView& view);

// The paper and the appearance for the picture of a view whose size on screen is `sizeOnScreen`
// [px].
PicturePaper paperOf(const ExportRequest& request, const QSizeF& sizeOnScreen);
PictureLook lookOf(const ExportRequest& request, const QSizeF& sizeOnScreen);

// The path of the file; for a series the path of its folder, which is in request.folder and has the
// request's name.
std::filesystem::path pathOf(const ExportRequest& request);
FileSeries seriesOf(const ExportRequest& request, const FrameSpan& span);
// The frames that are requested; nothing when they don't exist (no selection, no frame). A movie of
// the shown frame alone makes no sense: it covers the selected frames, else all.
std::optional<FrameSpan> spanOf(const ExportRequest& request, const FramePictures& pictures);

// The timing of the movie's pictures.
MovieOptions movieOptionsOf(const ExportRequest& request);
// The suggested file name for this view.
QString suggestedName(const ExportRequest& request, const ExportedView& view);

// Why no movie of the view can be made now; empty when one can.
QString movieProblem(const ExportedView& view);
// What prevents the export, in one line that tells the user what to do; empty when nothing does.
// Checks the disk.
QString problemOf(const ExportRequest& request, const ExportedView& view);
// What happens to a chart for which the typed height is small, in one line; empty: nothing.
QString heightHintOf(const ExportRequest& request, const ExportedView& view);
// Why that many bytes do not fit on the disk; empty when they do.
QString spaceProblemOf(const ExportRequest& request, double bytes);

// A number of bytes as text: "142 kB", "1.3 MB".
QString bytesText(double bytes);

}  // namespace palpate::gui
