#include "gui/picture/ffmpeg.h"

#include <algorithm>

#include <palpate/core/error.h>

#include "testing/fake_ffmpeg.h"

namespace palpate::gui::ffmpeg_test {
namespace {

using testing::FakeFfmpeg;

// As ffmpeg 5.1 prints it.
const std::string kHead =
    "Encoders:\n V..... = Video\n A..... = Audio\n S..... = Subtitle\n .F.... = Frame-level "
    "multithreading\n ------\n";

TEST(Ffmpeg, TakesH264WhereItIs) {
  EXPECT_EQ(encoderFrom(kHead + " V..... libx264rgb           libx264 H.264 RGB (codec h264)\n"
                                " V.S..D mpeg4                MPEG-4 part 2\n"
                                " V....D libx264              libx264 H.264 / AVC\n"),
            "libx264");
  EXPECT_EQ(encoderFrom(kHead + " V....D libxvid              like mpeg4\n"
                                " V.S..D mpeg4                MPEG-4 part 2\n"),
            "mpeg4");
  EXPECT_EQ(encoderFrom(kHead + " A....D aac                  libx264 mpeg4\n"), "");
  EXPECT_EQ(encoderFrom(""), "");
}

TEST(Ffmpeg, AsksTheProgram) {
  const FakeFfmpeg fake(FakeFfmpeg::kGood, " V.S..D mpeg4  x\\n");
  EXPECT_EQ(encoderOf(*findFfmpeg()), "mpeg4");
  const FakeFfmpeg none(FakeFfmpeg::kGood, " V..... gif  x\\n");
  try {
    encoderOf(*findFfmpeg());
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("neither the encoder libx264 nor mpeg4"),
              std::string::npos)
        << error.what();
  }
}

bool hasInARow(const std::vector<std::string>& words, const std::vector<std::string>& row) {
  return std::search(words.begin(), words.end(), row.begin(), row.end()) != words.end();
}

TEST(Ffmpeg, IsToldWhatComesAndWhatShallBe) {
  const auto words = ffmpegArguments("libx264", {640, 480}, 29.97, "a \"b\" 'c'");
  EXPECT_TRUE(hasInARow(words, {"-f", "rawvideo", "-pix_fmt", "bgr0", "-s", "640x480"}));
  EXPECT_TRUE(hasInARow(words, {"-r", "29.97", "-i", "pipe:0"}));
  EXPECT_TRUE(hasInARow(words, {"-c:v", "libx264"}));
  EXPECT_TRUE(hasInARow(words, {"-pix_fmt", "yuv420p"}));
  EXPECT_TRUE(hasInARow(words, {"-metadata", "title=a \"b\" 'c'"}));
  EXPECT_TRUE(hasInARow(words, {"-f", "mp4", "/proc/self/fd/3"}));
  EXPECT_EQ(words.back(), "/proc/self/fd/3");
  EXPECT_TRUE(hasInARow(ffmpegArguments("mpeg4", {2, 2}, 30.0, ""), {"-c:v", "mpeg4", "-q:v"}));
}

TEST(Ffmpeg, ItsLastLineThatSaysSomething) {
  EXPECT_EQ(lastError("a\nav_interleaved_write_frame(): No space left on device\n"
                      "Conversion failed!\n\n"),
            "av_interleaved_write_frame(): No space left on device");
  EXPECT_EQ(lastError("Error writing trailer of /proc/self/fd/3: Disk quota exceeded \r\n"),
            "Error writing trailer of the movie: Disk quota exceeded");
  EXPECT_EQ(lastError("a\n \t no such encoder\t\r\n"), "no such encoder");
  EXPECT_EQ(lastError(" \n\n"), "");
}

TEST(Ffmpeg, IsFoundWhereItIs) {
  const testing::TemporaryFolder folder;
  const QByteArray path = qgetenv("PATH");
  {
    const FakeFfmpeg fake;  // so that the variable is set back
    qputenv("PALPATE_FFMPEG", "/no/such/ffmpeg");
    EXPECT_FALSE(findFfmpeg());
    EXPECT_EQ(ffmpegMissing(), "PALPATE_FFMPEG doesn't name a program: /no/such/ffmpeg");
    qputenv("PALPATE_FFMPEG", QByteArray::fromStdString(folder.path().string()));
    EXPECT_FALSE(findFfmpeg()) << "a folder";
    qunsetenv("PALPATE_FFMPEG");
    qputenv("PATH", QByteArray::fromStdString(folder.path().string()));
    EXPECT_FALSE(findFfmpeg());
    EXPECT_NE(ffmpegMissing().find("apt install ffmpeg"), std::string::npos);
    EXPECT_NE(ffmpegMissing().find("PNG"), std::string::npos) << "what works without it";
    testing::writeFile(folder / "ffmpeg", "#!/bin/sh\n");
    EXPECT_FALSE(findFfmpeg()) << "not to be executed";
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    EXPECT_EQ(findFfmpeg(), folder / "ffmpeg");
  }
  qputenv("PATH", path);
}

}  // namespace
}  // namespace palpate::gui::ffmpeg_test
