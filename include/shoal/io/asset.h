// Bakes on disk: core's keyed asset container in a chunked binary file.
//
// Little-endian. "SHOALAST", u32 file version, u32 chunk count, u64 content hash (Asset::contentHash), then the chunks:
// u32 tag, u64 payload bytes, payload, u64 FNV-1a of the payload. Tags: HEAD (kind, format version), PARM (one
// parameter: key, value), ARRY (one array: name, type, shape, bytes). Texts are u32 length and bytes. Nothing may
// follow the last chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <shoal/core/data.h>
#include <shoal/core/result.h>

namespace shoal::io {

inline constexpr std::uint32_t kAssetFileVersion = 1;

// Atomic (file.h).
Result<void> writeAsset(const std::filesystem::path& path, const Asset& asset);

// Errors name what is wrong: not an asset, a newer version, cut short, a damaged chunk, a shape that does not fit the
// bytes of its type.
Result<Asset> readAsset(const std::filesystem::path& path);
Result<Asset> readAsset(std::span<const std::byte> bytes, const std::string& name);

// Bytes of one element of an array's type ("u8", "f32", ...); 0 for block formats and types this version does not know.
std::size_t assetElementSize(std::string_view type);

}  // namespace shoal::io
