// "data:" URIs and percent encoding (RFC 2397, RFC 3986, RFC 4648).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::io {

bool isDataUri(std::string_view uri);
// The payload of a data URI; false and `problem` filled where it is malformed.
bool decodeDataUri(std::string_view uri, std::vector<std::byte>& out, std::string& problem);
// "%20" to a space; a '%' that no two hex digits follow stays.
std::string percentDecoded(std::string_view text);

}  // namespace shoal::io
