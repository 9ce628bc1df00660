// Reads the description of a hand from its folder: hand.json, and hand.urdf where the hand has
// joints. docs/manual/own_array.md describes both files; data/hands/hand.schema.json is the JSON
// schema of hand.json.
//
// The hands that Palpate knows without a folder (data/hands of the project) are compiled into the
// program, from the same files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/preshape.h>
#include <palpate/model/sensor_characteristics.h>

namespace palpate {

// Position and outward normal of one taxel in the frame of its link.
struct TaxelPose {
  std::array<double, 3> positionMm{};
  std::array<double, 3> normal{0.0, 0.0, 1.0};  // unit vector
};

// Where a matrix is mounted. The frame of its surface has its origin at the centre of taxel (0, 0),
// x along rising columns, y along rising rows (towards the palm) and z = x cross y into the body,
// so that -z is the outward normal.
struct MatrixSurface {
  // Name of the link in the URDF that carries the matrix; empty: the base frame of the hand.
  std::string link;
  // Origin and axes of the surface's frame, in the frame of the link.
  std::array<double, 3> originMm{};
  std::array<double, 3> xAxis{1.0, 0.0, 0.0};  // unit vectors, perpendicular to each other
  std::array<double, 3> yAxis{0.0, 1.0, 0.0};
  // From this row on, towards row 0, the surface is a cylinder about an axis along x; empty: flat.
  std::optional<double> bendRow;
  double bendRadiusMm = 0.0;  // > 0 where bendRow is given; the body is inside of the cylinder
  // Radius with which a rigid object has the same measured size everywhere on the pad; equals
  // bendRadiusMm where no other is known.
  double effectiveBendRadiusMm = 0.0;
  // One per place (rows x columns, row by row) when the surface is neither flat nor a cylinder;
  // otherwise empty.
  std::vector<TaxelPose> taxels;
};

// The part of a hand that recognition of held objects uses; see PinchHand, which is made of it.
struct PinchDescription {
  std::array<std::size_t, 2> pads{0, 1};
  std::vector<std::array<std::size_t, 2>> otherPads;
  double secondPadGain = 1.0;
  double fullScaleCounts = 4096.0;
  int imageSize = 1;
  std::array<double, 2> largestCounts{1.0, 1.0};
  std::vector<std::size_t> gripAxes;
};

// What the folder of a hand says beyond its HandDescription.
struct HandFile {
  std::string json;  // text of hand.json
  std::string urdf;  // text of the URDF; empty without joints and surfaces
  // The folder that the files were read from, in which meshes lie; empty when it is not known.
  std::filesystem::path folder;
  // The tactile controller whose recordings and frames don't name their hand: a layout of the same
  // sizes from it is taken for this hand ("DSACON32-M"). Empty: none.
  std::string controller;
  std::vector<Preshape> preshapes;
  std::optional<SensorCharacteristics> characteristics;
  // One per matrix; empty when the hand has no geometry.
  std::vector<MatrixSurface> surfaces;
  // For each axis the joints of the URDF that it moves (names).
  std::vector<std::vector<std::string>> axisJoints;
  std::optional<PinchDescription> pinch;
};

// Largest size of hand.json and of the URDF [bytes].
constexpr std::uint64_t kHandFileByteLimit = 4u << 20;

// Returns the hand that `json` describes; `urdf` is the text of the URDF that it names. `source`
// names the file in errors. Throws FormatError that names the place in the file
// ("matrices[2].rows is 0, not in 1..256").
HandDescription parseHand(const std::string& json,
                          const std::string& urdf,
                          const std::filesystem::path& source);

// Reads the hand in a folder (or the hand.json in it). Throws FileError and FormatError.
HandDescription readHandFolder(const std::filesystem::path& folder);

// What a recording keeps of its hand: "hand" (the name) and, where the hand was read from a file,
// "hand_json" and "hand_urdf".
std::map<std::string, std::string> handMeta(const HandDescription& hand);
// Returns the hand of a recording from what handMeta() kept in `meta`, with the masks, the pitch
// and the unique ids of `layout`. Where nothing was kept, or what was kept does not fit `layout`,
// it is describeHand() of the layout.
HandDescription recordedHand(const std::map<std::string, std::string>& meta,
                             const SensorLayout& layout,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors);

// A hand that is compiled into the program.
struct BuiltInHand {
  std::string key;  // name of its folder: "flat_pad_16x16"
  std::shared_ptr<const HandDescription> hand;
};
const std::vector<BuiltInHand>& builtInHands();
// Throws std::invalid_argument that lists all keys.
const HandDescription& builtInHand(std::string_view key);
// The hand that is meant where none is named: the built-in hand with a tactile controller
// (HandFile::controller), whose recordings don't name their hand.
const HandDescription& defaultHand();

// A hand that is known by name.
struct KnownHand {
  std::string key;               // name of its folder: "my_pad"
  std::filesystem::path folder;  // empty: built in
};
// The user's folder of what the program keeps: $XDG_DATA_HOME/palpate, or
// $HOME/.local/share/palpate without the former; empty: neither is set.
std::filesystem::path userDataFolder();
// The folders in which hands are looked for by name: userDataFolder()/hands, then
// `dataFolder`/hands.
std::vector<std::filesystem::path> handFolders(const std::filesystem::path& dataFolder);
// The hands in `folders` and the built-in ones, by name in alphabetical order. Of hands with the
// same name the first folder's is taken, a built-in one last. Folders that can't be read are left
// out; the files of the hands are not read.
std::vector<KnownHand> knownHands(const std::vector<std::filesystem::path>& folders);

// Returns the hand that `name` stands for: the folder of that path, or a hand of that name among
// knownHands(). Throws Error that lists what is known, or says what is wrong in the hand's files.
HandDescription findHand(const std::string& name,
                         const std::vector<std::filesystem::path>& folders);

}  // namespace palpate
