// Mip chains made on the CPU, and the textures and samplers of materials.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/model.h>
#include <shoal/core/result.h>
#include <shoal/gl/objects.h>

namespace shoal::frame {

// What an image's channels mean: decides the filter of its mips and the texture's format.
struct TextureMeaning {
    bool color = false;        // sRGB colour with straight alpha; else plain numbers
    float coverageCutoff = 0;  // > 0: mips keep the share of texels whose alpha reaches it (masked materials)
    auto operator<=>(const TextureMeaning&) const = default;
};

// All levels below the image itself, each half the size of the one before (rounded down, at least 1).
std::vector<ByteImage> makeMips(const ByteImage& image, const TextureMeaning& meaning);

class TextureStore {
public:
    explicit TextureStore(gl::Device& device);
    Result<int> add(const ByteImage& image, const TextureMeaning& meaning, const std::string& name);
    int sampler(const TextureUse& use);
    void bind(int unit, int texture, int sampler) const;
    int white() const { return 0; }
    int flatNormal() const { return 1; }
    void clear();  // all but the two above

private:
    int addPlain(const std::uint8_t (&rgba)[4], const char* label);
    gl::Device* device_;
    std::vector<gl::Texture> textures_;
    std::vector<gl::Sampler> samplers_;
    std::map<std::uint32_t, int> samplerIndex_;
};

}  // namespace shoal::frame
