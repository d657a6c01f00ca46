#include <shoal/gl/timer.h>

#include <epoxy/gl.h>

#include <array>
#include <chrono>

#include <shoal/core/assert.h>
#include <shoal/gl/objects.h>

#include "gl/device_state.h"

namespace shoal::gl {
namespace {

constexpr int kFrameCount = 4;  // frames in flight before one goes unmeasured rather than wait

class TimestampQuery : public Object {
public:
    TimestampQuery() = default;
    static TimestampQuery create(Device& device) {
        GLuint name = 0;
        glCreateQueries(GL_TIMESTAMP, 1, &name);
        return TimestampQuery(device, Type::query, name, 0);
    }

private:
    using Object::Object;
};

double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A pass of one frame: marks are indices of queries on a GPU, or milliseconds on software.
struct Span {
    std::string name;
    double from = 0, to = 0;
};

}  // namespace

struct FrameTimer::State {
    struct Frame {
        std::vector<Span> spans;              // the first is the frame itself
        std::vector<TimestampQuery> queries;  // grows in the first frames, then is reused
        std::size_t spanCount = 0, queryCount = 0;
        bool pending = false;
    };

    explicit State(Device& d) : device(d), software(d.software()) {}

    Device& device;
    bool software;
    bool enabled = false;
    bool measuring = false;  // between beginFrame and endFrame of a frame that has room
    std::array<Frame, kFrameCount> frames;
    int current = 0;
    std::vector<std::size_t> open;  // spans begun and not ended, innermost last
    std::vector<PassTime> passes;
    double frameMs = 0;

    double mark() {
        if (software) {
            glFinish();
            return nowMs();
        }
        Frame& f = frames[current];
        if (f.queryCount == f.queries.size()) f.queries.push_back(TimestampQuery::create(device));
        glQueryCounter(f.queries[f.queryCount].name(), GL_TIMESTAMP);
        return double(f.queryCount++);
    }

    void beginSpan(std::string_view name) {
        Frame& f = frames[current];
        if (f.spanCount == f.spans.size()) f.spans.emplace_back();
        f.spans[f.spanCount].name = name;
        open.push_back(f.spanCount++);
        f.spans[open.back()].from = mark();
    }

    void endSpan() {
        frames[current].spans[open.back()].to = mark();
        open.pop_back();
    }

    static bool ready(const Frame& f) {
        GLint available = GL_FALSE;  // results come in order: the last query tells for all
        glGetQueryObjectiv(f.queries[f.queryCount - 1].name(), GL_QUERY_RESULT_AVAILABLE, &available);
        return available != GL_FALSE;
    }

    double timeMs(const Frame& f, double mark) const {
        if (software) return mark;
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(f.queries[std::size_t(mark)].name(), GL_QUERY_RESULT, &nanoseconds);
        return double(nanoseconds) * 1e-6;
    }

    void publish(Frame& f) {
        passes.clear();
        frameMs = timeMs(f, f.spans[0].to) - timeMs(f, f.spans[0].from);
        for (std::size_t i = 1; i < f.spanCount; ++i) {
            const double ms = timeMs(f, f.spans[i].to) - timeMs(f, f.spans[i].from);
            auto found = passes.begin();
            while (found != passes.end() && found->name != f.spans[i].name) ++found;
            if (found == passes.end())
                passes.push_back({f.spans[i].name, ms});
            else
                found->timeMs += ms;
        }
        f.pending = false;
    }

    // Takes what has arrived, oldest first.
    void collect() {
        for (int i = 1; i <= kFrameCount; ++i) {
            Frame& f = frames[(current + i) % kFrameCount];
            if (!f.pending) continue;
            if (!software && !ready(f)) return;
            publish(f);
        }
    }
};

FrameTimer::FrameTimer(Device& device) : state_(new State(device)) {}
FrameTimer::~FrameTimer() = default;
FrameTimer::FrameTimer(FrameTimer&&) noexcept = default;

void FrameTimer::setEnabled(bool enabled) { state_->enabled = enabled; }
bool FrameTimer::enabled() const { return state_->enabled; }

void FrameTimer::beginFrame() {
    State& s = *state_;
    SHOAL_ASSERT(!s.measuring);
    if (!s.enabled) return;
    s.collect();
    s.current = (s.current + 1) % kFrameCount;
    State::Frame& f = s.frames[s.current];
    if (f.pending) {  // the GPU is a whole ring behind: do not wait for it
        s.current = (s.current + kFrameCount - 1) % kFrameCount;
        return;
    }
    f.spanCount = f.queryCount = 0;
    s.measuring = true;
    s.beginSpan("frame");
}

void FrameTimer::endFrame() {
    State& s = *state_;
    if (!s.measuring) return;
    SHOAL_ASSERT_EQ(s.open.size(), std::size_t(1));
    s.endSpan();
    s.measuring = false;
    s.frames[s.current].pending = true;
    s.collect();
}

void FrameTimer::begin(std::string_view pass) {
    if (state_->measuring) state_->beginSpan(pass);
}

void FrameTimer::end() {
    if (!state_->measuring) return;
    SHOAL_ASSERT_LT(std::size_t(1), state_->open.size());
    state_->endSpan();
}

const std::vector<PassTime>& FrameTimer::passes() const { return state_->passes; }
double FrameTimer::frameMs() const { return state_->frameMs; }

const char* FrameTimer::method(const Device& device) {
    return device.info().software ? "wall clock around glFinish" : "GL timer queries";
}

PassScope::PassScope(FrameTimer* timer, const char* pass) : timer_(timer) {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, pass);
    if (timer_) timer_->begin(pass);
}

PassScope::~PassScope() {
    if (timer_) timer_->end();
    glPopDebugGroup();
}

}  // namespace shoal::gl
