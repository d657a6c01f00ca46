// Looking at a buffer of the frame instead of the picture, and at the numbers under the cursor.
#pragma once

#include <string>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/gl/objects.h>
#include <shoal/pipeline/pipeline.h>

namespace shoal::viewer {

class Inspector {
public:
    // "": the picture itself.
    void choose(const std::string& aov) { chosen_ = aov, revision_ = -1; }
    const std::string& chosen() const { return chosen_; }
    bool active() const { return !chosen_.empty(); }
    // What the frame must be drawn with: the buffer while the view moves, all of them when it rests.
    std::vector<std::string> wantedAovs(bool moving) const;
    // Reads the buffers of a complete picture, once for every revision.
    Result<void> take(gl::Device& device, pipeline::Pipeline& pipeline, int revision);
    gl::TextureView texture() const { return texture_.view(); }

    struct Reading {
        std::string name, value, unit;
    };
    // Values at a place of the picture, x and y in [0, 1) from the top left; `content` names objects.
    std::vector<Reading> at(float x, float y, const scene::Content& content) const;
    std::string rangeText() const { return range_; }

private:
    std::string chosen_, range_;
    int revision_ = -1;
    std::vector<Layer> layers_;
    gl::Texture texture_;
};

// False colours of one buffer, display encoded; `range` tells what black and white stand for.
ByteImage colorsOf(const std::string& aov, const Image& image, std::string& range);

}  // namespace shoal::viewer
