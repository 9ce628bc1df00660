// The panel of the dock Recognise by itself, on grasps of the emulated hand.
#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QStandardPaths>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"

#include "gui/recognise/answer_view.h"
#include "gui/recognise/ask_page.h"
#include "gui/recognise/check_page.h"
#include "gui/recognise/confusion_view.h"
#include "gui/recognise/recognise_fixture.h"
#include "gui/recognise/today_page.h"
#include "gui/recognise/training_page.h"
#include "gui/source/file_reading.h"
#include "gui/widgets/figures_table.h"

namespace palpate::gui::recognise_panel_test {
namespace {

using Kind = RecognitionAnswer::Kind;

TEST_F(RecognisePanelTest, WithoutAModelItSaysSo) {
  panel_->controller().setEmulated(false);
  settle();
  panel_->controller().ask({graspsOf("pen", 1), std::nullopt, "a pen"});
  settle();
  EXPECT_EQ(panel_->controller().answer().kind, Kind::kProblem);
  EXPECT_TRUE(panel_->controller().answer().text.startsWith("No model is chosen."));
  EXPECT_EQ(find<QLabel>("recogniseModel")->text(), "no model");
  EXPECT_FALSE(find<QPushButton>("tell")->isEnabled());
  EXPECT_TRUE(find<QPushButton>("tell")->toolTip().contains("without a model"));
}

TEST_F(RecognisePanelTest, NamesAGraspWithItsRunnersUp) {
  panel_->controller().setEmulated(true);
  panel_->controller().ask(
      {graspsOf("pen", 1), std::nullopt, "a pen"});  // the model is still being read
  settle();
  const RecognitionAnswer& answer = panel_->controller().answer();
  EXPECT_EQ(answer.kind, Kind::kNamed) << answer.text.toStdString();
  EXPECT_EQ(answer.name(), "pen");
  EXPECT_EQ(answer.confidenceWord(), "sure");
  ASSERT_EQ(answer.best.size(), 3u);
  EXPECT_GT(answer.best[0].p, 0.9);
  EXPECT_GE(answer.best[1].p, answer.best[2].p);
  EXPECT_EQ(answer.offset, "session offset 0 mm: the emulated hand has none");
  EXPECT_EQ(find<AnswerView>("answerView")->answer().name(), "pen");
  EXPECT_EQ(find<QComboBox>("tellClass")->currentText(), "pen");
}

TEST_F(RecognisePanelTest, WhatCanNotBeJudgedIsSaid) {
  panel_->controller().setEmulated(true);
  settle();
  const Profile pen = graspsOf("pen", 1);
  const auto troubleOf = [&](const RecogniseQuestion& question) {
    panel_->controller().ask(question);
    settle();
    EXPECT_EQ(panel_->controller().answer().kind, Kind::kProblem);
    return panel_->controller().answer().text.toStdString();
  };
  EXPECT_NE(troubleOf({pen, std::pair<std::size_t, std::size_t>(0, 15), ""}).find("No grasp"),
            std::string::npos);
  ProfileBuilder noAngles(sdh2().layout);
  for (std::size_t i = 0; i < pen.numFrames(); ++i)
    noAngles.addFrame(pen.frameTimeUs(i), pen.frame(i).values);
  EXPECT_NE(troubleOf({noAngles.finish({}), std::nullopt, ""}).find("joint angles"),
            std::string::npos);
  const auto pad = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(4, 4, 3.4)});
  ProfileBuilder other(pad);
  other.addFrame(1000, std::vector<float>(16, 1.0F));
  EXPECT_NE(troubleOf({other.finish({}), std::nullopt, ""}).find("another sensor"),
            std::string::npos);
  testing::writeFile(folder_ / "damaged.json", "{\"kind\": \"palpate");
  panel_->controller().openModel(folder_ / "damaged.json");
  settle();
  EXPECT_NE(find<QLabel>("recogniseModel")->text().indexOf("can't be used"), -1);
  EXPECT_EQ(panel_->controller().answer().kind, Kind::kProblem);
}

TEST_F(RecognisePanelTest, WhatWasHeldTooShortIsNotSaidOfAnEmptyHand) {
  panel_->controller().setEmulated(true);
  settle();
  panel_->controller().showProblem("The object was not held long enough: try again in a second.",
                                   kHeldNow);
  panel_->controller().contactEnded();
  EXPECT_EQ(panel_->controller().answer().kind, Kind::kNothing);
  EXPECT_EQ(find<AnswerView>("answerView")->answer().kind, Kind::kNothing);
  EXPECT_FALSE(panel_->controller().answer().text.contains("not held long enough"));
}

TEST_F(RecognisePanelTest, WithoutAnOffsetTheReasonNamesTheTouchThatWouldTell) {
  panel_->controller().setEmulated(true);
  settle();
  panel_->controller().changeSession([](RecognitionSession& session) {
    session.choose({OffsetChoice::Kind::kNone, 0.0});
  });
  panel_->controller().ask({graspsOf("pen", 1), std::nullopt, ""});
  settle();
  EXPECT_EQ(panel_->controller().session()->offset().origin, OffsetSource::kUnknown);
  const QString reason = panel_->controller().answer().unsure;
  EXPECT_TRUE(reason.contains("can't be known yet")) << reason.toStdString();
  EXPECT_TRUE(reason.contains("label grasps of two objects")) << reason.toStdString();
}

// A probability among the trained objects would contradict it.
TEST(RecognitionAnswerText, WhatIsNotKnownYetHasNoProbability) {
  RecognitionAnswer answer;
  answer.kind = Kind::kNamed;
  answer.known = false;
  answer.best = {{"tennis ball", 0.95}, {"orange", 0.04}};
  EXPECT_EQ(answer.confidenceWord(), "not known yet");
  EXPECT_EQ(answer.accessibleText(), "not known yet; most similar: tennis ball");
  const auto painted = [&] {
    QImage image(300, 300, QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    paintAnswer(painter, QRectF(0, 0, 300, 300), answer, {}, Theme::kLight, 14.0);
    return image;
  };
  const QImage before = painted();
  answer.best[0].p = 0.5;
  EXPECT_EQ(painted(), before);
  answer.known = true;
  EXPECT_NE(painted(), before);
}

TEST_F(RecognisePanelTest, WhatIsToldAdaptsTheDay) {
  panel_->controller().setEmulated(true);
  settle();
  panel_->controller().changeSession([](RecognitionSession& session) { session.choose({}); });
  panel_->controller().ask({graspsOf("pen", 1), std::nullopt, ""});
  settle();
  find<QPushButton>("tell")->click();
  EXPECT_EQ(panel_->controller().session()->numLabelled(), 1u);
  EXPECT_EQ(panel_->controller().session()->offset().origin, OffsetSource::kReferences);
  EXPECT_EQ(panel_->controller().answer().confidenceWord(), "not sure")
      << "a single object makes nothing sure";
  EXPECT_TRUE(panel_->controller().answer().unsure.contains("one object only"));
  EXPECT_TRUE(find<QLabel>("todayOffset")->text().contains("1 named grasp, 1 object"));
  EXPECT_EQ(find<FiguresTable>("todayGrasps")->item(0, 3)->text(), "pen");
  EXPECT_TRUE(find<FiguresTable>("todayGrasps")->item(0, 2)->text().endsWith(" %"))
      << "as on the page Ask";
  find<QPushButton>("todayForget")->click();
  EXPECT_EQ(panel_->controller().session()->numLabelled(), 0u);
}

TEST_F(RecognisePanelTest, ATypedOffsetIsTaken) {
  panel_->controller().setEmulated(true);
  settle();
  auto* source = find<QComboBox>("todaySource");
  EXPECT_EQ(source->currentText(), "typed") << "the emulated hand has none: 0 mm";
  panel_->controller().ask({graspsOf("ball", 1), std::nullopt, ""});
  settle();
  EXPECT_EQ(panel_->controller().answer().name(), "ball");
  source->setCurrentIndex(1);
  emit source->activated(1);
  EXPECT_EQ(panel_->controller().session()->offset().origin, OffsetSource::kUnknown);
  EXPECT_FALSE(panel_->controller().answer().sure);
}

// Measuring the zero moves the hand: what it is good for is said before.
TEST_F(RecognisePanelTest, AModelWithoutAZeroSaysSoBeforeTheHandMoves) {
  panel_->controller().setEmulated(true);
  settle();
  ASSERT_TRUE(panel_->controller().session()->model().trainingZero.has_value());
  auto* about = find<QLabel>("todayAboutZero");
  EXPECT_EQ(about->text(), "");
  panel_->controller().changeSession([](RecognitionSession& session) {
    TrainedModel without = session.model();
    without.trainingZero.reset();
    session = RecognitionSession(std::move(without));
  });
  EXPECT_TRUE(about->text().startsWith("This model holds no zero")) << about->text().toStdString();
  EmptyHandZero zero;
  zero.mm = 0.31;
  zero.sdMm = 0.12;
  panel_->today().setMeasuredZero(zero);
  EXPECT_TRUE(about->text().startsWith("The empty hand reads 0.3 ± 0.1 mm. This model"))
      << about->text().toStdString();
  panel_->today().setMeasuredZero(std::nullopt);
  EXPECT_FALSE(about->text().contains("reads"));
}

// A model that was deleted, or lies on a disk that isn't there.
TEST_F(RecognisePanelTest, AModelThatIsGoneIsSaid) {
  const QString gone = QString::fromStdString((folder_ / "mine.json").string());
  settings_.setValue("recognise/model", gone);
  settings_.setValue("recognise/emulated_model", gone);
  QStringList said;
  QObject::connect(
      &panel_->controller(), &RecognitionController::said, panel_.get(), [&](const QString& text) {
        said.append(text);
      });
  panel_->controller().setEmulated(false);
  settle();
  EXPECT_EQ(panel_->controller().whyNoModel(),
            "The model " + gone +
                " isn't there any more. Open another one (Model), or train one on the page Teach.");
  EXPECT_EQ(panel_->controller().answer().text, panel_->controller().whyNoModel());
  EXPECT_EQ(find<QLabel>("recogniseModel")->text(), "mine.json can't be used");
  panel_->controller().setEmulated(true);
  settle();
  ASSERT_NE(panel_->controller().model(), nullptr);
  const QString instead =
      "The model " + gone + " isn't there any more; in use is emulated_objects.json.";
  EXPECT_EQ(said, QStringList(instead));
  EXPECT_EQ(settings_.value("recognise/emulated_model").toString(), gone)
      << "its drive may be connected again";
  EXPECT_TRUE(panel_->controller().answer().text.startsWith(instead))
      << panel_->controller().answer().text.toStdString();
}

TEST_F(RecognisePanelTest, AFolderTeachesAndIsChecked) {
  panel_->teaching().setFolder(teach({"ball", "pen"}, 5));
  settle();
  auto* objects = find<FiguresTable>("teachObjects");
  ASSERT_EQ(objects->rowCount(), 2);
  EXPECT_EQ(objects->item(1, 0)->text(), "pen");
  EXPECT_EQ(objects->item(1, 1)->text(), "5");
  const auto out = folder_ / "mine.json";
  ask_.newFiles = {pathText(out)};
  find<QPushButton>("teachTrain")->click();
  settle();
  EXPECT_EQ(ask_.newFiles.began,
            QStringList(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) +
                        "/objects.json"))
      << "not beside the recordings";
  EXPECT_EQ(find<QLabel>("recogniseModel")->text(), "mine.json · 2 objects · best, gauss");
  EXPECT_EQ(loadModel(out).classes, (std::vector<std::string>{"ball", "pen"}));
  panel_->show();
  panel_->showPage("Check");
  find<QPushButton>("checkNow")->click();
  settle();
  ASSERT_TRUE(panel_->check().shown());
  ConfusionView& confusion = panel_->check().confusion();
  EXPECT_EQ(confusion.matrix()->at(0, 0), 5u);
  EXPECT_EQ(confusion.matrix()->at(1, 1), 5u);
  EXPECT_TRUE(find<QLabel>("checkResult")->text().contains("0 of 10 answers wrong"));
  EXPECT_TRUE(find<QLabel>("checkResult")
                  ->text()
                  .startsWith("right 100.0 ± 0.0 % (mean and deviation of 5 blocks)"))
      << find<QLabel>("checkResult")->text().toStdString();
  // In a narrow picture the title has more lines, the fourth of which is looked at here.
  QImage picture(200, 400, QImage::Format_RGB32);
  QPainter painter(&picture);
  panel_->check().paint(painter, {.size = picture.size(), .forPrint = true, .textUnits = 12});
  painter.end();
  int ink = 0;
  for (int y = 54; y < 66; ++y)
    for (int x = 16; x < 60; ++x) ink += picture.pixelColor(x, y).lightness() < 128 ? 1 : 0;
  EXPECT_GT(ink, 20);
  confusion.choose(std::pair(1, 1));
  EXPECT_EQ(panel_->check().listed().size(), 5u);
  std::filesystem::path file;
  QObject::connect(
      &panel_->check(), &CheckPage::graspAsked, [&](const auto& path, auto, auto) { file = path; });
  auto* grasps = find<FiguresTable>("checkGrasps");
  emit grasps->cellClicked(0, 0);
  EXPECT_EQ(file.filename(), "pen.palpate");
}

TEST_F(RecognisePanelTest, FeaturesAndClassifierCanBeChosen) {
  panel_->teaching().setFolder(teach({"ball", "pen"}, 5));
  settle();
  const auto choose = [&](const char* name, const QString& text) {
    auto* box = find<QComboBox>(name);
    const int index = box->findText(text);
    ASSERT_GE(index, 0);
    box->setCurrentIndex(index);
    emit box->activated(index);
    settle();
  };
  auto* bound = find<QLabel>("teachBound");
  EXPECT_TRUE(bound->isHidden()) << "best with gauss carries over";
  choose("teachSet", "study");
  EXPECT_FALSE(bound->isHidden());
  choose("teachClassifier", "lda");
  EXPECT_TRUE(bound->text().contains("only gauss")) << bound->text().toStdString();
  ASSERT_TRUE(panel_->teaching().table());
  EXPECT_EQ(panel_->teaching().table()->set, FeatureSet::kStudy);
  const auto out = folder_ / "mine.json";
  ask_.newFiles = {pathText(out)};
  find<QPushButton>("teachTrain")->click();
  settle();
  const TrainedModel model = loadModel(out);
  EXPECT_EQ(model.set, FeatureSet::kStudy);
  EXPECT_EQ(model.pipeline.classifier, ClassifierKind::kLda);
  EXPECT_EQ(model.features.size(), 54u);
  const QString said = find<QLabel>("recogniseModel")->text();
  EXPECT_TRUE(find<QPushButton>("tell")->toolTip().contains("can't be adapted"));
  EXPECT_TRUE(find<QComboBox>("tellClass")->toolTip().contains("can't be adapted"));
  EXPECT_TRUE(said.startsWith("mine.json · 2 objects · study, ") && said.endsWith("lda"))
      << said.toStdString();
  find<QPushButton>("checkNow")->click();
  settle();
  ASSERT_TRUE(panel_->teaching().checked());
  EXPECT_EQ(panel_->teaching().checked()->options.classifier, ClassifierKind::kLda);
  EXPECT_TRUE(find<QLabel>("checkResult")->text().contains("with study, "))
      << find<QLabel>("checkResult")->text().toStdString();
  // The choice is kept, and what the hand doesn't have can't be chosen.
  TrainingController later(settings_);
  EXPECT_EQ(later.choice(), panel_->teaching().choice());
  EXPECT_EQ(later.choice().set, FeatureSet::kStudy);
}

TEST_F(RecognisePanelTest, OfAHandWithoutAPinchOtherFeaturesCanNotBeChosen) {
  ProfileBuilder builder(builtInHand("flat_pad_16x16"));
  for (std::int64_t i = 0; i < 60; ++i) {
    std::vector<float> values(256, 0.0F);
    if (i >= 10 && i < 50) values[16 * 4 + 8] = 500.0F;
    builder.addFrame(i * 33'000, values);
  }
  std::filesystem::create_directories(folder_ / "pads" / "coin");
  saveRecording(builder.finish({}), {}, folder_ / "pads" / "coin" / "a.palpate");
  panel_->teaching().setFolder(folder_ / "pads");
  settle();
  EXPECT_EQ(panel_->teaching().set(), FeatureSet::kStatistics);
  auto* sets = find<QComboBox>("teachSet");
  const auto isPossible = [&](const QString& name) {
    return (sets->model()->flags(sets->model()->index(sets->findText(name), 0)) &
            Qt::ItemIsEnabled) != 0;
  };
  EXPECT_TRUE(isPossible("statistics"));
  for (const char* name : {"best", "study", "session"}) {
    EXPECT_FALSE(isPossible(name)) << name;
    EXPECT_TRUE(sets->itemData(sets->findText(name), Qt::ToolTipRole)
                    .toString()
                    .contains("no two pads that pinch"))
        << name;
  }
}

TEST_F(RecognisePanelTest, OneObjectIsTooFew) {
  panel_->teaching().setFolder(teach({"pen"}, 2));
  settle();
  QString message;
  QObject::connect(
      panel_.get(), &RecognisePanel::failed, [&](const QString& text) { message = text; });
  ask_.newFiles = {pathText(folder_ / "m.json")};
  find<QPushButton>("teachTrain")->click();
  settle();
  EXPECT_TRUE(message.contains("two classes") || message.contains("one class") ||
              message.contains("class"))
      << message.toStdString();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.json"));
}

TEST_F(RecognisePanelTest, CapturedGraspsGoIntoTheFolderAndOutAgain) {
  std::filesystem::create_directories(folder_ / "mine");
  panel_->teaching().setFolder(folder_ / "mine");
  settle();
  panel_->teach().setLive(true);
  auto* capture = find<QPushButton>("teachCapture");
  EXPECT_FALSE(capture->isEnabled()) << "nobody said what it is";
  find<QLineEdit>("teachObject")->setText("hard ball");
  capture->click();
  EXPECT_FALSE(capture->text().contains("Stop")) << "L-minor 22: there is one Stop, the hand's";
  const Profile ball = graspsOf("ball", 1);
  panel_->teach().take(ball);
  settle();
  ASSERT_EQ(panel_->teaching().clips().size(), 1u);
  const TrainingClip& clip = panel_->teaching().clips()[0];
  EXPECT_EQ(clip.state, TrainingClip::State::kAccepted) << clip.problem.toStdString();
  EXPECT_EQ(clip.path.parent_path(), folder_ / "mine" / "hard_ball");
  EXPECT_TRUE(std::filesystem::exists(clip.path));
  EXPECT_EQ(openRecording(clip.path).numFrames(), ball.numFrames());
  const auto kept = clip.path;
  find<QPushButton>("teachAct")->click();
  EXPECT_EQ(clip.state, TrainingClip::State::kTakenOut);
  EXPECT_FALSE(std::filesystem::exists(kept));
  EXPECT_TRUE(std::filesystem::exists(clip.path)) << "nothing is deleted";
  EXPECT_EQ(find<QPushButton>("teachAct")->text(), "Put back");
  find<QPushButton>("teachAct")->click();
  settle();
  EXPECT_EQ(clip.state, TrainingClip::State::kAccepted);
  EXPECT_TRUE(std::filesystem::exists(kept));
  // What is no grasp waits.
  ProfileBuilder nothing(sdh2().layout);
  nothing.addFrame(1'400'000'000'000'000, emptyFrame().values);
  panel_->teach().take(nothing.finish({}));
  EXPECT_EQ(panel_->teaching().clips()[1].state, TrainingClip::State::kWaiting);
  EXPECT_EQ(find<QPushButton>("teachAct")->text(), "Accept");
}

// A clip is being stored when another folder is chosen, and another one comes in its place.
TEST_F(RecognisePanelTest, AClipOfAnotherFolderIsNotTakenForANewOne) {
  for (const char* name : {"mine", "other"}) std::filesystem::create_directories(folder_ / name);
  panel_->teaching().setFolder(folder_ / "mine");
  settle();
  panel_->teaching().capture("ball", graspsOf("ball", 1));
  panel_->teaching().setFolder(folder_ / "other");
  ProfileBuilder nothing(sdh2().layout);
  nothing.addFrame(1'400'000'000'000'000, emptyFrame().values);
  panel_->teaching().capture("pen", nothing.finish({}));
  settle();
  ASSERT_EQ(panel_->teaching().clips().size(), 1u);
  EXPECT_EQ(panel_->teaching().clips()[0].object, "pen");
  EXPECT_EQ(panel_->teaching().clips()[0].state, TrainingClip::State::kWaiting);
  EXPECT_TRUE(panel_->teaching().clips()[0].path.empty());
}

TEST_F(RecognisePanelTest, AChosenClipStaysChosenWhenAnotherOneComes) {
  std::filesystem::create_directories(folder_ / "mine");
  panel_->teaching().setFolder(folder_ / "mine");
  settle();
  for (const char* object : {"ball", "cube"})
    panel_->teaching().capture(object, graspsOf("ball", 1));
  settle();
  find<FiguresTable>("teachClips")->selectRow(1);  // the newest is at the top
  ProfileBuilder nothing(sdh2().layout);
  nothing.addFrame(1'400'000'000'000'000, emptyFrame().values);
  panel_->teaching().capture("pen", nothing.finish({}));
  find<QPushButton>("teachAct")->click();
  EXPECT_EQ(panel_->teaching().clips()[0].state, TrainingClip::State::kTakenOut);
  EXPECT_EQ(panel_->teaching().clips()[1].state, TrainingClip::State::kAccepted);
  EXPECT_EQ(panel_->teaching().clips()[2].state, TrainingClip::State::kWaiting);
}

TEST_F(RecognisePanelTest, APhotoIsFoundByItsName) {
  QImage photo(40, 20, QImage::Format_RGB32);
  photo.fill(Qt::red);
  std::filesystem::create_directories(folder_ / "foam_ball");
  EXPECT_EQ(photoOf("foam ball", {folder_.path()}), std::filesystem::path());
  photo.save(QString::fromStdString((folder_ / "foam_ball" / "any.png").string()));
  EXPECT_EQ(photoOf("foam ball", {folder_.path()}).filename(), "any.png");
  photo.save(QString::fromStdString((folder_ / "Foam_ball.jpg").string()));
  EXPECT_EQ(photoOf("foam ball", {{}, folder_.path()}).filename(), "Foam_ball.jpg");
  PhotoCache shelf;
  shelf.setFolders({folder_.path()});
  QSignalSpy changed(&shelf, &PhotoCache::changed);
  EXPECT_TRUE(shelf.photo("foam ball").isNull()) << "it is being read";
  FileReading::settleAll(shelf);
  EXPECT_EQ(changed.count(), 1);
  EXPECT_EQ(shelf.photo("foam ball").size(), QSize(40, 20));
  EXPECT_TRUE(shelf.photo("pen").isNull());
}

// A photo beside the grasps that teach is drawn with the answer.
TEST_F(RecognisePanelTest, ThePhotoOfTheFolderIsDrawn) {
  const auto folder = teach({"ball", "pen"}, 3);
  panel_->teaching().setFolder(folder);
  settle();
  ask_.newFiles = {pathText(folder_ / "mine.json")};
  find<QPushButton>("teachTrain")->click();
  settle();
  panel_->show();
  panel_->showPage("Ask");
  auto* view = find<AnswerView>("answerView");
  const QColor paint(255, 0, 255);  // of nothing else
  const auto painted = [&] {
    panel_->controller().changeSession([](RecognitionSession& session) { session.choose({}); });
    panel_->controller().ask({graspsOf("pen", 1), std::nullopt, ""});
    settle();
    EXPECT_EQ(panel_->controller().answer().name(), "pen");
    // The photo is looked for when the answer is drawn.
    view->grab();
    settle();
    const QImage image = view->grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y) == paint ? 1 : 0;
    return count;
  };
  EXPECT_EQ(painted(), 0);
  QImage photo(200, 150, QImage::Format_RGB32);
  photo.fill(paint);
  ASSERT_TRUE(photo.save(QString::fromStdString((folder / "pen" / "pen.png").string())));
  panel_->controller().setPhotoFolder(folder);  // looked for anew
  EXPECT_GT(painted(), 500);
}

// The reason of an answer that isn't sure stands at its end: it is scrolled to, not cut.
TEST_F(RecognisePanelTest, TheViewOfAnAnswerAsksForTheHeightOfAllItsLines) {
  PhotoCache photos;
  AnswerView view(photos, 1.0);
  view.resize(300, 180);
  view.show();
  RecognitionAnswer answer;
  answer.kind = Kind::kNamed;
  answer.best = {{"foam ball", 0.5}, {"tennis ball", 0.3}, {"pen", 0.2}};
  answer.of = "grasp 3";
  view.setAnswer(answer);
  const int without = view.minimumHeight();
  answer.unsure = QString("The hand of today may differ from that of the training. ").repeated(6);
  view.setAnswer(answer);
  const int line = view.fontMetrics().lineSpacing();
  const int lines = view.fontMetrics().horizontalAdvance(answer.unsure) / 300;
  EXPECT_GE(view.minimumHeight(), without + (lines - 1) * line * 0.9);
  const int before = view.minimumHeight();
  view.resize(240, 180);
  EXPECT_GT(view.minimumHeight(), before) << "narrower, it needs more rows";
}

TEST_F(RecognisePanelTest, EscGivesUpTrainingAndLeavesNoModel) {
  panel_->teaching().setFolder(teach({"ball", "pen"}, 3));
  settle();
  const auto out = folder_ / "mine.json";
  ask_.newFiles = {pathText(out)};
  find<QPushButton>("teachTrain")->click();
  ASSERT_TRUE(panel_->teaching().busy());
  EXPECT_TRUE(panel_->cancel()) << "what Esc does";
  settle();
  EXPECT_FALSE(panel_->teaching().busy());
  EXPECT_FALSE(std::filesystem::exists(out));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_NE(entry.path().extension(), ".json") << "half a model";
  EXPECT_EQ(panel_->controller().model(), nullptr);
  EXPECT_FALSE(panel_->cancel()) << "nothing is left to give up";
  // And it goes when it is asked again.
  find<QPushButton>("teachTrain")->click();
  settle();
  EXPECT_TRUE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace palpate::gui::recognise_panel_test
