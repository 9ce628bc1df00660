// Tactile frames in the shape of the ROS message schunk_sdh/TactileSensor, as JSON, one line per
// frame:
//
//   {"header":{"seq":0,"stamp":{"secs":1416996123,"nsecs":250000000},"frame_id":"hand"},
//    "tactile_matrix":[{"matrix_id":0,"cells_x":6,"cells_y":14,"tactile_array":[0,0,..]},..]}
//
// Source: schunk_modular_robotics, schunk_sdh/msg/TactileSensor.msg (Header header; TactileMatrix[]
// tactile_matrix) and TactileMatrix.msg (uint32 matrix_id; int16 cells_x; int16 cells_y; int16[]
// tactile_array). Keys of header and stamp are those of ROS 1, as rosbridge has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Appends one message without a line end. `stamp` is the frame's host time [s, ns since 1970];
// matrix_id the number of the matrix in wire order; tactile_array row by row, row 0 at the
// fingertip, cells_x values each in the hand's unit: 0 where there is no taxel, null where a value
// is not finite. Values are as in the frame, with their decimals and signs; whole ones are
// integers. Fractions don't fit into the int16[] of the ROS message. frame_id is "hand", the frame
// of the whole hand, as for Foxglove.
void appendTactileSensorJson(std::string& out, const TactileFrame& frame, std::uint64_t sequence);

// The same frame as several messages with the same header: each has as many whole matrices, in
// their order, as fit into `maxBytes`, at least one.
std::vector<std::string> tactileSensorMessages(const TactileFrame& frame,
                                               std::uint64_t sequence,
                                               std::size_t maxBytes);

// PATH.jsonl: a message per frame, seq from 0; angles, temperatures and events have no place in it.
// Whole or not there. Throws FileError, Cancelled.
void writeTactileSensorLines(const Profile& profile,
                             const std::filesystem::path& path,
                             Overwrite overwrite = Overwrite::kRefuse,
                             const Progress& progress = {});

}  // namespace palpate
