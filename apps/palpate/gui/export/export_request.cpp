#include "gui/export/export_request.h"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>
#include <cmath>
#include <iterator>

#include <palpate/capture/recorder.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/settings_table.h"
#include "gui/picture/ffmpeg.h"

namespace palpate::gui {
namespace {

constexpr double kExportRequestMmPerInch = 25.4;
constexpr double kScreenPerInch = 96.0;
// Units per inch on paper: a unit is half a point. Text sizes are whole units and thus exact in
// halves of a point; lines of one pixel on screen are half a point wide on paper.
constexpr double kPaperPerInch = 144.0;
constexpr double kUnitsPerPt = 2.0;
constexpr int kMaxPixels = 16384;  // largest side

const QString kExportSizesGroup = "export/sizes/";  // and the name of the view

void sizeFields(SettingsTable& table, ExportSize& size) {
  QString preset = kPaperPresets[static_cast<std::size_t>(size.preset)].name;
  table.text("size", preset);
  for (std::size_t i = 0; i < kPaperPresets.size(); ++i)
    if (kPaperPresets[i].name == preset) size.preset = static_cast<int>(i);
  table.number("width_mm", size.sizeMm.rwidth(), kMinPaperMm, kMaxPaperMm);
  table.number("height_mm", size.sizeMm.rheight(), kMinPaperMm, kMaxPaperMm);
  table.number("text_pt", size.textPt, kMinTextPt, kMaxTextPt);
}

void exportFields(SettingsTable& table, ExportRequest& request) {
  const auto oneOf = [&table](const char* key, auto& value, const auto& known) {
    auto kept = value;
    table.number(key, kept, known.front(), known.back());
    if (std::find(known.begin(), known.end(), kept) != known.end()) value = kept;
  };
  ExportSize size = request.size();
  sizeFields(table, size);
  request.setSize(size);
  table.text("view", request.view);
  table.choice("form", request.form, kAllExportForms);
  oneOf("dpi", request.dpi, kExportDpi);
  table.flag("for_print", request.forPrint);
  table.flag("titled", request.titled);
  table.number("frames", request.frames, 0, static_cast<int>(ExportFrames::kAll));
  oneOf("movie_speed", request.movieSpeed, kMovieSpeeds);
  oneOf("movie_pictures_per_s", request.moviePicturesPerS, kMovieRates);
  oneOf("movie_height_px", request.movieHeightPx, kMovieHeights);
  table.text("table", request.table);
  table.text("folder", request.folder);
  table.text("name", request.name);
  table.flag("name_is_own", request.nameIsOwn);
  table.text("source", request.source);
}

// The problem with the file of a request that has a name.
QString fileProblemOf(const ExportRequest& request) {
  const QFileInfo file(QString::fromStdString(pathOf(request).string()));
  if (file.isDir()) return file.fileName() + " is a folder.";
  if ((file.exists() || file.isSymLink()) && !request.replace)
    return file.fileName() + " exists already: tick Replace, or choose another name.";
  return {};
}

}  // namespace

QString nameOf(ExportFormat form) {
  switch (form) {
    case ExportFormat::kSvg:
      return "SVG";
    case ExportFormat::kPdf:
      return "PDF";
    case ExportFormat::kCsv:
      return "CSV";
    case ExportFormat::kMovie:
      return "MP4";
    case ExportFormat::kPng:
      break;
  }
  return "PNG";
}

QString endingOf(ExportFormat form) { return "." + nameOf(form).toLower(); }

QString descriptionOf(ExportFormat form) {
  switch (form) {
    case ExportFormat::kSvg:
      return "A drawing that can be edited";
    case ExportFormat::kPdf:
      return "A drawing with its fonts";
    case ExportFormat::kCsv:
      return "The numbers shown";
    case ExportFormat::kMovie:
      return "A movie of the frames, at their recorded times";
    case ExportFormat::kPng:
      break;
  }
  return "A picture made of pixels";
}

ExportRequest loadExportRequest(const QSettings& settings) {
  auto request = loadFields<ExportRequest>(settings, exportFields, "export/");
  if (!QDir::isAbsolutePath(request.folder)) {
    request.folder = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
    if (request.folder.isEmpty() || !QFileInfo::exists(request.folder))
      request.folder = QDir::homePath();
  }
  if (!request.nameIsOwn) request.name.clear();
  request.nameIsOwn = !request.name.isEmpty();
  for (const QString& key : settings.allKeys()) {
    const QString view = key.section('/', 2, -2);
    if (key != kExportSizesGroup + view + "/size" || view.isEmpty()) continue;
    // What this view has none of is as in the last export.
    ExportSize size = request.size();
    SettingsTable table(settings, nullptr, kExportSizesGroup + view + "/");
    sizeFields(table, size);
    request.sizes[view] = size;
  }
  return request;
}

void saveExportRequest(const ExportRequest& request, QSettings& settings) {
  saveFields(settings, request, exportFields, "export/");
  saveFields(settings, request.size(), sizeFields, kExportSizesGroup + request.view + "/");
}

std::optional<QSizeF> sizeOfPreset(int preset, const ExportedView& view) {
  const PaperPreset& chosen = kPaperPresets[static_cast<std::size_t>(preset)];
  if (preset == kOwnPreset || chosen.widthMm <= 0.0) return std::nullopt;
  if (chosen.heightMm > 0.0) return QSizeF(chosen.widthMm, chosen.heightMm);
  return view.sizeOnPaperMm(chosen.widthMm);
}

ExportSize sizeFor(const ExportedView& view, const ExportRequest& request) {
  const auto known = request.sizes.find(view.name);
  if (known != request.sizes.end()) return known->second;
  ExportSize size = request.size();
  if (request.view == view.name) return size;
  if (size.preset == kOwnPreset) size.sizeMm = view.sizeOnPaperMm(size.sizeMm.width());
  if (const auto ofPreset = sizeOfPreset(size.preset, view)) size.sizeMm = *ofPreset;
  return size;
}

PicturePaper paperOf(const ExportRequest& request, const QSizeF& sizeOnScreen) {
  PicturePaper paper;
  const bool asOnScreen = request.preset == kScreenPreset;
  paper.unitsPerInch = asOnScreen ? kScreenPerInch : kPaperPerInch;
  paper.size = asOnScreen ? sizeOnScreen : request.sizeMm / kExportRequestMmPerInch * kPaperPerInch;
  paper.dpi = request.dpi;
  if (request.isMovie())
    paper.dpi = request.movieHeightPx / paper.size.height() * paper.unitsPerInch;
  return paper;
}

PictureLook lookOf(const ExportRequest& request, const QSizeF& sizeOnScreen) {
  const PicturePaper paper = paperOf(request, sizeOnScreen);
  PictureLook look;
  look.size = paper.size;
  look.forPrint = request.forPrint;
  if (request.preset != kScreenPreset)
    look.textUnits = static_cast<int>(std::lround(request.textPt * kUnitsPerPt));
  look.titled = request.titled;
  const bool ofPixels = request.form == ExportFormat::kPng || request.isMovie();
  look.pixelRatio = ofPixels ? paper.scale() : 0.0;
  return look;
}

std::filesystem::path pathOf(const ExportRequest& request) {
  const std::filesystem::path folder = request.folder.toStdString();
  if (request.isSeries()) return folder / request.name.toStdString();
  return folder / (request.name + endingOf(request.form)).toStdString();
}

FileSeries seriesOf(const ExportRequest& request, const FrameSpan& span) {
  return {.folder = pathOf(request),
          .stem = request.name.toStdString(),
          .ending = endingOf(request.form).toStdString(),
          .first = span.first,
          .last = span.last};
}

std::optional<FrameSpan> spanOf(const ExportRequest& request, const FramePictures& pictures) {
  if (pictures.numFrames == 0) return std::nullopt;
  const bool selectedAnyhow =
      request.isMovie() && request.frames == ExportFrames::kShown && pictures.selected;
  if (request.frames == ExportFrames::kSelected || selectedAnyhow) return pictures.selected;
  return FrameSpan{0, pictures.numFrames - 1};
}

MovieOptions movieOptionsOf(const ExportRequest& request) {
  return {.picturesPerS = static_cast<double>(request.moviePicturesPerS),
          .speed = request.movieSpeed};
}

QString suggestedName(const ExportRequest& request, const ExportedView& view) {
  const auto pictures = request.ofFrames() ? view.framePicturesNow() : std::nullopt;
  return pictures ? pictures->fileName : view.fileName();
}

QString movieProblem(const ExportedView& view) {
  const auto pictures = view.framePicturesNow();
  if (!pictures || !pictures->timeUs || pictures->numFrames == 0)
    return view.framePictures ? "A movie needs the frames of a recording"
                              : "This view can't be made into a movie";
  return findFfmpeg() ? QString() : QString::fromStdString(ffmpegMissing());
}

QString problemOf(const ExportRequest& request, const ExportedView& view) {
  if (request.name.trimmed().isEmpty()) return "Enter a name.";
  if (request.name.contains('/')) return "A name can't contain “/”; choose the folder below.";
  if (!QDir::isAbsolutePath(request.folder)) return "Choose a folder.";
  const QFileInfo folder(request.folder);
  if (!folder.exists()) return "There is no folder " + request.folder + ".";
  if (!folder.isDir()) return request.folder + " isn't a folder.";
  if (!folder.isWritable()) return "No permission to write into " + request.folder + ".";
  if (request.isMovie())
    if (const QString reason = movieProblem(view); !reason.isEmpty()) return reason;
  if (request.form == ExportFormat::kPng || request.isMovie()) {
    const QSize pixels = paperOf(request, view.sizeOnScreen()).pixels();
    if (std::max(pixels.width(), pixels.height()) > kMaxPixels)
      return QString("%1 × %2 pixels are too many: choose %3.")
          .arg(pixels.width())
          .arg(pixels.height())
          .arg(request.isMovie() ? "a lower resolution" : "fewer dpi");
  }
  if (request.ofFrames()) {
    const auto pictures = view.framePicturesNow();
    const auto span = pictures ? spanOf(request, *pictures) : std::nullopt;
    if (!span)
      return "Nothing is selected in the timeline: drag over a range there, or choose other "
             "frames.";
    if (request.isMovie()) return fileProblemOf(request);
    const std::size_t there = numExisting(seriesOf(request, *span));
    if (there > 0 && !request.replace)
      return QString("%1 of these pictures exist already.").arg(there);
    return {};
  }
  return fileProblemOf(request);
}

QString heightHintOf(const ExportRequest& request, const ExportedView& view) {
  const bool onPaper = request.form != ExportFormat::kCsv && request.preset != kScreenPreset &&
                       view.minHeightShare > 0.0;
  if (!onPaper || request.sizeMm.height() >= kMinChartMm) return {};
  return QString("Below %1 mm the text of a chart may become smaller than typed.").arg(kMinChartMm);
}

QString spaceProblemOf(const ExportRequest& request, double bytes) {
  const auto freeBytes = freeBytesOf(request.folder.toStdString());
  if (!freeBytes || bytes <= static_cast<double>(*freeBytes)) return {};
  return "Only " + bytesText(static_cast<double>(*freeBytes)) + " are free there.";
}

QString bytesText(double bytes) {
  constexpr double kKilo = 1000.0;
  const char* const units[] = {"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (bytes >= kKilo && unit + 1 < std::size(units)) {
    bytes /= kKilo;
    ++unit;
  }
  return figure(bytes, unit > 0 && bytes < 10.0 ? 1 : 0) + " " + units[unit];
}

}  // namespace palpate::gui
