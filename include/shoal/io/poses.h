// Camera poses as a CSV table: one row a frame.
//
// A header row names the columns, in any order: `time` in seconds or `frame` (a number), x, y, z in metres, and either
// the quaternion qx, qy, qz, qw of worldFromCamera (the camera looks along its -z, +y up) or a target point tx, ty, tz
// to look at with +y up. Other columns are left alone. Separators: comma, semicolon or tab; lines that start with '#'
// are comments.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/core/result.h>

namespace shoal::io {

struct CameraPose {
    float time = 0;        // seconds
    Vec3 position;         // metres
    Quat worldFromCamera;  // unit
};

// Times increase strictly. framesPerSecond turns a `frame` column into seconds. Errors name the line: a missing or
// doubled column, a value that is not a finite number, a row of another length, a quaternion far from unit length, a
// target at the camera, a time that does not increase.
Result<std::vector<CameraPose>> readPoses(const std::filesystem::path& path, float framesPerSecond = 30);
Result<std::vector<CameraPose>> parsePoses(std::string_view text, const std::string& name, float framesPerSecond = 30);

// time,x,y,z,qx,qy,qz,qw with digits enough to read the same floats back. Atomic (file.h).
Result<void> writePoses(const std::filesystem::path& path, std::span<const CameraPose> poses);

}  // namespace shoal::io
