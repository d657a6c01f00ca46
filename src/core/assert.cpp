#include <shoal/core/assert.h>

#include <cstdio>
#include <cstdlib>

namespace shoal::detail {

void assertFailed(const char* expression, const std::string& details, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s%s%s%s\n", file, line, expression, details.empty() ? "" : " (",
                 details.c_str(), details.empty() ? "" : ")");
    std::fflush(stderr);
    std::abort();
}

}  // namespace shoal::detail
