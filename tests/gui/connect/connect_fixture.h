// The Connect dialog over made-up ports, and what a test does with it.
#pragma once

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "gui/connect/connect_dialog.h"
#include "gui/connect/fake_ports.h"
#include "gui/source/file_reading.h"
#include "gui/testing/fake_ask.h"
#include "gui/testing/make_active.h"
#include "testing/testing.h"

namespace palpate::gui {

inline constexpr int kPatienceMs = 10'000;
inline constexpr const char* kTactileLink = "/dev/serial/by-id/usb-FTDI_tactile-if00";
inline constexpr const char* kMotionLink = "/dev/serial/by-id/usb-FTDI_motion-if00";
inline constexpr const char* kTactile = "/dev/palpate-test-1";
inline constexpr const char* kMotion = "/dev/palpate-test-0";

class ConnectDialogTest : public ::testing::Test {
 protected:
  ConnectDialogTest() : scan_(std::make_unique<PortScan>(fake_.functions())) {}
  ~ConnectDialogTest() override {
    dialog_.reset();
    scan_.reset();
  }

  void plugIn() {
    fake_.list({usbPort(kMotion, kMotionLink), usbPort(kTactile, kTactileLink)});
    fake_.answer(kTactile, tactileAnswer());
    fake_.answer(kMotion, motionAnswer());
  }
  ConnectDialog& open(const Connection& last, const QStringList& recent = {}) {
    dialog_.reset();
    dialog_ = std::make_unique<ConnectDialog>(ConnectChoices{.last = last,
                                                             .scenesFolder = scenesFolder_,
                                                             .handFolders = handFolders_,
                                                             .recentRecordings = recent},
                                              *scan_,
                                              ask_,
                                              nullptr);
    showRead();
    makeActive(*dialog_);
    return *dialog_;
  }
  void openWith(QSettings& settings, const Connection& last) {
    dialog_.reset();
    dialog_ = std::make_unique<ConnectDialog>(ConnectChoices{.last = last,
                                                             .scenesFolder = scenesFolder_,
                                                             .handFolders = handFolders_,
                                                             .settings = &settings},
                                              *scan_,
                                              ask_,
                                              nullptr);
    showRead();
  }
  // With the hands and scenes already read; no port is asked before it is shown.
  void showRead() {
    FileReading::settleAll(*dialog_);
    dialog_->show();
  }
  ConnectDialog& openPorts(const QString& tactile = {}, const QString& motion = {}) {
    open({.kind = Connection::Kind::kPorts, .dsaPort = tactile, .sdhPort = motion});
    return *dialog_;
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = dialog_->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("no ") + name);
    return found;
  }
  QString port(const char* name) { return find<QComboBox>(name)->currentText(); }
  QString text(const char* name) { return find<QLabel>(name)->text(); }
  bool canConnect() { return find<QPushButton>("connectNow")->isEnabled(); }
  void click(const char* name) { QTest::mouseClick(find<QPushButton>(name), Qt::LeftButton); }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus ? focus : dialog_.get(), key, modifiers);
  }
  void type(const char* box, const QString& text) {
    QLineEdit* line = find<QComboBox>(box)->lineEdit();
    line->setFocus();
    line->selectAll();
    QTest::keyClick(line, Qt::Key_Delete);
    QTest::keyClicks(line, text);
  }
  // Also what a button's key does: the button is shown pressed for a moment first.
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, kPatienceMs);
  }
  bool awaitAnswers() {
    return await([this] { return !fake_.asked().empty() && !scan_->running(); });
  }
  QString file(const char* name, std::string_view content) {
    testing::writeFile(folder_ / name, content);
    return QString::fromStdString((folder_ / name).string());
  }

  const testing::TemporaryFolder folder_;
  std::vector<std::filesystem::path> handFolders_ = {};
  std::filesystem::path scenesFolder_ = testing::dataFolder() / "scenes";
  FakePorts fake_;
  FakeAsk ask_;
  std::unique_ptr<PortScan> scan_;
  std::unique_ptr<ConnectDialog> dialog_;
};

}  // namespace palpate::gui
