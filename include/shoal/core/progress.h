// Progress of long work: a bar on a terminal (percent, rate, remaining time), plain lines every few seconds otherwise.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

namespace shoal {

// Called with (done, total); returns false to ask the work to stop. May be empty.
using ProgressCallback = std::function<bool(std::uint64_t done, std::uint64_t total)>;

class ProgressBar {
public:
    // title: "rendering"; unit: "frames"; out: where to draw (stderr). Draws a bar when `out` is a terminal.
    ProgressBar(std::string title, std::string unit, std::FILE* out);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void update(std::uint64_t done, std::uint64_t total);
    void finish();

    // The text that update draws; exposed for tests. seconds: time since the start.
    static std::string format(const std::string& title, const std::string& unit, std::uint64_t done, std::uint64_t total,
                              double seconds, int barWidth);

private:
    std::string title_, unit_;
    std::FILE* out_;
    bool terminal_ = false, finished_ = false, drawn_ = false;
    std::chrono::steady_clock::time_point start_, last_;
    std::uint64_t done_ = 0, total_ = 0;
};

}  // namespace shoal
