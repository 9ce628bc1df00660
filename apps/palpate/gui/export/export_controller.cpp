#include "gui/export/export_controller.h"

#include <QApplication>
#include <QClipboard>
#include <QEvent>
#include <QFileInfo>
#include <QFocusEvent>
#include <QMimeData>
#include <QPainter>
#include <memory>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"
#include "gui/export/export_dialog.h"
#include "gui/picture/views_together.h"

namespace palpate::gui {
namespace {

constexpr std::size_t kMostCopiedRows = 100'000;  // as many as a spreadsheet can paste
constexpr double kCopyDpi = 192.0;                // twice the screen's resolution
constexpr const char* kHasExported = "export/done";

// Throws Error: a part of the recording that the table needs is damaged.
std::unique_ptr<QMimeData> dataOf(const ExportedTable& table, std::size_t& rows) {
  const TextTable text = table.make();
  auto data = std::make_unique<QMimeData>();
  data->setText(QString::fromStdString(tabbedText(text, kMostCopiedRows)));
  data->setData("text/csv", QByteArray::fromStdString(csvText(text, kMostCopiedRows)));
  rows = text.numRows;
  return data;
}

// Several views together have no widget.
bool isVisible(const ExportedView* view) {
  return view && (!view->widget || view->widget->isVisible());
}

QString rowsText(std::size_t rows) {
  if (rows > kMostCopiedRows)
    return QString("the first %1 of %2 rows; export them all as CSV")
        .arg(kMostCopiedRows)
        .arg(rows);
  return rows == 1 ? QString("1 row") : QString("%1 rows").arg(rows);
}

}  // namespace

ExportController::ExportController(QSettings& settings, Ask& places, QWidget* window)
    : source([] { return QString(); }), settings_(settings), window_(window) {
  worker_.setMaxThreadCount(1);
  ask = [this, &places](const ExportRequest& suggested) -> std::optional<ExportRequest> {
    ExportDialog dialog(present(), suggested, places, window_);
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.request();
  };
  qApp->installEventFilter(this);
}

ExportController::~ExportController() {
  cancelled_ = true;
  worker_.waitForDone();
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
  waiting_.push_back({name, prepareExport(*view, request)});
  if (waiting_.size() == 1) startNext();
}

void ExportController::startNext() {
  cancelled_ = false;
  emit started(waiting_.front().what);
  worker_.start([this, work = waiting_.front().work] {
    int lastPermille = -1;
    const ExportReport report = work([&](double fraction) {
      constexpr double kPermille = 1000.0;
      const int permille = static_cast<int>(fraction * kPermille);
      if (permille != lastPermille)
        QMetaObject::invokeMethod(
            this, [this, fraction] { emit progressed(fraction); }, Qt::QueuedConnection);
      lastPermille = permille;
      return !cancelled_;
    });
    QMetaObject::invokeMethod(
        this, [this, report] { conclude(report); }, Qt::QueuedConnection);
  });
}

void ExportController::conclude(const ExportReport& report) {
  waiting_.pop_front();
  if (!report.failure.isEmpty())
    emit failed(textOf(report));
  else
    emit said(textOf(report));
  if (report.failure.isEmpty() && !report.cancelled) emit written(report.path);
  if (waiting_.empty())
    emit finished();
  else
    startNext();
}

void ExportController::cancel() {
  if (!busy()) return;
  waiting_.erase(waiting_.begin() + 1, waiting_.end());
  cancelled_ = true;
}

void ExportController::waitForDone() { worker_.waitForDone(); }

void ExportController::copyPicture() try {
  const ExportedView* view = active();
  if (!view) return;
  const auto tables = view->tablesNow();
  std::size_t rows = 0;
  // Heat maps are copied only as a picture; a program that accepts text would paste their rows
  // instead.
  const bool withRows = !tables.empty() && !view->framePictures;
  auto data = withRows ? dataOf(tables.front(), rows) : std::make_unique<QMimeData>();
  if (view->paint) {
    ExportRequest request;
    request.forPrint = false;
    PicturePaper paper = paperOf(request, view->sizeOnScreen());
    paper.dpi = kCopyDpi;
    PictureLook look = lookOf(request, view->sizeOnScreen());
    look.pixelRatio = paper.scale();
    data->setImageData(pictureImage([&](QPainter& painter) { view->paint(painter, look); }, paper));
  }
  QApplication::clipboard()->setMimeData(data.release());
  emit said("copied: " + view->name +
            (withRows ? " as picture and " + rowsText(rows) : QString(" as picture")));
} catch (const Error& error) {
  emit failed(inWindowWords(QString::fromUtf8(error.what())));
}

void ExportController::copyTable() try {
  const ExportedView* view = active();
  const auto tables = view ? view->tablesNow() : std::vector<ExportedTable>();
  if (tables.empty()) return;
  std::size_t rows = 0;
  QApplication::clipboard()->setMimeData(dataOf(tables.front(), rows).release());
  emit said("copied: " + view->name + ", " + tables.front().name + ", " + rowsText(rows));
} catch (const Error& error) {
  emit failed(inWindowWords(QString::fromUtf8(error.what())));
}

}  // namespace palpate::gui
