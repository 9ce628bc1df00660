#include "gui/export/export_controller.h"

#include <QApplication>
#include <QClipboard>
#include <QEvent>
#include <QFileInfo>
#include <QFocusEvent>
#include <QMimeData>
#include <QPainter>
#include <algorithm>
#include <memory>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"
#include "gui/export/export_dialog.h"
#include "gui/picture/views_together.h"

namespace palpate::gui {
namespace {

constexpr std::size_t kMaxCopiedRows = 100'000;  // as many as a spreadsheet can paste
constexpr double kCopyDpi = 192.0;               // twice the screen's resolution
constexpr const char* kHasExported = "export/done";

// Several views together have no widget.
bool isVisible(const ExportedView* view) {
  return view && (!view->widget || view->widget->isVisible());
}

QString rowsText(std::size_t rows) {
  if (rows > kMaxCopiedRows)
    return QString("the first %1 of %2 rows; export them all as CSV").arg(kMaxCopiedRows).arg(rows);
  return rows == 1 ? QString("1 row") : QString("%1 rows").arg(rows);
}

}  // namespace

ExportController::ExportController(QSettings& settings, Ask& places, QWidget* window)
    : source([] { return QString(); }),
      settings_(settings),
      window_(window),
      copying_(
          [](const Copy& asked, const Progress& progress, const auto&) {
            return withText(asked, progress);
          },
          [this](const Copy& copy) { toClipboard(copy); },
          [this](const QString& why) { emit failed(inWindowWords(why)); }) {
  connect(&job_, &BackgroundJob::started, this, &ExportController::started);
  connect(&job_, &BackgroundJob::progressed, this, &ExportController::progressed);
  connect(&job_, &BackgroundJob::failed, this, &ExportController::failed);
  connect(&job_, &BackgroundJob::finished, this, &ExportController::finished);
  ask = [this, &places](const ExportRequest& suggested) -> std::optional<ExportRequest> {
    ExportDialog dialog(present(), suggested, places, window_);
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.request();
  };
  qApp->installEventFilter(this);
}

void ExportController::add(ExportedView view) { views_.push_back(std::move(view)); }

void ExportController::addTogether() {
  const std::size_t others = views_.size();
  views_.push_back(viewsTogether([this, others] {
    std::vector<const ExportedView*> views;
    for (std::size_t i = 0; i < others; ++i) views.push_back(&views_[i]);
    return views;
  }));
}

std::vector<const ExportedView*> ExportController::present() const {
  std::vector<const ExportedView*> there;
  for (const ExportedView& view : views_)
    if (view.isThere()) there.push_back(&view);
  return there;
}

const ExportedView* ExportController::viewNamed(const QString& name) const {
  for (const ExportedView* view : present())
    if (view->name == name) return view;
  return nullptr;
}

const ExportedView* ExportController::active() const {
  const ExportedView* view = viewNamed(touched_);
  if (isVisible(view)) return view;
  const auto there = present();
  return there.empty() ? nullptr : there.front();
}

void ExportController::touch(const QWidget* widget) {
  for (const ExportedView& view : views_)
    if (view.widget && view.isThere() &&
        (view.widget == widget || view.widget->isAncestorOf(widget))) {
      touched_ = view.name;
      isTouchedSinceExport_ = true;
    }
}

bool ExportController::eventFilter(QObject* watched, QEvent* event) {
  // When the window becomes active again, the focus comes back by itself.
  const bool comesByItself =
      event->type() == QEvent::FocusIn &&
      static_cast<QFocusEvent*>(event)->reason() == Qt::ActiveWindowFocusReason;
  if (event->type() == QEvent::MouseButtonPress ||
      (event->type() == QEvent::FocusIn && !comesByItself))
    if (const auto* widget = qobject_cast<QWidget*>(watched)) touch(widget);
  return QObject::eventFilter(watched, event);
}

ExportRequest ExportController::suggestion() const {
  ExportRequest request = loadExportRequest(settings_);
  const ExportedView* exported = viewNamed(request.view);
  const ExportedView* view = !isTouchedSinceExport_ && isVisible(exported) ? exported : active();
  if (!view) return request;
  request.setSize(sizeFor(*view, request));
  if (request.view != view->name || request.source != source()) request.nameIsOwn = false;
  request.view = view->name;
  request.source = source();
  const bool asTable = request.form == ExportFormat::kCsv;
  if (asTable && view->tablesNow().empty()) request.form = ExportFormat::kPng;
  const auto pictures = view->framePicturesNow();
  if (!pictures || !spanOf(request, *pictures)) request.frames = ExportFrames::kShown;
  if (request.isMovie() && !movieProblem(*view).isEmpty()) request.form = ExportFormat::kPng;
  if (!request.nameIsOwn) request.name = suggestedName(request, *view);
  return request;
}

void ExportController::exportNow() {
  if (!anything()) return;
  const auto request = ask(suggestion());
  if (!request) return;
  saveExportRequest(*request, settings_);
  isTouchedSinceExport_ = false;
  settings_.setValue(kHasExported, true);
  write(*request);
}

void ExportController::repeatLast() {
  if (!anything()) return;
  ExportRequest request = loadExportRequest(settings_);
  const ExportedView* view = viewNamed(request.view);
  if (!settings_.value(kHasExported, false).toBool() || !view) return exportNow();
  if (request.source != source()) request.nameIsOwn = false;
  if (!request.nameIsOwn) request.name = suggestedName(request, *view);
  const std::filesystem::path free = freePath(pathOf(request));
  request.name =
      QString::fromStdString((request.isSeries() ? free.filename() : free.stem()).string());
  write(request);
}

void ExportController::write(const ExportRequest& request) {
  const ExportedView* view = viewNamed(request.view);
  if (!view) return;
  const QString name = QString::fromStdString(pathOf(request).filename().string());
  auto report = std::make_shared<ExportReport>();
  job_.start(
      name,
      [report, work = prepareExport(*view, request)](const Progress& progress) {
        *report = work(progress);
      },
      [this, report] { conclude(*report); });
}

void ExportController::conclude(const ExportReport& report) {
  if (!report.failure.isEmpty())
    emit failed(textOf(report));
  else
    emit said(textOf(report));
  if (report.failure.isEmpty() && !report.cancelled) emit written(report.path);
}

void ExportController::cancel() {
  if (job_.busy()) job_.cancel();
  if (!copying_.busy()) return;
  copying_.abandon();
  emit said("copying was cancelled");
}

void ExportController::settle() {
  job_.settle();
  copying_.settle();
}

// Rows of a long recording are read from its file. Throws Error where that is damaged.
ExportController::Copy ExportController::withText(const Copy& asked, const Progress& progress) {
  Copy copy = asked;
  if (!asked.table) return copy;
  std::size_t done = 0;
  TextTable table = *asked.table;
  table.row = [&](std::size_t row) {
    reportProgress(progress, done++, 2 * std::min(table.numRows, kMaxCopiedRows));
    return asked.table->row(row);
  };
  copy.tabbed = QString::fromStdString(tabbedText(table, kMaxCopiedRows));
  copy.csv = QByteArray::fromStdString(csvText(table, kMaxCopiedRows));
  return copy;
}

void ExportController::toClipboard(const Copy& copy) {
  auto data = std::make_unique<QMimeData>();
  if (copy.table) {
    data->setText(copy.tabbed);
    data->setData("text/csv", copy.csv);
  }
  if (!copy.image.isNull()) data->setImageData(copy.image);
  QApplication::clipboard()->setMimeData(data.release());
  emit said("copied: " + copy.what + (copy.table ? rowsText(copy.table->numRows) : QString()));
}

void ExportController::copyPicture() try {
  const ExportedView* view = active();
  if (!view) return;
  const auto tables = view->tablesNow();
  Copy copy{.what = view->name + " as picture"};
  // Heat maps are copied only as a picture; a program that accepts text would paste their rows
  // instead.
  if (!tables.empty() && !view->framePictures) {
    copy.table = tables.front().make();
    copy.what += " and ";
  }
  if (view->paint) {
    ExportRequest request;
    request.forPrint = false;
    PicturePaper paper = paperOf(request, view->sizeOnScreen());
    paper.dpi = kCopyDpi;
    PictureLook look = lookOf(request, view->sizeOnScreen());
    look.pixelRatio = paper.scale();
    copy.image = pictureImage([&](QPainter& painter) { view->paint(painter, look); }, paper);
  }
  copying_.ask(copy);
} catch (const Error& error) {
  emit failed(inWindowWords(QString::fromUtf8(error.what())));
}

void ExportController::copyTable() try {
  const ExportedView* view = active();
  const auto tables = view ? view->tablesNow() : std::vector<ExportedTable>();
  if (tables.empty()) return;
  copying_.ask(
      {.what = view->name + ", " + tables.front().name + ", ", .table = tables.front().make()});
} catch (const Error& error) {
  emit failed(inWindowWords(QString::fromUtf8(error.what())));
}

}  // namespace palpate::gui
