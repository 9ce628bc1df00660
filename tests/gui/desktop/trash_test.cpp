// A new user has no trash yet: it is made.
#include "gui/desktop/trash.h"

#include <QDir>
#include <QFile>

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::trash_test {
namespace {

// The folder of the user's data is another one as long as this exists.
class DataHome {
 public:
  explicit DataHome(const QString& folder) : before_(qgetenv("XDG_DATA_HOME")) {
    qputenv("XDG_DATA_HOME", folder.toLocal8Bit());
  }
  ~DataHome() {
    if (before_.isEmpty())
      qunsetenv("XDG_DATA_HOME");
    else
      qputenv("XDG_DATA_HOME", before_);
  }
  DataHome(const DataHome&) = delete;
  DataHome& operator=(const DataHome&) = delete;

 private:
  QByteArray before_;
};

TEST(Trash, OfAUserWithoutOneIsMade) {
  const testing::TemporaryFolder folder;
  const QString root = QString::fromStdString(folder.path().string());
  const DataHome home(root + "/user/share");
  QFile file(root + "/take.palpate");
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.close();
  const QString before = QDir::currentPath();
  ASSERT_TRUE(QDir::setCurrent(root));
  const bool moved = moveFileToTrash(root + "/take.palpate");
  QDir::setCurrent(before);
  EXPECT_TRUE(moved);
  EXPECT_FALSE(QFile::exists(root + "/take.palpate"));
  EXPECT_TRUE(QFile::exists(root + "/user/share/Trash/files/take.palpate"));
  EXPECT_FALSE(QFile::exists(root + "/files")) << "not in the current directory";
}

TEST(Trash, WithoutAPlaceForOneNothingIsMoved) {
  const testing::TemporaryFolder folder;
  const QString root = QString::fromStdString(folder.path().string());
  // A file where the folder should be.
  QFile inTheWay(root + "/user");
  ASSERT_TRUE(inTheWay.open(QIODevice::WriteOnly));
  inTheWay.close();
  const DataHome home(root + "/user/share");
  QFile file(root + "/take.palpate");
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.close();
  EXPECT_FALSE(moveFileToTrash(root + "/take.palpate"));
  EXPECT_TRUE(QFile::exists(root + "/take.palpate"));
}

}  // namespace
}  // namespace palpate::gui::trash_test
