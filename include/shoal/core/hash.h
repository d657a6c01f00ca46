// FNV-1a, 64 bit: content hashes of assets and pictures. Not for anything hostile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace shoal {

inline constexpr std::uint64_t kFnvStart = 14695981039346656037ull;

std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t start = kFnvStart);

}  // namespace shoal
