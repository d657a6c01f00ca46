// Time per pass. On a GPU: timer queries, read some frames later without stalling. On llvmpipe, where GL_TIME_ELAPSED
// means nothing: the wall clock around glFinish, only while timing is on (it costs overlap).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/gl/device.h>

namespace shoal::gl {

struct PassTime {
    std::string name;
    double timeMs = 0;
};

class FrameTimer {
public:
    explicit FrameTimer(Device& device);
    ~FrameTimer();
    FrameTimer(FrameTimer&&) noexcept;
    void setEnabled(bool enabled);
    bool enabled() const;
    void beginFrame();
    void endFrame();
    // Times of the last frame that is known, in order of first use; the same name used twice is summed.
    const std::vector<PassTime>& passes() const;
    double frameMs() const;
    // "wall clock around glFinish" or "GL timer queries".
    static const char* method(const Device& device);

    void begin(std::string_view pass);
    void end();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// A debug group and a timed pass for the life of this object. `timer` may be null.
class PassScope {
public:
    PassScope(FrameTimer* timer, const char* pass);
    ~PassScope();
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

private:
    FrameTimer* timer_;
};

}  // namespace shoal::gl
