#include "gui/connect/source_field.h"

#include <QComboBox>
#include <QFormLayout>
#include <QIntValidator>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QStackedWidget>
#include <stdexcept>

#include <palpate/device/stream_device.h>
#include <palpate/model/hand_file.h>

#include "gui/connect/port_field.h"
#include "gui/widgets/make.h"
#include "gui/widgets/state_mark.h"

namespace palpate::gui {
namespace {

constexpr int kUsualPort = 9871;
constexpr int kHighestPort = 65'535;
constexpr int kMinBaud = static_cast<int>(StreamDeviceOptions::kBaud.minimum);
constexpr int kMaxBaud = static_cast<int>(StreamDeviceOptions::kBaud.maximum);
constexpr const char* kTcp = "tcp:";
constexpr const char* kListenAt = "listen:";
constexpr const char* kUdpAt = "udp:";

// Whether other machines can send to the source; throws std::invalid_argument when it is malformed.
// Nothing is opened, and the hand does not matter.
bool isOpenToOthers(const QString& source) {
  return StreamDevice({.source = source.toStdString(), .hand = *builtInHands().front().hand})
      .isOpenToOthers();
}

QSpinBox* portBox(const QString& name, int least) {
  auto* box = named(new QSpinBox, name);
  box->setRange(least, kHighestPort);
  box->setValue(kUsualPort);
  if (least == 0) box->setSpecialValueText("any free one");
  return box;
}

}  // namespace

QWidget* markedLine(StateMark*& mark, QLabel*& label, const QString& name) {
  auto* line = new QWidget;
  mark = new StateMark(line);
  label = makeLines(line, name, "muted");
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  // Two lines, so that the layout does not change when the text wraps.
  label->setMinimumHeight(2 * label->fontMetrics().lineSpacing());
  line->setLayout(inRow({{mark, 0, Qt::AlignTop}, {label, 1}}));
  return line;
}

SourceField::SourceField(const QString& name, PortScan& scan, QWidget* parent)
    : QWidget(parent), name_(name), scan_(scan) {
  place_ = named(new QComboBox(parent), name + "Place");
  place_->addItems({"Serial port",
                    "TCP: connect to a sender",
                    "TCP: wait for a sender",
                    "UDP: wait for datagrams"});
  baud_ = named(new QComboBox(parent), name + "Baud");
  baud_->setEditable(true);
  baud_->setInsertPolicy(QComboBox::NoInsert);
  baud_->setCompleter(nullptr);
  baud_->setValidator(new QIntValidator(kMinBaud, kMaxBaud, baud_));
  for (const int each : {9600, 57'600, 115'200, 230'400, 460'800, 921'600, 1'000'000, 2'000'000})
    baud_->addItem(QString::number(each));
  makeFields();

  connect(place_, &QComboBox::currentIndexChanged, this, &SourceField::refresh);
  connect(port_, &PortField::changed, this, &SourceField::refresh);
  connect(host_, &QLineEdit::textChanged, this, &SourceField::refresh);
  connect(hostPort_, &QSpinBox::valueChanged, this, &SourceField::refresh);
  for (const Place place : {kListen, kUdp}) {
    connect(addresses_[place], &QLineEdit::textChanged, this, &SourceField::refresh);
    connect(ports_[place], &QSpinBox::valueChanged, this, &SourceField::refresh);
  }
  connect(baud_, &QComboBox::editTextChanged, this, &SourceField::refresh);
  connect(&scan_, &PortScan::portsListed, this, [this](const QList<ScannedPort>& ports) {
    port_->setChoices(ports);
    for (int i = 0; i < ports.size(); ++i)
      port_->setDetail(i,
                       QString::fromStdString(ports[i].info.description) +
                           (ports[i].info.readable ? "" : " · no permission to read it"));
  });
}

// Disconnects the fields first: when one is destroyed with the keyboard focus, it emits that it was
// edited.
SourceField::~SourceField() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

void SourceField::addPlaceTo(QFormLayout& form) {
  form.addRow("&Source", place_);
  form.addRow("", this);
}

void SourceField::addBaudTo(QFormLayout& form) {
  form.addRow("Bau&d rate", baud_);
  baudTitle_ = form.labelForField(baud_);
  refresh();
}

void SourceField::makeFields() {
  fields_ = new QStackedWidget(this);
  port_ = new PortField(
      "&Port", "Choose a port, or type the path of a device or of a pty.", name_, this);
  port_->box()->setToolTip("A port of the list, or another device such as /dev/pts/3");
  host_ = named(new QLineEdit, name_ + "Host");
  host_->setPlaceholderText("name or address of the machine that sends");
  hostPort_ = portBox(name_ + "HostPort", 1);
  auto* connection = makeBox(inRow({{host_, 1}, new QLabel("port"), hostPort_}), this);
  fields_->addWidget(port_);
  fields_->addWidget(connection);
  for (const Place place : {kListen, kUdp}) {
    const bool udp = place == kUdp;
    ports_[place] = portBox(name_ + (udp ? "UdpPort" : "ListenPort"), 0);
    addresses_[place] = new QLineEdit;
    addresses_[place]->setObjectName(name_ + (udp ? "UdpAddress" : "ListenAddress"));
    addresses_[place]->setPlaceholderText("this machine only");
    addresses_[place]->setToolTip(
        "Without an address only programs of this machine can send. With one, such as 0.0.0.0 or "
        "::, any machine that reaches it can");
    auto* awaiting = makeBox(
        inRow({new QLabel("port"), ports_[place], new QLabel("address"), {addresses_[place], 1}}),
        this);
    fields_->addWidget(awaiting);
  }
  setLayout(
      inColumn({fields_, markedLine(placeMark_, placeText_, name_ + "PlaceText")}, Space::kNarrow));
}

SourceField::Place SourceField::place() const { return static_cast<Place>(place_->currentIndex()); }

QString SourceField::source() const {
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

void SourceField::setSource(const QString& source, int baud) {
  baud_->setEditText(QString::number(baud));
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

int SourceField::baud() const { return baud_->currentText().toInt(); }

QString SourceField::problem() const {
  const QString source = this->source();
  if (source.isEmpty()) return {};
  if (place() == kSerial) {
    if (source == "-")
      return "Standard input can't be used in the window: choose a port of the list, TCP or UDP.";
    for (const char* prefix : {kTcp, kListenAt, kUdpAt})
      if (source.startsWith(prefix)) return "This is a network name: choose TCP or UDP as source.";
    if (baud() < kMinBaud || baud() > kMaxBaud)
      return QString("The baud rate must be between %1 and %2.").arg(kMinBaud).arg(kMaxBaud);
    return {};
  }
  try {
    isOpenToOthers(source);
  } catch (const std::invalid_argument& wrong) {
    return QString::fromUtf8(wrong.what()).simplified();
  }
  return {};
}

void SourceField::refresh() {
  const bool serial = place() == kSerial;
  // The other fields take no space.
  for (int i = 0; i < fields_->count(); ++i)
    fields_->widget(i)->setSizePolicy(QSizePolicy::Preferred,
                                      i == place() ? QSizePolicy::Maximum : QSizePolicy::Ignored);
  fields_->setCurrentIndex(place());
  baud_->setVisible(serial);
  if (baudTitle_) baudTitle_->setVisible(serial);

  const QString wrong = problem();
  QString where;
  bool open = false;
  if (!wrong.isEmpty()) {
    where = wrong;
  } else if (place() == kListen || place() == kUdp) {
    const QString port = ports_[place()]->value() == 0
                             ? "a free port, which the dock Link then shows"
                             : "port " + QString::number(ports_[place()]->value());
    open = isOpenToOthers(source());
    where = QString("Listening for ") + (place() == kUdp ? "datagrams" : "a sender") + " on " +
            port + ". " +
            (open ? "Any machine that reaches this address can send: there is neither a password "
                    "nor encryption."
                  : "Only programs of this machine can send.");
  } else if (serial) {
    where = "8 data bits, no parity, 1 stop bit. Nothing is sent to the device.";
  } else {
    where = host_->text().trimmed().isEmpty()
                ? "The machine and the port on which the sender listens."
                : "Palpate tries to connect until the sender answers.";
  }
  placeText_->setText(where);
  placeMark_->setState(!wrong.isEmpty() ? StateMark::State::kBad
                       : open           ? StateMark::State::kWarning
                                        : StateMark::State::kNone);
  emit changed();
}

}  // namespace palpate::gui
