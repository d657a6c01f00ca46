#include <shoal/io/poses.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <shoal/io/file.h>

namespace shoal::io {
namespace {

constexpr float kUnitTolerance = 0.01f;     // of a quaternion's length: files with three digits pass
constexpr float kSmallestDistance = 1e-6f;  // metres from the camera to its target

constexpr std::array<std::string_view, 12> kColumns = {"time", "frame", "x",  "y",  "z",  "qx",
                                                       "qy",   "qz",    "qw", "tx", "ty", "tz"};
enum Column { kTime, kFrame, kX, kY, kZ, kQx, kQy, kQz, kQw, kTx, kTy, kTz };

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t end = line.find(separator);
        std::string_view cell = trim(line.substr(0, end));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
        cells.push_back(cell);
        if (end == std::string_view::npos) return cells;
        line.remove_prefix(end + 1);
    }
}

struct Table {
    std::array<int, kColumns.size()> at;  // the cell of each column, -1 where there is none
    std::size_t cellCount = 0;
    char separator = ',';
    bool hasTarget = false;
};

// Empty, or what is wrong with the header row.
std::string readHeader(std::string_view line, Table& table) {
    table.separator = line.find('\t') != std::string_view::npos  ? '\t'
                      : line.find(';') != std::string_view::npos ? ';'
                                                                 : ',';
    table.at.fill(-1);
    const std::vector<std::string_view> cells = split(line, table.separator);
    table.cellCount = cells.size();
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        for (std::size_t column = 0; column < kColumns.size(); ++column) {
            if (cells[cell] != kColumns[column]) continue;
            if (table.at[column] >= 0) return fmt::format("two columns are called \"{}\"", kColumns[column]);
            table.at[column] = int(cell);
        }
    }
    const auto has = [&](int column) { return table.at[std::size_t(column)] >= 0; };
    const auto missing = [](int column) {
        return fmt::format("found no column \"{}\"", kColumns[std::size_t(column)]);
    };
    if (!has(kTime) && !has(kFrame)) return "found no column \"time\" or \"frame\"";
    for (const int column : {kX, kY, kZ})
        if (!has(column)) return missing(column);
    const bool anyRotation = has(kQx) || has(kQy) || has(kQz) || has(kQw);
    table.hasTarget = !anyRotation && (has(kTx) || has(kTy) || has(kTz));
    if (!anyRotation && !table.hasTarget) return "found no columns qx, qy, qz, qw and no columns tx, ty, tz";
    for (int column = table.hasTarget ? kTx : kQx; column <= (table.hasTarget ? kTz : kQw); ++column)
        if (!has(column)) return missing(column);
    return {};
}

// worldFromCamera of a camera that looks along `forward` (not zero) with +y up; -z is up for a look straight down, +z
// for one straight up.
Quat lookAlong(Vec3 forward) {
    const Vec3 back = normalize(-forward);
    Vec3 right = cross({0, 1, 0}, back);
    if (length(right) < 1e-4f) right = cross({0, 0, back.y > 0 ? -1.0f : 1.0f}, back);
    right = normalize(right);
    const Vec3 up = cross(back, right);
    return quatOfAxes({{right.x, right.y, right.z}, {up.x, up.y, up.z}, {back.x, back.y, back.z}});
}

// Empty, or what is wrong with the row.
std::string readRow(std::string_view line, const Table& table, float framesPerSecond, CameraPose& pose) {
    const std::vector<std::string_view> cells = split(line, table.separator);
    if (cells.size() != table.cellCount)
        return fmt::format("found {} cells, expected {}", cells.size(), table.cellCount);
    std::array<double, kColumns.size()> values{};
    for (std::size_t column = 0; column < kColumns.size(); ++column) {
        if (table.at[column] < 0) continue;
        std::string_view cell = cells[std::size_t(table.at[column])];
        if (cell.starts_with('+')) cell.remove_prefix(1);
        double& value = values[column];
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(float(value)))
            return fmt::format("{}: found \"{}\", expected a finite number", kColumns[column], cell);
    }
    pose.time = float(table.at[kTime] >= 0 ? values[kTime] : values[kFrame] / double(framesPerSecond));
    pose.position = {float(values[kX]), float(values[kY]), float(values[kZ])};
    if (table.hasTarget) {
        const Vec3 forward{float(values[kTx] - values[kX]), float(values[kTy] - values[kY]),
                           float(values[kTz] - values[kZ])};
        const float distance = length(forward);
        if (!(distance > kSmallestDistance)) return "the target is at the camera";
        if (!std::isfinite(distance)) return "the target is too far from the camera";
        pose.worldFromCamera = lookAlong(forward);
        return {};
    }
    const Quat q{float(values[kQx]), float(values[kQy]), float(values[kQz]), float(values[kQw])};
    const double norm = std::sqrt(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w);
    if (!(std::abs(norm - 1) <= kUnitTolerance))
        return fmt::format("the quaternion has the length {:.4g}, expected 1", norm);
    // A unit quaternion is kept bit for bit, so that what was written is what is read.
    pose.worldFromCamera = std::abs(norm - 1) < 1e-6 ? q : normalize(q);
    return {};
}

}  // namespace

Result<std::vector<CameraPose>> parsePoses(std::string_view text, const std::string& name, float framesPerSecond) {
    SHOAL_ASSERT_GT(framesPerSecond, 0.0f);
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // the mark that spreadsheets put before UTF-8
    std::vector<CameraPose> poses;
    Table table;
    bool inHeader = true;
    for (int lineNumber = 1; !text.empty(); ++lineNumber) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trim(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line.front() == '#') continue;
        std::string wrong;
        CameraPose pose;
        if (inHeader) {
            wrong = readHeader(line, table);
        } else {
            wrong = readRow(line, table, framesPerSecond, pose);
            if (wrong.empty() && !poses.empty() && !(pose.time > poses.back().time))
                wrong = fmt::format("time {} does not increase, the row before has {}", pose.time, poses.back().time);
        }
        if (!wrong.empty()) return badInput(fmt::format("{}: line {}: {}", name, lineNumber, wrong));
        if (!inHeader) poses.push_back(pose);
        inHeader = false;
    }
    if (inHeader)
        return badInput(fmt::format("{}: found no header row, expected one such as time,x,y,z,qx,qy,qz,qw", name));
    if (poses.empty()) return badInput(fmt::format("{}: found no row below the header", name));
    return poses;
}

Result<std::vector<CameraPose>> readPoses(const std::filesystem::path& path, float framesPerSecond) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parsePoses(text, path.string(), framesPerSecond);
}

Result<void> writePoses(const std::filesystem::path& path, std::span<const CameraPose> poses) {
    std::string text = "time,x,y,z,qx,qy,qz,qw\n";
    for (const CameraPose& pose : poses) {
        const Vec3 p = pose.position;
        const Quat q = pose.worldFromCamera;
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", pose.time, p.x, p.y, p.z, q.x, q.y, q.z,
                       q.w);
    }
    return writeFileAtomically(path, text);
}

}  // namespace shoal::io
