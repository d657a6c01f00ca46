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

    // Tells how far the work is; total 0: not known. Draws at most ten times a second (plain lines: every 2 s, the
    // first after 2 s), so it may be called often; by one thread at a time.
    void update(std::uint64_t done, std::uint64_t total);
    // Draws the last state and ends the line. The destructor does it too.
    void finish();

    // The text that update draws, "rendering  [####......]  42% 126/300 frames  3.1/s  56 s left"; exposed for tests.
    // seconds: time since the start. barWidth: characters between the brackets, 0 for no bar.
    static std::string format(const std::string& title, const std::string& unit, std::uint64_t done,
                              std::uint64_t total, double seconds, int barWidth);

private:
    void draw(double seconds);

    std::string title_, unit_;
    std::FILE* out_;
    bool terminal_ = false, finished_ = false, drawn_ = false;
    std::chrono::steady_clock::time_point start_, last_;
    std::uint64_t done_ = 0, total_ = 0;
};

}  // namespace shoal
