// Particles, trajectories and voxel grids as plain data, and the keyed container a bake is handed over in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/core/result.h>

namespace shoal {

// Particles of one frame, metres. Every named attribute has componentCount floats a particle.
struct Particles {
    std::vector<Vec3> positions;
    struct Attribute {
        std::string name;  // "velocity", "density", "id", ...
        int componentCount = 1;
        std::vector<float> values;  // positions.size() * componentCount
    };
    std::vector<Attribute> attributes;
    float radius = 0;  // metres, 0 where the file does not say
    const Attribute* find(const std::string& name) const;
};

// Where people are over time. Samples of one person are contiguous and ordered by time.
struct Trajectories {
    struct Sample {
        float time = 0;     // seconds from the first frame
        Vec3 position;      // metres; y is height above ground, the plane is x, -z
        float heading = 0;  // radians about +y, 0 looks along +z; NaN where unknown
    };
    struct Person {
        std::int64_t id = 0;
        std::size_t first = 0, count = 0;  // range in samples
    };
    std::vector<Sample> samples;
    std::vector<Person> people;
    float framesPerSecond = 0;  // 0 where irregular
};

// A scalar volume, x fastest. worldFromIndex places voxel centres: spacing, origin and direction (metres unless the
// file says mm).
struct VoxelGrid {
    int sizeX = 0, sizeY = 0, sizeZ = 0;
    std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>, std::vector<float>>
        values;
    float valueScale = 1, valueOffset = 0;  // value = stored * valueScale + valueOffset
    Mat4 worldFromIndex;
    std::size_t voxelCount() const { return std::size_t(sizeX) * std::size_t(sizeY) * std::size_t(sizeZ); }
};

// What a bake makes: named byte arrays with their shape, and the parameters they came from. io writes it (format
// version, content hash inside).
struct Asset {
    struct Array {
        std::string type;  // "u8", "u16", "u32", "f16", "f32", "bc7", ...
        std::vector<std::size_t> shape;
        std::vector<std::byte> bytes;
    };
    std::string kind;  // "volume-light", "impostors", ...
    std::uint32_t formatVersion = 1;
    std::map<std::string, std::string> parameters;  // in words, seed included
    std::map<std::string, Array> arrays;
    // FNV-1a 64 over kind, version, parameters and arrays in key order.
    std::uint64_t contentHash() const;
};

}  // namespace shoal
