#include "gui/connect/stream_page.h"

#include <QComboBox>
#include <QFormLayout>
#include <QIntValidator>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <stdexcept>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/device/stream_device.h>
#include <palpate/model/hand_file.h>

#include "gui/appearance/captions.h"
#include "gui/connect/port_field.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/make.h"
#include "gui/widgets/state_mark.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui {
namespace {

constexpr int kUsualPort = 9871;
constexpr int kHighestPort = 65'535;
constexpr int kLeastBaud = 50, kMostBaud = 10'000'000;
constexpr int kHandRole = Qt::UserRole + 2;  // in the form that findHand() takes
constexpr const char* kHandBeingRead = "The hand is being read.";
constexpr const char* kTcp = "tcp:";
constexpr const char* kListenAt = "listen:";
constexpr const char* kUdpAt = "udp:";

QString streamPageText(const std::string& of) { return QString::fromStdString(of); }

// "matrices 3 x 14x6, 3 x 13x6, 456 taxels; 7 joints, 10 temperatures; 0 to 4095 counts"
QString handSummaryOf(const HandDescription& hand) {
  const SensorLayout& layout = *hand.layout;
  QString summary = (layout.numMatrices() == 1 ? "matrix " : "matrices ") +
                    streamPageText(sizesText(layout)) + ", " +
                    streamPageText(counted(layout.numTaxels(), "taxel"));
  summary +=
      hand.axes.empty() ? "; no joints" : "; " + streamPageText(counted(hand.axes.size(), "joint"));
  if (!hand.temperatureSensors.empty())
    summary += ", " + streamPageText(counted(hand.temperatureSensors.size(), "temperature"));
  return summary + "; 0 to " + streamPageText(numberText(hand.maximumCounts)) + " " +
         streamPageText(hand.unit);
}

// A line of text with a mark in front of it.
QWidget* markedLine(StateMark*& mark, QLabel*& label, const char* name) {
  auto* line = new QWidget;
  mark = new StateMark(line);
  label = makeLines(line, name, "muted");
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  // Two lines, so that the layout does not change when the text wraps.
  label->setMinimumHeight(2 * label->fontMetrics().lineSpacing());
  line->setLayout(inRow({{mark, 0, Qt::AlignTop}, {label, 1}}));
  return line;
}

// Whether other machines can send to the source; throws std::invalid_argument when it is malformed.
// Nothing is opened, and the hand does not matter.
bool isOpenToOthers(const QString& source) {
  return StreamDevice({.source = source.toStdString(), .hand = *builtInHands().front().hand})
      .isOpenToOthers();
}

QSpinBox* portBox(const char* name, int least) {
  auto* box = named(new QSpinBox, name);
  box->setRange(least, kHighestPort);
  box->setValue(kUsualPort);
  if (least == 0) box->setSpecialValueText("any free one");
  return box;
}

}  // namespace

StreamPage::StreamPage(const std::vector<std::filesystem::path>& handFolders,
                       PortScan& scan,
                       Ask& ask,
                       QWidget* parent)
    : QWidget(parent), folders_(handFolders), scan_(scan) {
  form_ = new QFormLayout;
  form_->setContentsMargins(0, 0, 0, 0);
  form_->setHorizontalSpacing(12);
  form_->setVerticalSpacing(6);
  form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  place_ = named(new QComboBox(this), "streamPlace");
  place_->addItems({"Serial port",
                    "TCP: connect to a sender",
                    "TCP: wait for a sender",
                    "UDP: wait for datagrams"});
  form_->addRow("&Source", place_);
  form_->addRow("", makePlace());
  form_->addRow("&Hand", makeHand(ask));
  makeForm();
  setLayout(inColumn({form_, Stretch{}}));

  connect(place_, &QComboBox::currentIndexChanged, this, &StreamPage::refresh);
  connect(port_, &PortField::changed, this, &StreamPage::refresh);
  connect(host_, &QLineEdit::textChanged, this, &StreamPage::refresh);
  connect(hostPort_, &QSpinBox::valueChanged, this, &StreamPage::refresh);
  for (const Place place : {kListen, kUdp}) {
    connect(addresses_[place], &QLineEdit::textChanged, this, &StreamPage::refresh);
    connect(ports_[place], &QSpinBox::valueChanged, this, &StreamPage::refresh);
  }
  for (QComboBox* box : {hand_, format_, time_})
    connect(box, &QComboBox::currentIndexChanged, this, &StreamPage::refresh);
  connect(baud_, &QComboBox::editTextChanged, this, &StreamPage::refresh);
  connect(&scan_, &PortScan::portsListed, this, [this](const QList<ScannedPort>& ports) {
    port_->setChoices(ports);
    for (int i = 0; i < ports.size(); ++i)
      port_->setDetail(i,
                       streamPageText(ports[i].info.description) +
                           (ports[i].info.readable ? "" : " · no permission to read it"));
  });
  setStream({});
}

// Disconnects the fields first: when one is destroyed with the keyboard focus, it emits that it was
// edited.
StreamPage::~StreamPage() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

QWidget* StreamPage::makePlace() {
  fields_ = new QStackedWidget(this);
  port_ = new PortField(
      "&Port", "Choose a port, or type the path of a device or of a pty.", "stream", this);
  port_->box()->setToolTip("A port of the list, or another device such as /dev/pts/3");
  host_ = named(new QLineEdit, "streamHost");
  host_->setPlaceholderText("name or address of the machine that sends");
  hostPort_ = portBox("streamHostPort", 1);
  auto* connection = makeBox(inRow({{host_, 1}, new QLabel("port"), hostPort_}), this);
  fields_->addWidget(port_);
  fields_->addWidget(connection);
  for (const Place place : {kListen, kUdp}) {
    const bool udp = place == kUdp;
    ports_[place] = portBox(udp ? "streamUdpPort" : "streamListenPort", 0);
    addresses_[place] = new QLineEdit;
    addresses_[place]->setObjectName(udp ? "streamUdpAddress" : "streamListenAddress");
    addresses_[place]->setPlaceholderText("this machine only");
    addresses_[place]->setToolTip(
        "Without an address only programs of this machine can send. With one, such as 0.0.0.0 or "
        "::, any machine that reaches it can");
    auto* awaiting = makeBox(
        inRow({new QLabel("port"), ports_[place], new QLabel("address"), {addresses_[place], 1}}),
        this);
    fields_->addWidget(awaiting);
  }
  return makeBox(
      inColumn({fields_, markedLine(placeMark_, placeText_, "streamPlaceText")}, Space::kNarrow),
      this);
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
  format_->addItem("found by itself", static_cast<int>(StreamFormat::kAuto));
  format_->addItem("lines of numbers", static_cast<int>(StreamFormat::kLines));
  format_->addItem("JSON", static_cast<int>(StreamFormat::kJson));
  format_->addItem("packets", static_cast<int>(StreamFormat::kBinary));
  time_ = named(new QComboBox(this), "streamTime");
  time_->setToolTip("The unit of time in lines of numbers; JSON and packets contain theirs");
  time_->addItem("found by itself", static_cast<int>(StreamTime::kAuto));
  time_->addItem("no time", static_cast<int>(StreamTime::kNone));
  time_->addItem("seconds", static_cast<int>(StreamTime::kSeconds));
  time_->addItem("milliseconds", static_cast<int>(StreamTime::kMilliseconds));
  time_->addItem("microseconds", static_cast<int>(StreamTime::kMicroseconds));
  baud_ = named(new QComboBox(this), "streamBaud");
  baud_->setEditable(true);
  baud_->setInsertPolicy(QComboBox::NoInsert);
  baud_->setCompleter(nullptr);
  baud_->setValidator(new QIntValidator(kLeastBaud, kMostBaud, baud_));
  for (const int each : {9600, 57'600, 115'200, 230'400, 460'800, 921'600, 1'000'000, 2'000'000})
    baud_->addItem(QString::number(each));
  form_->addRow("&Format", format_);
  form_->addRow("T&ime", time_);
  form_->addRow("Bau&d rate", baud_);
  baudRow_ = form_->labelForField(baud_);
}

StreamPage::Place StreamPage::place() const { return static_cast<Place>(place_->currentIndex()); }

QString StreamPage::source() const {
  switch (place()) {
    case kSerial:
      return port_->port();
    case kConnect: {
      const QString host = host_->text().trimmed();
      return host.isEmpty() ? QString() : kTcp + host + ":" + QString::number(hostPort_->value());
    }
    case kListen:
    case kUdp:
      break;
  }
  QString address = addresses_[place()]->text().trimmed();
  if (address.contains(':') && !address.startsWith('[')) address = "[" + address + "]";
  return (place() == kUdp ? kUdpAt : kListenAt) + (address.isEmpty() ? address : address + ":") +
         QString::number(ports_[place()]->value());
}

void StreamPage::setSource(const QString& source) {
  const auto portAndAddress = [](const QString& rest) {
    const qsizetype colon = rest.lastIndexOf(':');
    return std::pair(rest.mid(colon + 1).toInt(), colon < 0 ? QString() : rest.left(colon));
  };
  if (source.startsWith(kTcp)) {
    place_->setCurrentIndex(kConnect);
    const auto [port, host] = portAndAddress(source.mid(4));
    host_->setText(host);
    hostPort_->setValue(port);
    return;
  }
  for (const auto& [place, prefix] : {std::pair(kListen, kListenAt), std::pair(kUdp, kUdpAt)}) {
    if (!source.startsWith(prefix)) continue;
    place_->setCurrentIndex(place);
    const auto [port, address] = portAndAddress(source.mid(QString(prefix).size()));
    addresses_[place]->setText(address);
    ports_[place]->setValue(port);
    return;
  }
  place_->setCurrentIndex(kSerial);
  port_->setPort(source);
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
  setSource(stream.source);
  hand_->setCurrentIndex(stream.hand.isEmpty() ? -1 : handIndex(stream.hand));
  format_->setCurrentIndex(format_->findData(static_cast<int>(stream.format)));
  time_->setCurrentIndex(time_->findData(static_cast<int>(stream.time)));
  baud_->setEditText(QString::number(stream.baud));
  refresh();
}

StreamConnection StreamPage::stream() const {
  StreamConnection stream;
  stream.source = source();
  stream.hand = hand_->currentData(kHandRole).toString();
  stream.format = static_cast<StreamFormat>(format_->currentData().toInt());
  if (time_->isEnabled()) stream.time = static_cast<StreamTime>(time_->currentData().toInt());
  stream.baud = baud_->currentText().toInt();
  return stream;
}

QString StreamPage::sourceProblem() const {
  const QString source = this->source();
  if (source.isEmpty()) return {};
  if (place() == kSerial) {
    if (source == "-")
      return "Standard input can't be used in the window: choose a port of the list, TCP or UDP.";
    for (const char* prefix : {kTcp, kListenAt, kUdpAt})
      if (source.startsWith(prefix)) return "This is a network name: choose TCP or UDP as source.";
    const int baud = baud_->currentText().toInt();
    if (baud < kLeastBaud || baud > kMostBaud)
      return "The baud rate must be between 50 and 10000000.";
    return {};
  }
  try {
    isOpenToOthers(source);
  } catch (const std::invalid_argument& wrong) {
    return QString::fromUtf8(wrong.what()).simplified();
  }
  return {};
}

QString StreamPage::problem() const {
  if (const QString wrong = sourceProblem(); !wrong.isEmpty()) return wrong;
  const Choice hand = hands_.value(hand_->currentData(kHandRole).toString());
  if (hand.fault.isEmpty() || hand.beingRead) return hand.fault;
  return "This hand can't be used: " + hand.fault;
}

void StreamPage::look() { scan_.listOnly(); }

void StreamPage::refresh() {
  const bool serial = place() == kSerial;
  // The other fields take no space.
  for (int i = 0; i < fields_->count(); ++i)
    fields_->widget(i)->setSizePolicy(QSizePolicy::Preferred,
                                      i == place() ? QSizePolicy::Maximum : QSizePolicy::Ignored);
  fields_->setCurrentIndex(place());
  baud_->setVisible(serial);
  baudRow_->setVisible(serial);
  const auto format = static_cast<StreamFormat>(format_->currentData().toInt());
  time_->setEnabled(format == StreamFormat::kAuto || format == StreamFormat::kLines);

  const QString wrong = sourceProblem();
  QString where;
  bool open = false;
  if (!wrong.isEmpty()) {
    where = wrong;
  } else if (place() == kListen || place() == kUdp) {
    const QString port = ports_[place()]->value() == 0
                             ? "a free port, which the dock Link then shows"
                             : "port " + QString::number(ports_[place()]->value());
    open = isOpenToOthers(source());
    where = QString(place() == kUdp ? "Datagrams are" : "A sender is") + " awaited at " + port +
            ". " +
            (open ? "Any machine that reaches this address can send: there is neither a password "
                    "nor encryption."
                  : "Only programs of this machine can send.");
  } else if (serial) {
    where = "8 data bits, no parity, 1 stop bit. Nothing is sent to the device.";
  } else {
    where = host_->text().trimmed().isEmpty()
                ? "The machine and the port at which the sender waits."
                : "Palpate tries to connect until the sender answers.";
  }
  placeText_->setText(where);
  placeMark_->setState(!wrong.isEmpty() ? StateMark::State::kBad
                       : open           ? StateMark::State::kWarning
                                        : StateMark::State::kNone);
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
