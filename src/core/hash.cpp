// FNV-1a [Fowler, Noll, Vo; draft-eastlake-fnv].
#include <shoal/core/hash.h>

namespace shoal {

std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t start) {
    constexpr std::uint64_t kPrime = 1099511628211ull;
    for (const std::byte b : bytes) start = (start ^ std::uint64_t(b)) * kPrime;
    return start;
}

}  // namespace shoal
