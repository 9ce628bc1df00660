#include "palpate/computed/computed_series.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "palpate/calibration/pressure_reader.h"
#include "palpate/core/error.h"
#include "palpate/kinematics/contact_geometry.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/kinematics/joint_range.h"
#include "palpate/model/profile_over.h"
#include "palpate/slip/contact_moments.h"

namespace palpate {
namespace {

constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kFramesPerReport = 256;

float orNotKnown(bool known, double value) { return known ? static_cast<float>(value) : kNotKnown; }

// Series whose values one pass over the frames gives.
enum class ComputedPass : std::uint8_t { kPressures, kCentroids, kSpheres, kSlips };
constexpr std::size_t kNumPasses = 4;

ComputedPass passOf(ComputedKind kind) {
  switch (kind) {
    case ComputedKind::kCentroid:
      return ComputedPass::kCentroids;
    case ComputedKind::kSphere:
      return ComputedPass::kSpheres;
    case ComputedKind::kSlip:
      return ComputedPass::kSlips;
    default:
      return ComputedPass::kPressures;
  }
}

const Profile& countsOf(const Profile& profile, const ComputedOptions& options) {
  return options.counts ? *options.counts : profile;
}

std::string missingForForces(const Profile& profile, const ComputedOptions& options) {
  if (!options.calibration)
    return "needs a calibration: --calibration C.json, in Python calibration=.., in the window "
           "Calibrate > Force > Choose";
  try {
    PressureReader(
        countsOf(profile, options), *options.calibration, options.pressure, options.tare);
    return {};
  } catch (const Error& error) {
    return error.what();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

std::string missingForSpheres(const Profile& profile) {
  if (!hasGeometry(profile.hand()))
    return "needs the geometry of the hand, which its description lacks (own_array.md)";
  if (!profile.hand().axes.empty() && profile.numAngles() == 0)
    return "needs joint angles, which the recording lacks";
  try {
    describeGeometry(profile.hand());
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

std::string missingForSlip(const Profile& profile, const SlipSeriesOptions& options) {
  try {
    slipDetectors(profile.hand(), detectorOptions(options));
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

// One value per column of a pass and frame.
class ComputedRows {
 public:
  ComputedRows(std::size_t numFrames, std::size_t numColumns)
      : numColumns_(numColumns), values_(numFrames * numColumns, kNotKnown) {}
  std::span<float> row(std::size_t frame) {
    return std::span(values_).subspan(frame * numColumns_, numColumns_);
  }
  float at(std::size_t frame, std::size_t column) const {
    return values_[frame * numColumns_ + column];
  }

 private:
  std::size_t numColumns_;
  std::vector<float> values_;
};

// The order of values in a row is that of the series in computedSeries().
void computePressures(const Profile& profile,
                      const ComputedOptions& options,
                      const Progress& progress,
                      ComputedRows& out) {
  const Profile& counts = countsOf(profile, options);
  PressureReader reader(counts, *options.calibration, options.pressure, options.tare);
  const SensorLayout& layout = counts.layout();
  for (std::size_t i = 0; i < counts.numFrames(); ++i) {
    reportProgress(progress, i, counts.numFrames(), kFramesPerReport);
    try {
      const PressureFrame& frame = reader.at(i);
      const std::span<float> row = out.row(i);
      const auto handN = knownForceN(frame);
      row[0] = orNotKnown(handN.has_value(), handN.value_or(0.0));
      for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
        const MatrixPressure& matrix = frame.matrices[m];
        const auto forceN = knownForceN(matrix, frame.areaKnown);
        const bool inRange = matrix.active == 0 || matrix.inRange;
        const auto begin = frame.kpa.begin() + static_cast<std::ptrdiff_t>(layout.offset(m));
        const auto places = static_cast<std::ptrdiff_t>(layout.matrix(m).numCells());
        const float most = *std::max_element(begin, begin + places);
        row[1 + m] = orNotKnown(forceN.has_value(), forceN.value_or(0.0));
        const std::size_t at = 1 + layout.numMatrices() + 2 * m;
        row[at] = orNotKnown(inRange, matrix.kpa);
        row[at + 1] = inRange ? most : kNotKnown;
      }
    } catch (const Error&) {
      // The frame is damaged.
    }
  }
}

// Calls take(index, frame) for every frame that can be read.
template <typename Take>
void forEachReadable(const Profile& profile, const Progress& progress, const Take& take) {
  TactileFrame frame;
  UnreadableSamples unreadable;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    if (profile.readFrame(i, frame, &unreadable)) take(i, frame);
  }
}

void computeCentroids(const Profile& profile, const Progress& progress, ComputedRows& out) {
  forEachReadable(profile, progress, [&](std::size_t i, const TactileFrame& frame) {
    for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m) {
      const ContactMoments contact = contactMoments(frame.matrix(m));
      const TaxelPitch& pitchMm = profile.layout().matrix(m).pitchMm;
      out.row(i)[2 * m] = orNotKnown(contact.active > 0, contact.x * pitchMm.x);
      out.row(i)[2 * m + 1] = orNotKnown(contact.active > 0, contact.y * pitchMm.y);
    }
  });
}

void computeSpheres(const Profile& profile, const Progress& progress, ComputedRows& out) {
  const HandGeometry geometry(describeGeometry(profile.hand()));
  std::optional<std::size_t> sample;
  bool posed = false;
  HandPose pose;
  HandContact contact;
  const auto take = [&](const std::vector<double>& angles) {
    posed = checkAngles(angles, profile.hand().axes).state != AngleValidity::kUnusable;
    if (posed) geometry.pose(angles, pose);
  };
  if (profile.numAngles() == 0) take({});
  forEachReadable(profile, progress, [&](std::size_t i, const TactileFrame& frame) {
    if (const auto now = profile.angleSampleAt(frame.hostUs); now && now != sample) {
      sample = now;
      try {
        take(profile.angles(*now).values);
      } catch (const Error&) {  // the sample is damaged
        posed = false;
      }
    }
    if (!posed) return;
    contactOf(frame, pose, {}, contact);
    if (!contact.taxelSphere) return;
    const Sphere& sphere = *contact.taxelSphere;
    const std::array values = {
        2.0 * sphere.radiusMm, sphere.centreMm.x(), sphere.centreMm.y(), sphere.centreMm.z()};
    std::ranges::transform(
        values, out.row(i).begin(), [](double value) { return static_cast<float>(value); });
  });
}

void computeSlips(const Profile& profile,
                  const SlipSeriesOptions& options,
                  const Progress& progress,
                  ComputedRows& out) {
  const SlipSeries series = slipSeries(profile, options, progress);
  for (std::size_t m = 0; m < series.matrices.size(); ++m) {
    const TaxelPitch& pitchMm = profile.layout().matrix(m).pitchMm;
    const auto lengthMm = [&](float dx, float dy) {
      return pitchMm.lengthMm(static_cast<double>(dx), static_cast<double>(dy));
    };
    const SlipSample* before = nullptr;
    for (const SlipSample& sample : series.matrices[m]) {
      // A step is that since the frame before, in which the matrix was touched, too.
      const double stepS = before ? series.timeS[sample.frame] - series.timeS[before->frame] : 0.0;
      const std::span<float> row = out.row(sample.frame);
      row[2 * m] = orNotKnown(sample.valid && stepS > 0.0, lengthMm(sample.dx, sample.dy) / stepS);
      row[2 * m + 1] = orNotKnown(sample.refValid, lengthMm(sample.refDx, sample.refDy));
      before = &sample;
    }
  }
}

class ComputedStorage final : public ProfileOver {
 public:
  ComputedStorage(Profile source, ComputedOptions options)
      : ProfileOver(std::move(source)), options_(std::move(options)) {}

  // Returns the descriptions of the series behind those of the source.
  std::vector<SeriesDescription> addSeries() {
    std::vector<SeriesDescription> added;
    for (ComputedSeries& each : computedSeries(source_, options_)) {
      const ComputedPass pass = passOf(each.kind);
      std::size_t& columns = passes_[static_cast<std::size_t>(pass)].numColumns;
      const std::size_t first = columns;
      columns += each.description.columns.size();
      if (std::ranges::any_of(source_.series(), [&](const SeriesDescription& recorded) {
            return recorded.name == each.description.name;
          }))
        continue;
      series_.push_back({pass, first, each.description.columns.size(), each.missing.empty()});
      if (!each.missing.empty()) each.description.source = each.missing;
      added.push_back(std::move(each.description));
    }
    return added;
  }

  bool givesReadings() const override { return source_.givesReadings(); }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    source_.readFrame(frame, out);
  }
  std::size_t numSamples(std::size_t series) const override {
    const Place* place = placeOf(series);
    if (!place) return ProfileOver::numSamples(series);
    return place->there ? numFrames() : 0;
  }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const override {
    return placeOf(series) ? frameTimeUs(sample) : ProfileOver::sampleTimeUs(series, sample);
  }
  std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const override {
    const Place* place = placeOf(series);
    if (!place) return ProfileOver::sampleAt(series, timeUs);
    return place->there ? frameAt(timeUs) : std::nullopt;
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    const Place* place = placeOf(series);
    if (!place) return ProfileOver::sample(series, sample);
    const ComputedRows& rows = rowsOf(place->pass, {});
    Sample made{.hostUs = frameTimeUs(sample), .values = {}, .series = series};
    for (std::size_t i = 0; i < place->numColumns; ++i)
      made.values.push_back(static_cast<double>(rows.at(sample, place->firstColumn + i)));
    return made;
  }
  bool isReady(std::size_t series) const override {
    const Place* place = placeOf(series);
    if (!place) return ProfileOver::isReady(series);
    return !place->there || passes_[static_cast<std::size_t>(place->pass)].ready;
  }
  void prepare(std::size_t series, const Progress& progress) const override {
    const Place* place = placeOf(series);
    if (!place) return ProfileOver::prepare(series, progress);
    if (place->there) (void)rowsOf(place->pass, progress);
  }

 private:
  // Where the values of a series stand.
  struct Place {
    ComputedPass pass;
    std::size_t firstColumn;
    std::size_t numColumns;
    bool there;
  };
  struct Pass {
    std::size_t numColumns = 0;
    std::mutex mutex;
    std::atomic<bool> ready = false;
    std::unique_ptr<ComputedRows> rows;
  };

  // Null: a series of the source.
  const Place* placeOf(std::size_t series) const {
    const std::size_t recorded = source_.series().size();
    return series < recorded ? nullptr : &series_[series - recorded];
  }

  const ComputedRows& rowsOf(ComputedPass which, const Progress& progress) const {
    Pass& pass = passes_[static_cast<std::size_t>(which)];
    if (pass.ready) return *pass.rows;
    const std::lock_guard lock(pass.mutex);
    if (pass.ready) return *pass.rows;
    auto rows = std::make_unique<ComputedRows>(source_.numFrames(), pass.numColumns);
    switch (which) {
      case ComputedPass::kPressures:
        computePressures(source_, options_, progress, *rows);
        break;
      case ComputedPass::kCentroids:
        computeCentroids(source_, progress, *rows);
        break;
      case ComputedPass::kSpheres:
        computeSpheres(source_, progress, *rows);
        break;
      case ComputedPass::kSlips:
        computeSlips(source_, options_.slip, progress, *rows);
        break;
    }
    pass.rows = std::move(rows);
    pass.ready = true;
    return *pass.rows;
  }

  const ComputedOptions options_;
  std::vector<Place> series_;
  mutable std::array<Pass, kNumPasses> passes_;
};

}  // namespace

std::vector<ComputedSeries> computedSeries(const Profile& profile, const ComputedOptions& options) {
  const std::size_t hand = profile.layout().numMatrices();
  std::vector<ComputedSeries> all;
  const auto add = [&](ComputedKind kind,
                       std::size_t matrix,
                       const std::string& name,
                       std::vector<Column> columns,
                       std::vector<std::string> captions,
                       const std::string& missing) {
    const std::string place = matrix == hand ? "hand" : "m" + std::to_string(matrix);
    all.push_back({{.name = place + "_" + name,
                    .role = kComputedRole,
                    .columns = std::move(columns),
                    .source = "computed"},
                   kind,
                   matrix,
                   std::move(captions),
                   missing});
  };
  const std::string force = missingForForces(profile, options);
  add(ComputedKind::kForce, hand, "force", {{"n", "N"}}, {"force"}, force);
  for (std::size_t m = 0; m < hand; ++m)
    add(ComputedKind::kForce, m, "force", {{"n", "N"}}, {"force"}, force);
  for (std::size_t m = 0; m < hand; ++m)
    add(ComputedKind::kPressure,
        m,
        "pressure",
        {{"kpa", "kPa"}, {"max_kpa", "kPa"}},
        {"pressure", "largest pressure"},
        force);
  for (std::size_t m = 0; m < hand; ++m)
    add(ComputedKind::kCentroid,
        m,
        "centroid",
        {{"x_mm", "mm"}, {"y_mm", "mm"}},
        {"centroid x", "centroid y"},
        {});
  add(ComputedKind::kSphere,
      hand,
      "sphere",
      {{"diameter_mm", "mm"}, {"x_mm", "mm"}, {"y_mm", "mm"}, {"z_mm", "mm"}},
      {"sphere diameter", "sphere centre x", "sphere centre y", "sphere centre z"},
      missingForSpheres(profile));
  const std::string slip = missingForSlip(profile, options.slip);
  for (std::size_t m = 0; m < hand; ++m)
    add(ComputedKind::kSlip,
        m,
        "slip",
        {{"speed_mm_s", "mm/s"}, {"mm", "mm"}},
        {"slip speed", "slip"},
        slip);
  return all;
}

Profile withComputedSeries(const Profile& profile, const ComputedOptions& options) {
  auto storage = std::make_shared<ComputedStorage>(profile, options);
  std::vector<SeriesDescription> further = profile.furtherSeries();
  for (SeriesDescription& each : storage->addSeries()) further.push_back(std::move(each));
  return Profile(profile.info(), profile.hand(), storage, std::move(further))
      .withBaselines(profile.baselines());
}

}  // namespace palpate
