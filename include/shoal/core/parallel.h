// Parallel loops whose results do not depend on the number of threads: work is cut into fixed chunks, and partial
// results are combined in chunk order.
#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace shoal {

// Limits the threads that the loops below use, for the life of this object (tests, benchmarks). 0: no limit of its own.
// Of several limits the lowest holds.
class ThreadLimit {
public:
    explicit ThreadLimit(int threadCount);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    void* control_;
};

// Calls body(begin, end) for chunks of at most `grain` indices that together cover [0, count). Chunk bounds depend on
// count and grain only; a grain of 0 is taken as 1. Loops may be nested: a thread that waits for an inner loop takes no
// chunk of an outer one.
void parallelChunks(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

// Calls body(i) for i in [0, count).
template <class Body>
void parallelFor(std::size_t count, std::size_t grain, const Body& body) {
    parallelChunks(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

// combine(...combine(combine(identity, map(chunk 0)), map(chunk 1))...): same bits for any thread count.
template <class T, class Map, class Combine>
T parallelReduce(std::size_t count, std::size_t grain, T identity, const Map& map, const Combine& combine) {
    static_assert(!std::is_same_v<T, bool>, "std::vector<bool> packs bits: chunks would write to the same byte");
    if (grain == 0) grain = 1;
    std::vector<T> partial((count + grain - 1) / grain, identity);
    parallelChunks(count, grain, [&](std::size_t begin, std::size_t end) { partial[begin / grain] = map(begin, end); });
    for (const T& p : partial) identity = combine(identity, p);
    return identity;
}

}  // namespace shoal
