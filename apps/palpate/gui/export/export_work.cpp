#include "gui/export/export_work.h"

#include <QFileInfo>
#include <QPainter>
#include <utility>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"
#include "gui/picture/movie_writer.h"
#include "gui/picture/picture_series.h"

namespace palpate::gui {
namespace {

// Runs `work` and turns exceptions into the report's failure line.
ExportReport guarded(ExportReport report, const std::function<void(ExportReport&)>& work) {
  try {
    work(report);
  } catch (const Cancelled&) {
    report.cancelled = true;
  } catch (const std::exception& error) {
    report.failure = QString::fromUtf8(error.what());
  }
  return report;
}

ExportWork tableWork(const ExportedView& view, const ExportRequest& request, Overwrite overwrite) {
  const auto tables = view.tablesNow();
  const ExportedTable* chosen = nullptr;
  for (const ExportedTable& table : tables)
    if (!chosen || table.name == request.table) chosen = &table;
  if (!chosen) return {};
  return [table = chosen->make(), path = pathOf(request), overwrite](const Progress& progress) {
    return guarded({.path = pathText(path)}, [&](ExportReport& report) {
      writeTable(table, path, overwrite, progress);
      report.written = 1;
    });
  };
}

// Records each frame in a QPicture first, as for a single picture, so that the same frame gives the
// same picture.
FramePictures::Paint recorded(FramePictures::Paint paint) {
  return [paint = std::move(paint)](QPainter& painter, std::size_t frame) {
    QPicture picture;
    QPainter recorder(&picture);
    paint(recorder, frame);
    recorder.end();
    replay(painter, picture);
  };
}

ExportWork seriesWork(const ExportedView& view, const ExportRequest& request, Overwrite overwrite) {
  const auto pictures = view.framePicturesNow();
  const auto span = pictures ? spanOf(request, *pictures) : std::nullopt;
  if (!span) return {};
  PicturePaper paper = paperOf(request, view.sizeOnScreen());
  paper.title = pictures->fileName;
  const PictureLook look = lookOf(request, view.sizeOnScreen());
  return [paint = recorded(pictures->painter(look)),
          paper,
          series = seriesOf(request, *span),
          overwrite](const Progress& progress) {
    ExportReport start{.path = pathText(series.folder), .wanted = series.count()};
    return guarded(start, [&](ExportReport& report) {
      const SeriesReport done = writePictureSeries(series, paint, paper, overwrite, progress);
      report.written = done.written;
      report.cancelled = done.cancelled;
      report.failure = QString::fromStdString(done.failure);
    });
  };
}

ExportWork movieWork(const ExportedView& view, const ExportRequest& request, Overwrite overwrite) {
  const auto pictures = view.framePicturesNow();
  const auto span = pictures ? spanOf(request, *pictures) : std::nullopt;
  if (!span) return {};
  PicturePaper paper = paperOf(request, view.sizeOnScreen());
  paper.title = pictures->fileName;
  const PictureLook look = lookOf(request, view.sizeOnScreen());
  return [paint = recorded(pictures->painter(look)),
          timeUs = pictures->timeUs,
          span = *span,
          options = movieOptionsOf(request),
          paper,
          path = pathOf(request),
          overwrite](const Progress& progress) {
    return guarded({.path = pathText(path)}, [&](ExportReport& report) {
      const Movie movie = plannedMovie(span, timeUs, options, progress);
      writeMovie(path, movie, paint, paper, overwrite, progress);
      report.written = 1;
    });
  };
}

}  // namespace

QString textOf(const ExportReport& report) {
  const QString name = QFileInfo(report.path).fileName();
  if (report.wanted == 1) {
    if (!report.failure.isEmpty()) return report.failure;
    return report.cancelled ? "cancelled: " + name + " was not written" : "written: " + report.path;
  }
  const QString count = QString("%1 of %2 pictures").arg(report.written).arg(report.wanted);
  if (!report.failure.isEmpty())
    return report.failure +
           (report.written > 0 ? " (" + count + " are in " + report.path + ")" : QString());
  if (report.cancelled) return "cancelled: " + count + " are in " + report.path;
  return QString("written: %1 pictures in %2").arg(report.written).arg(report.path);
}

QPicture pictureOf(const ExportedView& view, const PictureLook& look) {
  QPicture picture;
  QPainter painter(&picture);
  view.paint(painter, look);
  painter.end();
  return picture;
}

ExportWork prepareExport(const ExportedView& view, const ExportRequest& request) {
  const Overwrite overwrite = request.replace ? Overwrite::kReplace : Overwrite::kRefuse;
  if (const QString problem = problemOf(request, view); !problem.isEmpty())
    return [problem](const Progress&) { return ExportReport{.path = {}, .failure = problem}; };
  ExportWork work;
  if (request.form == ExportFormat::kCsv) {
    work = tableWork(view, request, overwrite);
  } else if (request.isMovie()) {
    work = movieWork(view, request, overwrite);
  } else if (request.isSeries()) {
    work = seriesWork(view, request, overwrite);
  } else if (view.paint) {
    PicturePaper paper = paperOf(request, view.sizeOnScreen());
    paper.title = view.fileName();
    paper.description = view.name;
    work = [picture = pictureOf(view, lookOf(request, view.sizeOnScreen())),
            paper,
            path = pathOf(request),
            overwrite](const Progress& progress) {
      return guarded({.path = pathText(path)}, [&](ExportReport& report) {
        if (progress && !progress(0.0)) throw Cancelled();
        writePicture(
            path, [&](QPainter& painter) { replay(painter, picture); }, paper, overwrite);
        report.written = 1;
      });
    };
  }
  if (work) return work;
  return [name = view.name, form = nameOf(request.form)](const Progress&) {
    return ExportReport{.path = {}, .failure = name + " can't be exported as " + form};
  };
}

}  // namespace palpate::gui
