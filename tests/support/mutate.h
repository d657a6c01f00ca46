// Damage to files, the same on every run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace shoal::test {

// A damaged copy of `original`: one to four times a changed bit, byte or 32-bit word (extremes more often than not), a
// stretch cut out or doubled; sometimes the end is missing. `protectedBytes` at the start stay, so that the format is
// still known.
inline std::vector<std::byte> mutate(std::span<const std::byte> original, std::uint32_t seed,
                                     std::size_t protectedBytes = 0) {
    std::mt19937 random(seed);
    std::vector<std::byte> bytes(original.begin(), original.end());
    // std::uniform_int_distribution differs between libraries; a remainder does not.
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : std::size_t(random()) % n; };
    const std::size_t changes = 1 + below(4);
    for (std::size_t change = 0; change < changes && bytes.size() > protectedBytes + 8; ++change) {
        const std::size_t room = bytes.size() - protectedBytes;
        // Headers are where the numbers stand that sizes are made of: half of all changes go to the first 512 bytes.
        const std::size_t at = protectedBytes + below(below(2) ? room : std::min<std::size_t>(room, 512));
        static constexpr std::uint32_t kWords[] = {0,      1,          0x7f,       0x80,       0xff,
                                                   0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0x01000000};
        switch (below(6)) {
            case 0:
                bytes[at] ^= std::byte(1u << below(8));
                break;
            case 1:
                bytes[at] = std::byte(random() & 0xff);
                break;
            case 2:
            case 3: {
                const std::uint32_t word = below(2) ? kWords[below(std::size(kWords))] : std::uint32_t(random());
                for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
                    bytes[at + i] = std::byte(word >> (8 * i) & 0xff);
                break;
            }
            case 4: {
                const std::size_t end = std::min(bytes.size(), at + 1 + below(64));
                bytes.erase(bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(end));
                break;
            }
            default: {
                const std::size_t end = std::min(bytes.size(), at + 1 + below(64));
                const std::vector<std::byte> copy(bytes.begin() + std::ptrdiff_t(at),
                                                  bytes.begin() + std::ptrdiff_t(end));
                bytes.insert(bytes.begin() + std::ptrdiff_t(at), copy.begin(), copy.end());
                break;
            }
        }
    }
    if (below(8) == 0) bytes.resize(protectedBytes + below(bytes.size() - protectedBytes + 1));
    return bytes;
}

}  // namespace shoal::test
