#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <shoal/core/assert.h>
#include <shoal/core/parallel.h>
#include <algorithm>

#ifdef SHOAL_TSAN  // set for this file by CMake
#include <sanitizer/tsan_interface.h>
#endif

namespace shoal {

namespace {

// The thread sanitizer does not see what TBB synchronises: its library is not instrumented, nor is this file, where its
// templates are compiled. So it is told that a loop's chunks come after what its thread did before, and before what it
// does after. Chunks are not ordered among each other: races between them are found.
void happensBefore([[maybe_unused]] char& event) {
#ifdef SHOAL_TSAN
    __tsan_release(&event);
#endif
}
void happensAfter([[maybe_unused]] char& event) {
#ifdef SHOAL_TSAN
    __tsan_acquire(&event);
#endif
}

}  // namespace

ThreadLimit::ThreadLimit(int threadCount) : control_(nullptr) {
    SHOAL_ASSERT_GE(threadCount, 0);
    if (threadCount > 0)
        control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, std::size_t(threadCount));
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

void parallelChunks(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    if (grain == 0) grain = 1;
    const std::size_t chunkCount = (count - 1) / grain + 1;
    char started = 0, finished = 0;
    const auto runChunk = [&](std::size_t chunk) {
        happensAfter(started);
        body(chunk * grain, chunk * grain + std::min(grain, count - chunk * grain));
        happensBefore(finished);
    };
    if (chunkCount == 1) return runChunk(0);
    happensBefore(started);
    // Isolated: a thread that waits for an inner loop takes no chunk of an outer one, so a body may hold a lock or use
    // thread-local scratch across an inner loop.
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t(0), chunkCount, runChunk); });
    happensAfter(finished);
}

}  // namespace shoal
