// Items that a user has given a name, kept in the settings as texts: one key for each in a group.
#pragma once

#include <QSettings>
#include <QString>
#include <QStringList>
#include <QUrl>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <palpate/core/error.h>

namespace palpate::gui {

// A name as part of a key, which must not contain '/'.
inline QString keyPartOf(const QString& name) {
  return QString::fromLatin1(QUrl::toPercentEncoding(name));
}

// The names in alphabetical order.
inline QStringList namesOfKeys(const QStringList& keys) {
  QStringList names;
  for (const QString& key : keys) names << QUrl::fromPercentEncoding(key.toLatin1());
  names.sort(Qt::CaseInsensitive);
  return names;
}

template <class Item>
class NamedItems {
 public:
  // `settings` must outlive this. `read` makes an item of its text, or throws Error.
  NamedItems(QSettings& settings,
             const QString& group,
             std::function<std::string(const Item&)> text,
             std::function<Item(const std::string&)> read)
      : settings_(settings), group_(group), text_(std::move(text)), read_(std::move(read)) {}

  // In alphabetical order.
  QStringList names() const {
    settings_.beginGroup(group_);
    const QStringList keys = settings_.childKeys();
    settings_.endGroup();
    return namesOfKeys(keys);
  }
  // Replaces an item of the same name.
  void save(const QString& name, const Item& item) {
    settings_.setValue(keyOf(name), QString::fromStdString(text_(item)));
  }
  // Nothing when there is none of this name, or its text can't be read.
  std::optional<Item> load(const QString& name) const {
    try {
      return read_(settings_.value(keyOf(name)).toString().toStdString());
    } catch (const Error&) {
      return std::nullopt;
    }
  }
  void remove(const QString& name) { settings_.remove(keyOf(name)); }

 private:
  QString keyOf(const QString& name) const { return group_ + "/" + keyPartOf(name); }

  QSettings& settings_;
  QString group_;
  std::function<std::string(const Item&)> text_;
  std::function<Item(const std::string&)> read_;
};

}  // namespace palpate::gui
