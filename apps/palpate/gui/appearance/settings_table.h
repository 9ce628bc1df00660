// The fields of a struct in the settings: one function names each of them with its key and range,
// for loading and for saving.
//
//   void fieldsOf(SettingsTable& table, Look& look) {
//     table.flag("look/axes", look.axes);
//     table.number("look/width", look.width, 0.5, 9.0);
//   }
//   const auto look = loadFields<Look>(settings, fieldsOf);
//   saveFields(settings, look, fieldsOf);
//
// A field for which the settings have no value that makes sense (not a number, out of range, an
// unknown name, a text with a NUL) keeps that of a default-constructed struct.
#pragma once

#include <QSettings>
#include <QString>
#include <QStringList>
#include <array>
#include <functional>
#include <optional>
#include <type_traits>

namespace palpate::gui {

// Empty where the value is missing, not a number, or outside minimum..maximum.
inline std::optional<double> storedNumber(const QSettings& settings,
                                          const QString& key,
                                          double minimum,
                                          double maximum) {
  bool isNumber = false;
  const double number = settings.value(key).toDouble(&isNumber);
  return isNumber && number >= minimum && number <= maximum ? std::optional(number) : std::nullopt;
}

class SettingsTable {
 public:
  // Saves `into`, or loads `from` where that is null. `group` stands before each key.
  SettingsTable(const QSettings& from, QSettings* into, const QString& group)
      : from_(from), into_(into), group_(group) {}

  void flag(const QString& key, bool& value) { any(key, value); }
  void texts(const QString& key, QStringList& value) { any(key, value); }
  // `fits`: whether a text makes sense; null: each does.
  void text(const QString& key,
            QString& value,
            const std::function<bool(const QString&)>& fits = {}) {
    QString kept = value;
    any(key, kept);
    if (!kept.contains(QChar('\0')) && (!fits || fits(kept))) value = kept;
  }
  // A whole number, one with decimals, or an enumeration, which is stored as its number.
  template <class Number>
  void number(const QString& key, Number& value, double minimum, double maximum) {
    if constexpr (std::is_floating_point_v<Number>) {
      if (into_) return into_->setValue(group_ + key, value);
    } else if (into_) {
      return into_->setValue(group_ + key, static_cast<qlonglong>(value));
    }
    if (const auto kept = storedNumber(from_, group_ + key, minimum, maximum))
      value = static_cast<Number>(*kept);
  }
  // An empty value removes the key.
  void number(const QString& key, std::optional<double>& value, double minimum, double maximum) {
    if (!into_)
      value = storedNumber(from_, group_ + key, minimum, maximum);
    else if (value)
      into_->setValue(group_ + key, *value);
    else
      into_->remove(group_ + key);
  }
  // One of `all`, stored as its nameOf().
  template <class Value, class All>
  void choice(const QString& key, Value& value, const All& all) {
    if (into_) return into_->setValue(group_ + key, QString(nameOf(value)));
    const QString name = from_.value(group_ + key).toString();
    for (const Value each : all)
      if (name == nameOf(each)) value = each;
  }
  // The same with the names of the values 0, 1, ..
  template <class Value, std::size_t kCount>
  void choice(const QString& key, Value& value, const std::array<const char*, kCount>& names) {
    if (into_)
      return into_->setValue(group_ + key, QString(names[static_cast<std::size_t>(value)]));
    const QString name = from_.value(group_ + key).toString();
    for (std::size_t i = 0; i < kCount; ++i)
      if (name == names[i]) value = static_cast<Value>(i);
  }

 private:
  template <class Value>
  void any(const QString& key, Value& value) {
    if (into_) return into_->setValue(group_ + key, value);
    const QVariant kept = from_.value(group_ + key);
    if (kept.canConvert<Value>()) value = kept.value<Value>();
  }

  const QSettings& from_;
  QSettings* into_;
  QString group_;
};

template <class Struct, class Fields>
Struct loadFields(const QSettings& settings, const Fields& fieldsOf, const QString& group = {}) {
  Struct loaded{};
  SettingsTable table(settings, nullptr, group);
  fieldsOf(table, loaded);
  return loaded;
}

template <class Struct, class Fields>
void saveFields(QSettings& settings,
                Struct values,
                const Fields& fieldsOf,
                const QString& group = {}) {
  SettingsTable table(settings, &settings, group);
  fieldsOf(table, values);
}

}  // namespace palpate::gui
