// Chunk bounds, coverage and bits must not depend on the number of threads.
#include <oneapi/tbb/task_arena.h>
#include <shoal/core/parallel.h>
#include <shoal/core/random.h>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace shoal {
namespace {

using Chunks = std::set<std::pair<std::size_t, std::size_t>>;

Chunks chunksOf(std::size_t count, std::size_t grain) {
    std::mutex mutex;
    Chunks chunks;
    parallelChunks(count, grain, [&](std::size_t begin, std::size_t end) {
        const std::lock_guard lock(mutex);
        EXPECT_TRUE(chunks.emplace(begin, end).second) << "chunk " << begin << " twice";
    });
    return chunks;
}

TEST(ParallelChunks, BoundsAreThoseOfTheGrain) {
    EXPECT_EQ(chunksOf(10, 4), (Chunks{{0, 4}, {4, 8}, {8, 10}}));
    EXPECT_EQ(chunksOf(8, 4), (Chunks{{0, 4}, {4, 8}}));
    EXPECT_EQ(chunksOf(3, 100), (Chunks{{0, 3}}));
    EXPECT_EQ(chunksOf(2, 0), (Chunks{{0, 1}, {1, 2}}));
    EXPECT_EQ(chunksOf(0, 4), Chunks{});
    EXPECT_EQ(chunksOf(5, ~std::size_t(0)), (Chunks{{0, 5}}));  // no overflow in begin + grain
}

TEST(ParallelChunks, BoundsDoNotDependOnThreads) {
    const Chunks all = chunksOf(12345, 17);
    for (const int threadCount : {1, 2, 8}) {
        const ThreadLimit limit(threadCount);
        EXPECT_EQ(chunksOf(12345, 17), all);
    }
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
    std::vector<int> visits(100000, 0);
    parallelFor(visits.size(), 64, [&](std::size_t i) { ++visits[i]; });
    for (const int v : visits) ASSERT_EQ(v, 1);
}

float floatSum(std::size_t count) {
    return parallelReduce(
        count, 1000, 0.0f,
        [](std::size_t begin, std::size_t end) {
            float sum = 0;
            for (std::size_t i = begin; i < end; ++i) sum += randomFloat(1, std::uint32_t(i)) * 1e3f - 400;
            return sum;
        },
        [](float a, float b) { return a + b; });
}

TEST(ParallelReduce, SameBitsForAnyThreadCount) {
    const float all = floatSum(1000003);
    for (const int threadCount : {1, 2, 3, 8})
        for (int repetition = 0; repetition < 5; ++repetition) {
            const ThreadLimit limit(threadCount);
            ASSERT_EQ(floatSum(1000003), all);
        }
}

TEST(ParallelReduce, CombinesInChunkOrder) {
    using Text = std::string;
    const auto map = [](std::size_t begin, std::size_t) { return std::to_string(begin); };
    const auto join = [](const Text& a, const Text& b) { return a + " " + b; };
    EXPECT_EQ(parallelReduce(10, 4, Text("start"), map, join), "start 0 4 8");
    EXPECT_EQ(parallelReduce(0, 4, Text("start"), map, join), "start");
}

TEST(ParallelNested, InnerLoopsGiveTheSameSums) {
    std::vector<float> sums(64);
    parallelFor(sums.size(), 1, [&](std::size_t i) { sums[i] = floatSum(2000 + 100 * i); });
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const ThreadLimit limit(1);
        EXPECT_EQ(sums[i], floatSum(2000 + 100 * i));
    }
}

// A body that uses thread-local scratch across an inner loop must not be entered again by its own thread meanwhile. An
// arena of eight threads on any machine, and naps, make waiting threads look for other work.
TEST(ParallelNested, WaitingThreadTakesNoOuterChunk) {
    static thread_local int depth = 0;
    std::atomic<int> deepest = 0;
    const ThreadLimit limit(8);  // lifts the default of one a core
    tbb::task_arena arena(8);
    arena.execute([&] {
        parallelFor(100, 1, [&](std::size_t i) {
            int seen = deepest.load();
            ++depth;
            while (depth > seen && !deepest.compare_exchange_weak(seen, depth)) {
            }
            parallelFor(8, 1, [&](std::size_t k) {
                const std::uint32_t nap = i < 50 && k % 2 == 1 ? 2000 : 20;
                std::this_thread::sleep_for(std::chrono::microseconds(nap));
            });
            --depth;
        });
    });
    EXPECT_EQ(deepest.load(), 1);
}

int mostThreadsAtOnce() {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    parallelFor(400, 1, [&](std::size_t) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
    });
    return int(threads.size());
}

TEST(ThreadLimit, HoldsForItsLifeOnly) {
    const int before = mostThreadsAtOnce();
    {
        const ThreadLimit limit(1);
        EXPECT_EQ(mostThreadsAtOnce(), 1);
        const ThreadLimit none(0);  // adds no limit, lifts none
        EXPECT_EQ(mostThreadsAtOnce(), 1);
    }
    if (std::thread::hardware_concurrency() > 1) {
        EXPECT_GT(before, 1);
        EXPECT_GT(mostThreadsAtOnce(), 1);
    }
}

}  // namespace
}  // namespace shoal
