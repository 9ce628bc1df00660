// The command `palpate render FILE --frame N -o OUT.{png,svg,pdf}` draws a picture of one frame;
// --from N --to M -o FOLDER draws a picture of each, -o OUT.mp4 writes a movie; -o out/{name}.png
// draws one of each of many recordings.
#include <QFontMetricsF>
#include <QGuiApplication>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include "palpate/batch/batch_run.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/characteristic_signals.h"

#include "commands/batch_options.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/display.h"
#include "commands/filter_options.h"
#include "commands/picture_size.h"
#include "commands/recording_list.h"
#include "commands/render_hand.h"
#include "commands/render_movie.h"
#include "gui/matrices/drawn_taxels.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/picture/ffmpeg.h"
#include "gui/picture/picture_export.h"
#include "gui/picture/picture_series.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

auto colorMapWords() {
  return wordsOf(gui::kAllColorMaps, [](gui::ColorMapName map) { return gui::nameOf(map); });
}

// Parses "MIN,MAX".
void parseRange(const std::string& text, gui::MatricesPictureOptions& options) {
  const auto comma = text.find(',');
  if (comma != std::string::npos) {
    const auto least = parseDouble(text.substr(0, comma));
    const auto most = parseDouble(text.substr(comma + 1));
    if (least && most && *least < *most) {
      options.rangeMin = *least;
      options.rangeMax = *most;
      return;
    }
  }
  throw UsageError("--range must be MIN,MAX with MIN below MAX, not '" + text + "'");
}

constexpr QSize kSmallestPicture{320, 320};
constexpr double kMmPerInch = 25.4;
// On paper a unit is half a point, so that text sizes are exact in steps of 0.5 pt.
constexpr int kUnitsPerPt = 2;
constexpr double kUnitsPerInch = 144.0;
constexpr double kMovieDpi = 96.0;       // one pixel for each of --size
constexpr double kUsualWidthMm = 174.0;  // two columns of a journal
constexpr double kUsualHeight = 0.8;     // of the width
constexpr double kUsualTextPt = 8.0;
constexpr OptionRange kPaperMm{20.0, 1200.0, "mm"};
constexpr OptionRange kTextPt{4.0, 40.0, "pt"};
constexpr OptionRange kDpi{36.0, 2400.0};
constexpr double kPaperDpi = 300.0;
constexpr double kMaxPixels = 16384.0;  // largest side

const std::vector<const char*> kPaperOptions = {"width-mm", "height-mm", "text-pt", "print"};

// The paper or screen size of the picture, and its text size.
struct Sheet {
  gui::PicturePaper paper;
  int textUnits = 0;  // 0: default font
};

// Determines the sheet from the options; sets options.size to its size.
Sheet chosenSheet(const CommandLine& given, gui::MatricesPictureOptions& options) {
  Sheet sheet;
  gui::PicturePaper& paper = sheet.paper;
  const bool onPaper = std::any_of(kPaperOptions.begin(),
                                   kPaperOptions.end(),
                                   [&](const char* name) { return given.has(name); });
  if (onPaper) {
    const double widthMm = given.number("width-mm", kPaperMm).value_or(kUsualWidthMm);
    const double heightMm = given.number("height-mm", kPaperMm).value_or(widthMm * kUsualHeight);
    const double textPt = given.number("text-pt", kTextPt).value_or(kUsualTextPt);
    options.size = QSizeF(widthMm, heightMm) / kMmPerInch * kUnitsPerInch;
    sheet.textUnits = static_cast<int>(std::lround(textPt * kUnitsPerPt));
    paper.unitsPerInch = kUnitsPerInch;
    paper.dpi = kPaperDpi;
  }
  paper.size = options.size;
  paper.dpi = given.number("dpi", kDpi).value_or(paper.dpi);
  const double longest = std::max(paper.size.width(), paper.size.height()) * paper.scale();
  if (longest > kMaxPixels)
    throw UsageError("a PNG of " + fixedText(longest, 0) +
                     " pixels is too large; choose fewer dpi or a smaller size");
  paper.background = gui::colorsOf(options.theme).window;
  return sheet;
}

// Paints one frame, with its title if it has one.
class FramePainter {
 public:
  FramePainter(Profile profile, gui::MatricesPictureOptions options)
      : profile_(std::move(profile)), options_(std::move(options)) {}
  void operator()(QPainter& painter, std::size_t frame) const {
    gui::MatricesPictureOptions options = options_;
    if (!options.title.isEmpty()) options.caption = gui::captionOf(profile_, frame);
    gui::paintMatricesPicture(
        painter, QRectF(QPointF(), options.size), profile_.frame(frame), profile_.hand(), options);
  }

 private:
  Profile profile_;
  gui::MatricesPictureOptions options_;
};

// The function that paints the frames of a span.
gui::FramePictures::Paint painterOf(const CommandLine& given,
                                    const Profile& profile,
                                    const gui::FrameSpan& span,
                                    const gui::MatricesPictureOptions& options) {
  const std::string view = given.text("view").value_or("matrices");
  if (view == "hand") return handPainter(given, profile, span, options);
  if (view != "both") return FramePainter(profile, options);
  // The hand next to the matrices, each in one half, below one title; the colour bar of the
  // matrices is that of both.
  constexpr double kMargin = 12.0;  // [px]
  const double titleHeight = QFontMetricsF(gui::pictureFont(options)).height();
  const double top = titleHeight + 0.6 * kMargin;
  gui::MatricesPictureOptions half = options;
  half.size = QSizeF(options.size.width() / 2.0, options.size.height() - top);
  half.title.clear();
  gui::MatricesPictureOptions halfOfHand = half;
  halfOfHand.colorBar = false;
  return
      [=,
       matrices = gui::FramePictures::Paint(FramePainter(profile, half)),
       hand = handPainter(given, profile, span, halfOfHand)](QPainter& painter, std::size_t frame) {
        gui::MatricesPictureOptions titled = options;
        titled.caption = gui::captionOf(profile, frame);
        painter.save();
        painter.fillRect(QRectF(0.0, 0.0, options.size.width(), top),
                         gui::colorsOf(options.theme).window);
        gui::paintTitle(
            painter,
            QRectF(kMargin, 0.6 * kMargin, options.size.width() - 2.0 * kMargin, titleHeight),
            titled);
        painter.restore();
        painter.save();
        painter.translate(0.0, top);
        matrices(painter, frame);
        painter.translate(half.size.width(), 0.0);
        hand(painter, frame);
        painter.restore();
      };
}

// The requested frame, else the frame with the largest sum.
std::size_t chosenFrame(std::optional<std::int64_t> frame,
                        const std::string& file,
                        const Profile& profile) {
  if (profile.numFrames() == 0) throw Error(file + ": has no frame to draw");
  if (!frame) return SignalTable::of(profile).frameOfLargestSum();
  if (static_cast<std::uint64_t>(*frame) >= profile.numFrames())
    throw Error(file + ": has no frame " + std::to_string(*frame) + ", only 0.." +
                std::to_string(profile.numFrames() - 1));
  return static_cast<std::size_t>(*frame);
}

gui::FrameSpan chosenSpan(const CommandLine& given,
                          const std::string& file,
                          const Profile& profile) {
  if (profile.numFrames() == 0) throw Error(file + ": has no frame to draw");
  const auto from = given.integer("from", kFrameOption).value_or(0);
  const auto last = static_cast<std::int64_t>(profile.numFrames()) - 1;
  const auto to = given.integer("to", kFrameOption).value_or(last);
  if (from > to || to > last)
    throw Error(file + ": has no frames " + std::to_string(from) + ".." + std::to_string(to) +
                ", only 0.." + std::to_string(last));
  return {static_cast<std::size_t>(from), static_cast<std::size_t>(to)};
}

// Uses the same colour range in all pictures: up to the largest value of all frames.
void useOneRange(const Profile& profile,
                 const gui::FrameSpan& span,
                 gui::MatricesPictureOptions& options) {
  if (options.rangeMax > options.rangeMin) return;
  float largest = 0.0F;
  TactileFrame frame;
  for (std::size_t i = span.first; i <= span.last; ++i) {
    profile.readFrame(i, frame);
    for (const float value : frame.values) largest = std::max(largest, value);
    if (options.taxels == gui::TaxelView::kMagnitude)
      largest = std::max(largest, static_cast<float>(gui::largestDrawn(frame, options.taxels)));
  }
  options.rangeMax = largest > 0.0F ? static_cast<double>(largest) : 1.0;
}

int drawSeries(const CommandLine& given,
               const Profile& profile,
               const gui::PicturePaper& paper,
               gui::MatricesPictureOptions options,
               Overwrite overwrite) {
  const std::string& file = given.words()[0];
  const gui::FrameSpan span = chosenSpan(given, file, profile);
  const FileSeries series{.folder = fs::path(*given.text("output")),
                          .stem = fs::path(file).stem().string(),
                          .ending = ".png",
                          .first = span.first,
                          .last = span.last};
  options.pixelRatio = paper.scale();
  useOneRange(profile, span, options);
  Interruption interruption;
  gui::SeriesReport report;
  {
    ProgressLine progress("drawing", given.quiet());
    const Progress show = progress.callback();
    report = gui::writePictureSeries(
        series, painterOf(given, profile, span, options), paper, overwrite, [&](double fraction) {
          return !interruption.waitForSignal(0) && (!show || show(fraction));
        });
  }
  const std::string count = std::to_string(report.written) + " of " +
                            std::to_string(series.count()) + " pictures are in " +
                            series.folder.string();
  if (!report.failure.empty())
    throw Error(report.failure + (report.written > 0 ? "; " + count : std::string()));
  if (report.cancelled) {
    sayLine("interrupted: " + count);
    return kPartlyDone;
  }
  if (!given.quiet())
    std::printf("%s: %zu pictures, frames %zu..%zu\n",
                escapedLine(series.folder.string()).c_str(),
                report.written,
                span.first,
                span.last);
  return kDone;
}

int drawOne(const CommandLine& given,
            const Profile& profile,
            const gui::PicturePaper& paper,
            gui::MatricesPictureOptions options,
            Overwrite overwrite) {
  const std::string out = *given.text("output");
  const std::size_t frame =
      chosenFrame(given.integer("frame", kFrameOption), given.words()[0], profile);
  if (gui::imageFormatOf(out) == gui::ImageFormat::kPng) options.pixelRatio = paper.scale();
  const auto paint = painterOf(given, profile, {frame, frame}, options);
  gui::writePicture(
      out, [&](QPainter& painter) { paint(painter, frame); }, paper, overwrite);
  if (!given.quiet()) std::printf("%s: frame %zu\n", escapedLine(out).c_str(), frame);
  return kDone;
}

// What is drawn of each recording.
struct RenderPage {
  gui::MatricesPictureOptions options = {};
  Sheet sheet = {};
  Recipe filters = {};
  MovieOptions movie = {};
};

// The options that pictures depend on, as text: of all but those of the batch itself.
std::string renderText(const CommandLine& given, const CommandSpec& spec) {
  const std::set<std::string> others = {"output", "force", "resume", "threads", "report", "quiet"};
  std::string text = "render";
  for (const OptionSpec& option : spec.options) {
    const std::string name = option.name.substr(0, option.name.find(','));
    if (others.contains(name) || !given.has(name)) continue;
    text += "; " + name;
    for (const std::string& value : given.texts(name)) text += " " + value;
  }
  return text;
}

// A picture of one frame of each recording, or a movie of each.
BatchTask renderTask(const CommandLine& given, const CommandSpec& spec, const RenderPage& page) {
  return {.options = renderText(given, spec),
          .work = [&given, page](const BatchItem& item,
                                 Overwrite overwrite,
                                 const Progress& progress,
                                 std::size_t threads) {
            const bool isMovie = isMovieName(item.target.string());
            const std::string file = item.source.string();
            const Recording recorded = readRecording(
                item.source, {.threads = threads}, partOf(progress, 0.0, isMovie ? 0.1 : 0.9));
            const std::string lost = lostLine(item.source, recorded.profile);
            const Profile profile = filteredBy(page.filters, recorded, item.source);
            gui::MatricesPictureOptions options = page.options;
            gui::PicturePaper paper = page.sheet.paper;
            options.title = QString::fromStdString(item.source.filename().string());
            paper.title = options.title;
            if (isMovie) {
              const gui::FrameSpan span = chosenSpan(given, file, profile);
              options.pixelRatio = paper.scale();
              useOneRange(profile, span, options);
              writeChosenMovie(
                  page.movie,
                  item.target,
                  profile,
                  span,
                  painterOf(given, profile, span, options),
                  paper,
                  overwrite,
                  [&](double fraction) { return !progress || progress(0.1 + 0.9 * fraction); });
              return BatchAnswer{.said = counted(span.count(), "frame"), .problem = lost};
            }
            const std::size_t frame =
                chosenFrame(given.integer("frame", kFrameOption), file, profile);
            if (gui::imageFormatOf(item.target.string()) == gui::ImageFormat::kPng)
              options.pixelRatio = paper.scale();
            const auto paint = painterOf(given, profile, {frame, frame}, options);
            gui::writePicture(
                item.target.string(),
                [&](QPainter& painter) { paint(painter, frame); },
                paper,
                overwrite);
            return BatchAnswer{.said = "frame " + std::to_string(frame), .problem = lost};
          }};
}

// Whether the words are those of a batch: several recordings, a folder, or a template as OUT.
bool isRenderBatch(const CommandLine& given) {
  std::error_code ignored;
  return given.words().size() > 1 || fs::is_directory(given.words()[0], ignored) ||
         given.text("output").value_or("").find('{') != std::string::npos;
}

// Checks the options without reading a file.
void checkUsage(const CommandLine& given, bool isSeries) {
  if (given.has("to") && given.integer("from", kFrameOption) > given.integer("to", kFrameOption))
    throw UsageError("--from is after --to");
  const auto out = given.text("output");
  if (!out)
    throw UsageError(
        "render needs -o OUT.png, OUT.svg, OUT.pdf or OUT.mp4, or a folder for --from");
  const bool isMovie = isMovieName(*out);
  checkMovieUsage(given);
  const bool isPicture = gui::imageFormatOf(*out).has_value();
  if (isRenderBatch(given) && isSeries && !isMovie)
    throw UsageError("a batch draws one frame of each recording (--frame), or movies: .mp4");
  if (isSeries && given.has("frame"))
    throw UsageError("give --frame, or --from and --to, not both");
  if (isSeries && isPicture)
    throw UsageError(
        "with --from or --to the pictures go into a folder, or OUT.mp4: -o FOLDER, not '" + *out +
        "'");
  if (!isSeries && !isMovie && !isPicture)
    throw UsageError("the picture's name must end in .png, .svg or .pdf, a movie's in .mp4, not '" +
                     *out + "'");
  checkHandUsage(given);
  if (!given.has("size")) return;
  for (const char* name : kPaperOptions)
    if (given.has(name))
      throw UsageError("--size is in pixels, --" + std::string(name) +
                       " is for paper: give one of them");
}

int renderBatch(const CommandLine& given, const CommandSpec& spec, RenderPage page) {
  const BatchTemplate names = batchTemplateOf(given, {".png", ".svg", ".pdf", ".mp4"});
  if (isMovieName(*given.text("output")) && !gui::findFfmpeg()) throw Error(gui::ffmpegMissing());
  drawWithoutDisplay();
  std::string name = "palpate";
  char* arguments[] = {name.data(), nullptr};
  int count = 1;
  const RuntimeFolder runtime;
  const QGuiApplication application(count, arguments);
  page.options.font = QGuiApplication::font();
  if (page.sheet.textUnits > 0) page.options.font.setPixelSize(page.sheet.textUnits);
  return runBatchCommand(given, names, renderTask(given, spec, page));
}

}  // namespace

int renderCommand(const Arguments& words) {
  RenderPage page;
  gui::MatricesPictureOptions& options = page.options;
  MovieOptions& movie = page.movie;
  CommandSpec spec = {
      .synopsis =
          "palpate render FILE [--frame N | --from N --to M] -o OUT.{png,svg,pdf}|FOLDER|OUT.mp4\n"
          "       palpate render PATH... -o TEMPLATE",
      .purpose =
          "Draws the heat maps of one frame, or the hand in 3-D. The ending of OUT chooses the "
          "format; SVG and PDF are vector graphics with text as text. With --from or --to it draws "
          "a PNG of each frame from N to M, both inclusive: FOLDER/NAME_00042.png. If OUT ends in "
          ".mp4, it makes a movie of these frames at their recorded times; this needs the program "
          "ffmpeg ($PALPATE_FFMPEG, else in $PATH). With a template as OUT (out/{name}.png) it "
          "makes a picture or movie of each recording.",
      .options =
          {rangedWhole("frame", "N", "which", kFrameOption, "the frame of largest sum"),
           rangedWhole("from", "N", "first frame of a series", kFrameOption, "0"),
           rangedWhole("to", "M", "last frame, inclusive", kFrameOption, "the recording's last"),
           {"output,o", "OUT", "the picture or movie, or the folder of a series"},
           bound("speed",
                 "X",
                 "speed of a movie; 1: the recorded speed",
                 movie.speed,
                 MovieOptions::kSpeed),
           bound("fps",
                 "N",
                 "pictures per second of a movie",
                 movie.picturesPerS,
                 MovieOptions::kPicturesPerS),
           {"view", "matrices|hand|both", "what to draw; default matrices; both: side by side"},
           {"size", "WxH", "px (96 per inch), default 900x720; PNG has twice as many"},
           {"print", "", "for paper: white background, 174 mm wide, text of 8 pt, 300 dpi"},
           ranged("width-mm",
                  "W",
                  "width on paper; journals take 85, 114, 174",
                  kPaperMm,
                  numberText(kUsualWidthMm)),
           ranged("height-mm",
                  "H",
                  "height on paper",
                  kPaperMm,
                  numberText(kUsualHeight) + " of the width"),
           ranged("text-pt", "P", "size of text on paper", kTextPt, numberText(kUsualTextPt)),
           ranged("dpi",
                  "D",
                  "pixels of a PNG per inch",
                  kDpi,
                  numberText(gui::PicturePaper{}.dpi) + ", on paper " + numberText(kPaperDpi)),
           boundChoice("map", "NAME", "colours", options.map, colorMapWords()),
           {"range",
            "MIN,MAX",
            "counts of the lowest and the highest colour; default 0 to "
            "the maximum of the frame, or of all frames of a series"},
           bound("interpolated", "smooth between the taxels", options.interpolated),
           bound("values", "print the value of every active taxel", options.values),
           boundChoice(
               "component",
               "NAME",
               "of readings with a sign or three components; normal: z, with its "
               "sign on a diverging map",
               options.taxels,
               wordsOf(gui::kAllTaxelViews, [](gui::TaxelView view) { return gui::nameOf(view); })),
           bound("arrows",
                 "F",
                 "length of the arrows of shear; 1: a shear as large as the highest colour "
                 "is one taxel long; 0: none",
                 options.arrows,
                 {0.0, gui::kLongestArrows}),
           boundChoice("theme", "NAME", "", options.theme, gui::kThemeWords),
           {"force", "", "replace OUT"}},
      .example = "palpate render foam_ball.dsa --frame 2411 -o frame.svg --values",
      .minArguments = 1};
  const auto ofHand = handViewOptions();
  spec.options.insert(spec.options.end(), ofHand.begin(), ofHand.end());
  spec.options = withResumeOptions(withFilterOptions(std::move(spec.options)));
  const CommandLine given(spec, words);
  if (given.helpShown()) return kDone;
  const Recipe& recipe = page.filters = recipeOf(given);
  const bool isSeries = given.has("from") || given.has("to");
  checkUsage(given, isSeries);
  const bool isBatch = isRenderBatch(given);
  if (!isBatch) refuseBatchOptions(given);
  if (const auto size = given.text("size")) options.size = parsedSize(*size, kSmallestPicture);
  if (const auto range = given.text("range")) parseRange(*range, options);
  if (options.theme == gui::Theme::kDark && given.has("print"))
    throw UsageError("--print has a white background, not a dark one");
  Sheet& sheet = page.sheet;
  sheet = chosenSheet(given, options);
  const bool isMovie = isMovieName(*given.text("output"));
  if (isMovie && !given.has("dpi") && sheet.textUnits == 0) sheet.paper.dpi = kMovieDpi;
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  if (isBatch) return renderBatch(given, spec, page);

  if (isMovie) requireMovie(*given.text("output"), overwrite);  // before the long work

  const std::string& file = given.words()[0];
  const Profile profile = [&] {
    ProgressLine progress("reading " + file, given.quiet());
    const Recording recorded = openReported(file, progress, given.quiet());
    return filteredBy(recipe, recorded, file);
  }();
  options.title = QString::fromStdString(fs::path(file).filename().string());
  sheet.paper.title = options.title;

  drawWithoutDisplay();
  std::string name = "palpate";
  char* arguments[] = {name.data(), nullptr};
  int count = 1;
  const RuntimeFolder runtime;
  const QGuiApplication application(count, arguments);
  options.font = QGuiApplication::font();
  if (sheet.textUnits > 0) options.font.setPixelSize(sheet.textUnits);
  if (isMovie) {
    const gui::FrameSpan span = chosenSpan(given, file, profile);
    options.pixelRatio = sheet.paper.scale();
    useOneRange(profile, span, options);
    return drawMovie(given,
                     movie,
                     profile,
                     span,
                     painterOf(given, profile, span, options),
                     sheet.paper,
                     overwrite);
  }
  return isSeries ? drawSeries(given, profile, sheet.paper, options, overwrite)
                  : drawOne(given, profile, sheet.paper, options, overwrite);
}

}  // namespace palpate::commands
