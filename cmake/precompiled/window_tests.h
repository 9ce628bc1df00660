// What the tests of the window read.
#include <QDockWidget>
#include <QSignalSpy>
#include <QTest>
#include <random>

#include <gtest/gtest.h>

#include "window.h"
