#include "gui/connect/stream_page.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/device/stream_device.h>
#include <palpate/model/hand_file.h>
#include <palpate/model/touch.h>

#include "gui/appearance/captions.h"
#include "gui/connect/source_field.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/make.h"
#include "gui/widgets/state_mark.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui {
namespace {

constexpr int kHandRole = Qt::UserRole + 2;  // in the form that findHand() takes
constexpr const char* kHandBeingRead = "The hand is being read.";

QString streamPageText(const std::string& of) { return QString::fromStdString(of); }

// "matrices 3 x 14x6, 3 x 13x6, 456 taxels; 7 joints, 10 temperatures; 0 to 4095 counts"; of
// readings: "..; 3 components, signed; -100 to 100 N"
QString handSummaryOf(const HandDescription& hand) {
  const SensorLayout& layout = *hand.layout;
  QString summary = (layout.numMatrices() == 1 ? "matrix " : "matrices ") +
                    streamPageText(sizesText(layout)) + ", " +
                    streamPageText(counted(layout.numTaxels(), "taxel"));
  summary +=
      hand.axes.empty() ? "; no joints" : "; " + streamPageText(counted(hand.axes.size(), "joint"));
  if (!hand.temperatureSensors.empty())
    summary += ", " + streamPageText(counted(hand.temperatureSensors.size(), "temperature"));
  const std::string readings = readingsText(layout), most = numberText(hand.maximumCounts);
  if (!readings.empty()) summary += "; " + streamPageText(readings);
  const bool isSigned = std::ranges::any_of(
      layout.matrices(), [](const MatrixLayout& matrix) { return matrix.touch.isSigned; });
  return summary + "; " + streamPageText(isSigned ? "-" + most : "0") + " to " +
         streamPageText(most) + " " + streamPageText(hand.unit);
}

}  // namespace

StreamPage::StreamPage(const std::vector<std::filesystem::path>& handFolders,
                       PortScan& scan,
                       Ask& ask,
                       QWidget* parent)
    : QWidget(parent), folders_(handFolders) {
  form_ = new QFormLayout;
  form_->setContentsMargins(0, 0, 0, 0);
  form_->setHorizontalSpacing(12);
  form_->setVerticalSpacing(6);
  form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  source_ = new SourceField("stream", scan, this);
  source_->addPlaceTo(*form_);
  form_->addRow("&Hand", makeHand(ask));
  makeForm();
  setLayout(inColumn({form_, Stretch{}}));

  connect(source_, &SourceField::changed, this, &StreamPage::refresh);
  for (QComboBox* box : {hand_, format_, time_})
    connect(box, &QComboBox::currentIndexChanged, this, &StreamPage::refresh);
  setStream({});
}

// Disconnects the fields first: when one is destroyed with the keyboard focus, it emits that it was
// edited.
StreamPage::~StreamPage() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

QWidget* StreamPage::makeHand(Ask& ask) {
  hand_ = named(new QComboBox, "streamHand");
  hand_->setItemDelegate(new TwoLineDelegate(hand_));
  hand_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  for (const KnownHand& each : knownHands(folders_)) handIndex(streamPageText(each.key));
  hand_->setCurrentIndex(-1);
  hand_->setPlaceholderText("choose a hand");
  auto* choose = makeButton(nullptr, "streamHandFolder", "Choose f&older…");
  connect(choose, &QPushButton::clicked, this, [this, &ask] {
    const QString chosen = ask.folder("Folder of a hand (with its hand.json)", {});
    if (chosen.isEmpty()) return;
    // The folder may have been corrected since it was read.
    hands_.remove(chosen);
    hand_->setCurrentIndex(handIndex(chosen));
    refresh();
  });
  auto* whole = makeBox(
      inColumn({inRow({{hand_, 1}, choose}), markedLine(handMark_, handText_, "streamHandText")},
               Space::kNarrow),
      this);
  whole->setFocusProxy(hand_);
  return whole;
}

void StreamPage::makeForm() {
  format_ = named(new QComboBox(this), "streamFormat");
  format_->addItem("detected automatically", static_cast<int>(StreamFormat::kAuto));
  format_->addItem("lines of numbers", static_cast<int>(StreamFormat::kLines));
  format_->addItem("JSON", static_cast<int>(StreamFormat::kJson));
  format_->addItem("packets", static_cast<int>(StreamFormat::kBinary));
  time_ = named(new QComboBox(this), "streamTime");
  time_->setToolTip("The unit of time in lines of numbers; JSON and packets contain their own");
  time_->addItem("detected automatically", static_cast<int>(StreamTime::kAuto));
  time_->addItem("no time", static_cast<int>(StreamTime::kNone));
  time_->addItem("seconds", static_cast<int>(StreamTime::kSeconds));
  time_->addItem("milliseconds", static_cast<int>(StreamTime::kMilliseconds));
  time_->addItem("microseconds", static_cast<int>(StreamTime::kMicroseconds));
  form_->addRow("&Format", format_);
  form_->addRow("T&ime", time_);
  source_->addBaudTo(*form_);
}

// Adds the hand to the list, and begins to read it if it is not known yet.
int StreamPage::handIndex(const QString& nameOrFolder) {
  if (!hands_.contains(nameOrFolder)) read(nameOrFolder);
  const Choice& choice = hands_[nameOrFolder];
  int index = hand_->findData(nameOrFolder, kHandRole);
  if (index < 0) {
    index = hand_->count();
    hand_->addItem(nameOrFolder.section('/', -1));
    hand_->setItemData(index, nameOrFolder, kHandRole);
    hand_->setItemData(index, nameOrFolder, Qt::ToolTipRole);
  }
  hand_->setItemData(
      index, choice.fault.isEmpty() ? choice.summary : choice.fault, TwoLineDelegate::kDetailRole);
  return index;
}

void StreamPage::read(const QString& nameOrFolder) {
  hands_.insert(nameOrFolder, {{}, kHandBeingRead, true});
  auto& reading = readings_[nameOrFolder];
  if (!reading) reading = std::make_unique<FileReading>(this);
  const auto know = [this, nameOrFolder](const Choice& choice) {
    hands_[nameOrFolder] = choice;
    handIndex(nameOrFolder);
    refresh();
  };
  reading->start(
      [know, name = nameOrFolder.toStdString(), folders = folders_]() -> FileReading::Take {
        return [know, summary = handSummaryOf(findHand(name, folders))] {
          know({summary, {}, false});
        };
      },
      [know](const QString& fault) {
        know({{}, fault.simplified(), false});
      });
}

void StreamPage::setStream(const StreamConnection& stream) {
  source_->setSource(stream.source, stream.baud);
  hand_->setCurrentIndex(stream.hand.isEmpty() ? -1 : handIndex(stream.hand));
  format_->setCurrentIndex(format_->findData(static_cast<int>(stream.format)));
  time_->setCurrentIndex(time_->findData(static_cast<int>(stream.time)));
  refresh();
}

StreamConnection StreamPage::stream() const {
  StreamConnection stream;
  stream.source = source_->source();
  stream.hand = hand_->currentData(kHandRole).toString();
  stream.format = static_cast<StreamFormat>(format_->currentData().toInt());
  if (time_->isEnabled()) stream.time = static_cast<StreamTime>(time_->currentData().toInt());
  stream.baud = source_->baud();
  return stream;
}

QString StreamPage::problem() const {
  if (const QString wrong = source_->problem(); !wrong.isEmpty()) return wrong;
  const Choice hand = hands_.value(hand_->currentData(kHandRole).toString());
  if (hand.fault.isEmpty() || hand.beingRead) return hand.fault;
  return "This hand can't be used: " + hand.fault;
}

void StreamPage::refresh() {
  const auto format = static_cast<StreamFormat>(format_->currentData().toInt());
  time_->setEnabled(format == StreamFormat::kAuto || format == StreamFormat::kLines);

  const QString name = hand_->currentData(kHandRole).toString();
  const Choice choice = hands_.value(name);
  handText_->setText(name.isEmpty()           ? "The hand whose frames are sent."
                     : choice.fault.isEmpty() ? choice.summary
                                              : choice.fault);
  handMark_->setState(name.isEmpty()           ? StateMark::State::kNone
                      : choice.beingRead       ? StateMark::State::kNone
                      : choice.fault.isEmpty() ? StateMark::State::kGood
                                               : StateMark::State::kBad);
  emit changed();
}

}  // namespace palpate::gui
