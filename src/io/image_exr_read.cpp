// OpenEXR in: every compression, scan lines and tiles (the full-resolution level), layers and parts.

#include "io/image_codecs.h"
#include "io/image_exr.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>

#include <fmt/format.h>

namespace shoal::io {
namespace {

// Flat pictures compress well, but a file that claims more than this was made to take our memory.
constexpr std::uint64_t kSmallPicture = 64u << 20;  // bytes of float pixels that any file may ask for
constexpr std::uint64_t kLargestRatio = 16384;      // float bytes a byte of file
constexpr std::uint64_t kLargestPicture = std::uint64_t(8) << 30;

// Not "memory mapped" in OpenEXR's sense: it would then copy uncompressed lines straight from our bytes, as many as a
// line has, even where a damaged chunk says it holds fewer (3.1.5).
class MemoryStream final : public Imf::IStream {
public:
    MemoryStream(Bytes bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
    bool read(char to[], int count) override {
        std::memcpy(to, take(count), std::size_t(count));
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t at) override { at_ = at; }

private:
    const char* take(int count) {
        if (count < 0 || at_ > bytes_.size() || std::size_t(count) > bytes_.size() - at_)
            throw std::runtime_error("the file is cut short");
        const char* from = reinterpret_cast<const char*>(bytes_.data()) + at_;
        at_ += std::size_t(count);
        return from;
    }
    Bytes bytes_;
    std::uint64_t at_ = 0;
};

Error badExr(const std::string& name, std::string_view why) {
    // OpenEXR's words may name the file again and have several lines.
    std::string line(why);
    std::replace(line.begin(), line.end(), '\n', ' ');
    return badInput(fmt::format("{}: not an EXR that can be read: {}", name, line));
}

const char* compressionName(Imf::Compression compression) {
    static constexpr const char* kNames[] = {"uncompressed", "RLE", "ZIPS", "ZIP",  "PIZ",
                                             "PXR24",        "B44", "B44A", "DWAA", "DWAB"};
    return compression >= 0 && std::size_t(compression) < std::size(kNames) ? kNames[compression]
                                                                            : "unknown compression";
}

std::int64_t extent(int lowest, int highest) { return std::int64_t(highest) - lowest + 1; }

// Everything about a part that can be wrong and would cost memory or time; nothing is read yet.
Result<void> checkPart(const Imf::Header& header, const std::string& name) {
    const auto& display = header.displayWindow();
    const auto& data = header.dataWindow();
    SHOAL_TRY(checkImageSize(extent(display.min.x, display.max.x), extent(display.min.y, display.max.y), name));
    SHOAL_TRY(checkImageSize(extent(data.min.x, data.max.x), extent(data.min.y, data.max.y), name));
    constexpr int kFarthest = 1 << 24;  // OpenEXR and the addresses below count pixels in int
    for (const int edge : {display.min.x, display.min.y, data.min.x, data.min.y})
        if (edge < -kFarthest || edge > kFarthest) return badExr(name, fmt::format("a window that starts at {}", edge));
    if (header.hasType() && Imf::isDeepData(header.type())) return badExr(name, "deep pixels, expected flat ones");
    if (header.hasTileDescription()) {
        const auto& tile = header.tileDescription();
        if (tile.xSize > unsigned(kImageSideLimit) || tile.ySize > unsigned(kImageSideLimit))
            return badExr(name, fmt::format("tiles of {} x {} pixels", tile.xSize, tile.ySize));
    }
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            return badExr(name, fmt::format("channel \"{}\" is subsampled, expected one value a pixel", c.name()));
    return {};
}

Result<void> checkFile(Imf::MultiPartInputFile& file, Bytes bytes, const std::string& name) {
    std::uint64_t floatBytes = 0;
    int channelCount = 0;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        SHOAL_TRY(checkPart(header, name));
        const auto& data = header.dataWindow();
        std::uint64_t pixels = std::uint64_t(extent(data.min.x, data.max.x) * extent(data.min.y, data.max.y));
        if (header.hasTileDescription()) {  // OpenEXR holds a row of whole tiles
            const auto& tile = header.tileDescription();
            pixels = std::max(pixels, std::uint64_t(tile.xSize) * tile.ySize);
        }
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
            ++channelCount;
            floatBytes += pixels * sizeof(float);
        }
    }
    if (channelCount == 0) return badExr(name, "it has no channels");
    if (channelCount > kImageChannelLimit)
        return badExr(name, fmt::format("{} channels, the limit is {}", channelCount, kImageChannelLimit));
    if (floatBytes > kLargestPicture || (floatBytes > kSmallPicture && floatBytes / kLargestRatio > bytes.size()))
        return badExr(name, fmt::format("its header asks for {} MiB from {} bytes", floatBytes >> 20, bytes.size()));
    return {};
}

// A channel of a part and the layer it goes to.
struct Source {
    std::string full;     // in the file
    std::string channel;  // in the layer
};

// Layer names are chosen so that plain R, G, B, A (or Y, A) of the first part are the main picture; any other undotted
// channel, such as Blender's Z, is a layer of its own; undotted channels of later parts belong to the part's name.
std::map<std::string, std::vector<Source>> layersOfPart(const Imf::Header& header, int part) {
    std::map<std::string, std::vector<Source>> layers;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const ExrChannelName name = splitExrChannel(c.name());
        std::string layer = name.layer;
        if (layer.empty()) {
            const bool main = name.channel.size() == 1 && std::strchr("RGBAY", name.channel[0]);
            const std::string partName = header.hasName() ? header.name() : "";
            layer = part > 0 && !partName.empty() ? partName : main ? "" : name.channel;
        }
        layers[layer].push_back({c.name(), name.channel});
    }
    for (auto& [name, sources] : layers)
        std::sort(sources.begin(), sources.end(),
                  [](const Source& a, const Source& b) { return exrChannelBefore(a.channel, b.channel); });
    return layers;
}

// Copies what the display window shows of the data window's pixels.
Image cropToDisplay(const Image& data, const Imath::Box2i& dataWindow, const Imath::Box2i& display) {
    Image image(int(extent(display.min.x, display.max.x)), int(extent(display.min.y, display.max.y)),
                data.channelCount);
    image.channelNames = data.channelNames;
    const int left = std::max(display.min.x, dataWindow.min.x), right = std::min(display.max.x, dataWindow.max.x);
    const int top = std::max(display.min.y, dataWindow.min.y), bottom = std::min(display.max.y, dataWindow.max.y);
    if (left > right) return image;
    const std::size_t count = std::size_t(right - left + 1) * std::size_t(data.channelCount);
    for (int y = top; y <= bottom; ++y)
        std::copy_n(data.at(left - dataWindow.min.x, y - dataWindow.min.y), count,
                    image.at(left - display.min.x, y - display.min.y));
    return image;
}

// Reads all layers of a part in one pass.
void readPart(Imf::MultiPartInputFile& file, int part, std::map<std::string, Image>& layers) {
    const Imf::Header& header = file.header(part);
    const Imath::Box2i window = header.dataWindow();
    const int width = int(extent(window.min.x, window.max.x)), height = int(extent(window.min.y, window.max.y));
    std::map<std::string, Image> read;
    Imf::FrameBuffer target;
    for (const auto& [name, sources] : layersOfPart(header, part)) {
        if (layers.contains(name)) continue;  // a second part of the same name; the first one counts
        Image& image = read[name] = Image(width, height, int(sources.size()));
        const std::size_t pixelBytes = sources.size() * sizeof(float);
        for (std::size_t c = 0; c < sources.size(); ++c) {
            image.channelNames.push_back(sources[c].channel);
            target.insert(sources[c].full, Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window, pixelBytes,
                                                            pixelBytes * std::size_t(width)));
        }
    }
    if (read.empty()) return;
    Imf::InputPart input(file, part);
    input.setFrameBuffer(target);
    input.readPixels(window.min.y, window.max.y);
    for (auto& [name, image] : read)
        layers[name] =
            window == header.displayWindow() ? std::move(image) : cropToDisplay(image, window, header.displayWindow());
}

}  // namespace

Result<ImageInfo> exrInfo(Bytes bytes, const std::string& name) {
    if (const std::string wrong = checkExrHeaders(bytes); !wrong.empty()) return badExr(name, wrong);
    try {
        MemoryStream stream(bytes, name);
        Imf::MultiPartInputFile file(stream, 0);
        SHOAL_TRY(checkFile(file, bytes, name));
        const auto& header = file.header(0);
        const auto& display = header.displayWindow();
        ImageInfo info{ImageFormat::exr,
                       int(extent(display.min.x, display.max.x)),
                       int(extent(display.min.y, display.max.y)),
                       0,
                       {}};
        std::set<std::string> layers;
        bool half = false, single = false, whole = false;
        for (int part = 0; part < file.parts(); ++part) {
            for (const auto& [layer, sources] : layersOfPart(file.header(part), part)) {
                layers.insert(layer);
                info.channelCount += int(sources.size());
            }
            const auto& channels = file.header(part).channels();
            for (auto c = channels.begin(); c != channels.end(); ++c) {
                half |= c.channel().type == Imf::HALF;
                single |= c.channel().type == Imf::FLOAT;
                whole |= c.channel().type == Imf::UINT;
            }
        }
        std::string types;
        for (const auto& [has, word] : {std::pair(half, "half"), std::pair(single, "float"), std::pair(whole, "uint")})
            if (has) types += (types.empty() ? "" : " and ") + std::string(word);
        info.details =
            fmt::format("{}, {}{}, {} layer{}", types, compressionName(header.compression()),
                        header.hasTileDescription() ? ", tiled" : "", layers.size(), layers.size() == 1 ? "" : "s");
        return info;
    } catch (const std::exception& error) {
        return badExr(name, error.what());
    }
}

Result<std::vector<Layer>> decodeExr(Bytes bytes, const std::string& name) {
    if (const std::string wrong = checkExrHeaders(bytes); !wrong.empty()) return badExr(name, wrong);
    try {
        MemoryStream stream(bytes, name);
        Imf::MultiPartInputFile file(stream, 0);
        SHOAL_TRY(checkFile(file, bytes, name));
        std::map<std::string, Image> byName;
        for (int part = 0; part < file.parts(); ++part) readPart(file, part, byName);
        std::vector<Layer> layers;
        for (auto& [layer, image] : byName) layers.push_back({layer, std::move(image)});
        return layers;
    } catch (const std::exception& error) {
        return badExr(name, error.what());
    }
}

}  // namespace shoal::io
