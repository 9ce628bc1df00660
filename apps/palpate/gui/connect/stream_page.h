// The page "Stream of frames" of the Connect dialog: where the stream of another hand comes from,
// which hand it is, and how its frames are written.
#pragma once

#include <QHash>
#include <QWidget>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/connect/port_scan.h"
#include "gui/connect/source_field.h"
#include "gui/source/connection.h"
#include "gui/source/file_reading.h"

class QComboBox;
class QFormLayout;
class QLabel;

namespace palpate::gui {

class Ask;
class StateMark;

class StreamPage : public QWidget {
  Q_OBJECT
 public:
  // `handFolders`: where hands are looked for by name; their files are read here. `scan` must
  // outlive this.
  StreamPage(const std::vector<std::filesystem::path>& handFolders,
             PortScan& scan,
             Ask& ask,
             QWidget* parent);
  ~StreamPage() override;

  void setStream(const StreamConnection& stream);
  StreamConnection stream() const;
  // A problem that problemOf() cannot detect, in one line: a source or a hand that can't be used.
  // Empty when there is none.
  QString problem() const;
  void look() { source_->look(); }

 signals:
  void changed();

 private:
  // What is known about a hand of the list.
  struct Choice {
    // Empty when the hand can't be used.
    QString summary;
    // What is wrong, in one line; empty when the hand can be used.
    QString fault;
    // That is why it can't be used yet.
    bool beingRead = false;
  };

  QWidget* makeHand(Ask& ask);
  void makeForm();
  int handIndex(const QString& nameOrFolder);
  void read(const QString& nameOrFolder);
  void refresh();

  std::vector<std::filesystem::path> folders_;
  QHash<QString, Choice> hands_;
  std::map<QString, std::unique_ptr<FileReading>> readings_;
  QFormLayout* form_;
  SourceField* source_;
  QComboBox* hand_;
  StateMark* handMark_;
  QLabel* handText_;
  QComboBox* format_;
  QComboBox* time_;
};

}  // namespace palpate::gui
