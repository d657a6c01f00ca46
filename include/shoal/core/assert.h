// Assertions for a programmer's mistakes. They stay in release builds, print both operands, and abort.
#pragma once

#include <sstream>
#include <string>

namespace shoal::detail {

// Prints "file:line: assertion failed: expression (details)" to stderr and aborts.
[[noreturn]] void assertFailed(const char* expression, const std::string& details, const char* file, int line);

template <class A, class B>
[[noreturn]] void assertFailedWith(const char* expression, const A& a, const B& b, const char* file, int line) {
    std::ostringstream out;
    out << "left " << a << ", right " << b;
    assertFailed(expression, out.str(), file, line);
}

}  // namespace shoal::detail

#define SHOAL_ASSERT(condition) \
    ((condition) ? void(0) : ::shoal::detail::assertFailed(#condition, {}, __FILE__, __LINE__))
#define SHOAL_ASSERT_MSG(condition, message) \
    ((condition) ? void(0) : ::shoal::detail::assertFailed(#condition, (message), __FILE__, __LINE__))
#define SHOAL_ASSERT_COMPARE_(a, op, b)                                                               \
    do {                                                                                              \
        const auto& shoalA = (a);                                                                     \
        const auto& shoalB = (b);                                                                     \
        if (!(shoalA op shoalB))                                                                      \
            ::shoal::detail::assertFailedWith(#a " " #op " " #b, shoalA, shoalB, __FILE__, __LINE__); \
    } while (false)
#define SHOAL_ASSERT_EQ(a, b) SHOAL_ASSERT_COMPARE_(a, ==, b)
#define SHOAL_ASSERT_NE(a, b) SHOAL_ASSERT_COMPARE_(a, !=, b)
#define SHOAL_ASSERT_LT(a, b) SHOAL_ASSERT_COMPARE_(a, <, b)
#define SHOAL_ASSERT_LE(a, b) SHOAL_ASSERT_COMPARE_(a, <=, b)
#define SHOAL_ASSERT_GT(a, b) SHOAL_ASSERT_COMPARE_(a, >, b)
#define SHOAL_ASSERT_GE(a, b) SHOAL_ASSERT_COMPARE_(a, >=, b)
