// From radiance to a picture: accumulation of samples, temporal antialiasing, exposure, tone curve.
#pragma once

#include <memory>
#include <string>

#include <shoal/core/image.h>
#include <shoal/core/params.h>
#include <shoal/frame/targets.h>

namespace shoal::frame {

struct PostParams {
    std::string exposureMode = "automatic";    // "fixed" or "automatic"
    float exposureEv = 0;                      // stops: radiance times 2^EV before the curve
    float adaptation = 1;                      // automatic: seconds to adapt by 63 %; 0: at once
    std::string toneCurve = "agx";             // "agx", "plain" (sRGB, clipped), "none" (linear, for tests)
    float bloom = 0;                           // 0..1 fraction of light scattered in the lens
    float saturation = 1.2f, contrast = 1.2f;  // looks on top of the curve
};
template <class Params, class Visitor>
requires std::is_same_v<std::remove_const_t<Params>, PostParams>
void visit(Params& p, Visitor&& v) {
    v(p.exposureMode, Field{"exposureMode",
                            "",
                            -1e30,
                            1e30,
                            "fixed, or automatic from the picture's brightness",
                            {"fixed", "automatic"}});
    v(p.exposureEv, Field{"exposureEv", "EV", -20, 20, "stops brighter (added to the automatic exposure too)"});
    v(p.adaptation, Field{"adaptation", "s", 0, 60, "how fast automatic exposure follows"});
    v(p.toneCurve,
      Field{"toneCurve", "", -1e30, 1e30, "how radiance becomes display values", {"agx", "plain", "none"}});
    v(p.bloom, Field{"bloom", "", 0, 1, "fraction of the light scattered in the lens"});
    v(p.saturation, Field{"saturation", "", 0, 2, "1 leaves colours alone"});
    v(p.contrast, Field{"contrast", "", 0, 2, "1 leaves contrast alone"});
}

class Post {
public:
    static Result<Post> create(gl::Device& device);
    Post(Post&&) noexcept;
    Post& operator=(Post&&) noexcept;
    ~Post();

    // The factor that present() will expose by, where it is known beforehand: samples of a pixel are weighed against
    // each other as the display will show them. 0, the default: it is taken from the brightness of the first sample (or
    // of the frame that resets a history).
    void setExpectedExposure(float factor);

    // Supersampling: start a picture, add each jittered sample's radiance, then read radiance(). Sums are float32, in
    // sample order.
    void beginAccumulation(int width, int height);
    void accumulate(const Context& context, const Targets& targets);
    // Temporal antialiasing instead: blends targets.radiance() with the history (reprojected by motion, clipped to the
    // neighbourhood). reset drops the history (cuts).
    void temporal(const Context& context, const Targets& targets, bool reset);

    // The antialiased linear radiance, RGBA32F or RGBA16F, of whichever was called last.
    gl::TextureView radiance() const;

    // Exposes, applies the curve and encodes for display (sRGB) into an RGBA8 texture; a is coverage. Automatic
    // exposure keeps state from frame to frame; `reset` drops it.
    void present(const Context& context, const PostParams& params, bool reset);
    gl::TextureView display() const;  // RGBA8, display encoded
    float exposure() const;           // the factor present used (reads back: for tests and AOV metadata)

    struct State;

private:
    explicit Post(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Sample offsets for antialiasing, pixels in [-0.5, 0.5]: point `index` of `count`, every one of `count` rows and
// columns once (a shifted Hammersley set; their mean is the pixel centre). count 0: an endless sequence for temporal
// antialiasing (Halton 2, 3).
Vec2 samplePattern(int index, int count);

// Reads a texture into an Image with row 0 on top. Supported formats: RGBA32F, RGBA16F, R11F_G11F_B10F, RG16F, RG16,
// R32F, R8, RGBA8, R32UI.
Result<Image> readImage(gl::Device& device, const gl::TextureView& texture, int channelCount);
Result<ByteImage> readByteImage(gl::Device& device, const gl::TextureView& texture);

}  // namespace shoal::frame
