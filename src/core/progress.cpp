#include <fmt/format.h>
#include <shoal/core/progress.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>

namespace shoal {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kBarInterval = 0.1, kLineInterval = 2;  // seconds between two drawings
constexpr int kWidestBar = 30;
constexpr int kDefaultColumns = 80;

// "56 s", "3 min 20 s", "2 h 05 min"
std::string durationWords(double seconds) {
    constexpr double kLongest = 1e9;  // 30 years; also what infinity becomes
    const auto s = static_cast<long long>(std::ceil(std::min(seconds, kLongest)));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

// Three digits are enough to watch: "0.042", "3.1", "128", "2.5k", "1.3M".
std::string rateWords(double rate) {
    if (rate >= 1e6) return fmt::format("{:.1f}M/s", rate / 1e6);
    if (rate >= 1e3) return fmt::format("{:.1f}k/s", rate / 1e3);
    return rate >= 100 ? fmt::format("{:.0f}/s", rate)
           : rate >= 1 ? fmt::format("{:.1f}/s", rate)
                       : fmt::format("{:.2g}/s", rate);
}

int columnsOf(std::FILE* out) {
    winsize size{};
    return ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kDefaultColumns;
}

}  // namespace

std::string ProgressBar::format(const std::string& title, const std::string& unit, std::uint64_t done,
                                std::uint64_t total, double seconds, int barWidth) {
    const std::string_view space = unit.empty() ? "" : " ";
    std::string text = title + "  ";
    if (total > 0) {
        const double fraction = std::min(1.0, double(done) / double(total));
        if (barWidth > 0) {
            const int filled = int(fraction * barWidth);  // rounded down: full only when all is done
            text += fmt::format("[{}{}]  ", std::string(std::size_t(filled), '#'),
                                std::string(std::size_t(barWidth - filled), '.'));
        }
        text += fmt::format("{:2}% {}/{}{}{}", int(fraction * 100), done, total, space, unit);
    } else {
        text += fmt::format("{}{}{}", done, space, unit);  // how much there will be is not known
    }
    if (done == 0 || !(seconds > 0)) return text;

    const double rate = double(done) / seconds;
    text += "  " + rateWords(rate);
    if (total > 0 && done >= total) text += "  in " + durationWords(seconds);
    if (total > 0 && done < total) text += "  " + durationWords(double(total - done) / rate) + " left";
    return text;
}

ProgressBar::ProgressBar(std::string title, std::string unit, std::FILE* out)
    : title_(std::move(title)), unit_(std::move(unit)), out_(out), terminal_(isatty(fileno(out)) == 1),
      start_(std::chrono::steady_clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() { finish(); }

void ProgressBar::update(std::uint64_t done, std::uint64_t total) {
    done_ = done;
    total_ = total;
    const auto now = std::chrono::steady_clock::now();
    const bool first = terminal_ && !drawn_;  // at once: the first piece may take minutes
    const double interval = terminal_ ? kBarInterval : kLineInterval;
    if (finished_ || (!first && Seconds(now - last_).count() < interval)) return;
    if (!terminal_ && total > 0 && done >= total) return;  // finish() writes that line; here it would stand twice
    last_ = now;
    draw(Seconds(now - start_).count());
}

void ProgressBar::draw(double seconds) {
    drawn_ = true;
    if (!terminal_) {
        std::fprintf(out_, "%s\n", format(title_, unit_, done_, total_, seconds, 0).c_str());
    } else {
        const auto bare = int(format(title_, unit_, done_, total_, seconds, 0).size());
        const int room = columnsOf(out_) - bare - int(sizeof("[]  "));
        const std::string text = format(title_, unit_, done_, total_, seconds, std::clamp(room, 0, kWidestBar));
        std::fprintf(out_, "\r%s\x1b[K", text.c_str());  // to the line's start, and clear what a longer text left
    }
    std::fflush(out_);
}

void ProgressBar::finish() {
    if (finished_) return;
    finished_ = true;
    if (done_ == 0 && !drawn_) return;
    draw(Seconds(std::chrono::steady_clock::now() - start_).count());
    if (terminal_) {
        std::fputc('\n', out_);
        std::fflush(out_);
    }
}

}  // namespace shoal
