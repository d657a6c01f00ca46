// Result<T>: a value or an Error. What every call returns that can fail for reasons outside the program
// (a file, a shader, a device, a parameter). Same names as std::expected; public headers use only std, hence our own
// (docs/decisions/0001).
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <shoal/core/assert.h>

namespace shoal {

// What kind of failure; the tool turns it into its exit code (docs/conventions.md).
enum class ErrorKind {
    badInput,   // a file or value that cannot be used, or an output that cannot be written: exit 3
    usage,      // an unknown verb, option, key or value on the command line: exit 2
    noDevice,   // no usable OpenGL device: exit 4
    cancelled,  // the caller asked to stop
    internal,   // ours: a shader that does not link, a driver that reports an error
};

// One line that names the file, line or field, what was found and what was expected.
struct Error {
    ErrorKind kind = ErrorKind::badInput;
    std::string message;
};

inline Error badInput(std::string message) { return {ErrorKind::badInput, std::move(message)}; }
inline Error usageError(std::string message) { return {ErrorKind::usage, std::move(message)}; }
inline Error noDevice(std::string message) { return {ErrorKind::noDevice, std::move(message)}; }
inline Error internalError(std::string message) { return {ErrorKind::internal, std::move(message)}; }

template <class T>
class [[nodiscard]] Result {
public:
    using value_type = T;

    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    // Asking for the value of a failed result is a programmer's mistake: it asserts with the error's message.
    T& value() & { return check(), *std::get_if<0>(&state_); }
    const T& value() const& { return check(), *std::get_if<0>(&state_); }
    T&& value() && { return check(), std::move(*std::get_if<0>(&state_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const& {
        SHOAL_ASSERT(!has_value());
        return *std::get_if<1>(&state_);
    }
    Error&& error() && {
        SHOAL_ASSERT(!has_value());
        return std::move(*std::get_if<1>(&state_));
    }

private:
    void check() const {
        if (!has_value()) detail::assertFailed("Result::value()", std::get_if<1>(&state_)->message, __FILE__, __LINE__);
    }
    std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
public:
    using value_type = void;

    Result() = default;
    Result(Error error) : error_(std::move(error)), ok_(false) {}

    bool has_value() const { return ok_; }
    explicit operator bool() const { return ok_; }
    void value() const {
        if (!ok_) detail::assertFailed("Result::value()", error_.message, __FILE__, __LINE__);
    }
    const Error& error() const {
        SHOAL_ASSERT(!ok_);
        return error_;
    }

private:
    Error error_;
    bool ok_ = true;
};

}  // namespace shoal

// Returns the error to the caller, or goes on: SHOAL_TRY(writePng(...));
#define SHOAL_TRY(expression)                                                                                     \
    do {                                                                                                          \
        if (auto shoalResult = (expression); !shoalResult) return ::shoal::Error(std::move(shoalResult).error()); \
    } while (false)

#define SHOAL_CONCAT_(a, b) a##b
#define SHOAL_CONCAT(a, b) SHOAL_CONCAT_(a, b)
// Declares a variable from a Result, or returns its error: SHOAL_TRY_ASSIGN(auto image, io::readImage(path));
#define SHOAL_TRY_ASSIGN(declaration, expression)                                      \
    auto SHOAL_CONCAT(shoalResult, __LINE__) = (expression);                           \
    if (!SHOAL_CONCAT(shoalResult, __LINE__))                                          \
        return ::shoal::Error(std::move(SHOAL_CONCAT(shoalResult, __LINE__)).error()); \
    declaration = *std::move(SHOAL_CONCAT(shoalResult, __LINE__))
