// An X server of the test's own (Xvfb) on a free display, ended with it.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace shoal::test {

// Sets DISPLAY. Xvfb picks a free display and writes its number into a pipe when it is ready.
class VirtualScreen {
public:
    VirtualScreen() {
        int ends[2];
        if (pipe(ends) != 0) return;
        pid_ = fork();
        if (pid_ == 0) {
            close(ends[0]);
            const std::string fd = std::to_string(ends[1]);
            execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1280x720x24", "-nolisten", "tcp",
                   nullptr);
            _exit(127);
        }
        close(ends[1]);
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') number_ += c;
        close(ends[0]);
        if (!number_.empty()) setenv("DISPLAY", (":" + number_).c_str(), 1);
    }
    ~VirtualScreen() {
        if (pid_ <= 0) return;
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
    }
    VirtualScreen(const VirtualScreen&) = delete;
    VirtualScreen& operator=(const VirtualScreen&) = delete;
    bool ok() const { return !number_.empty(); }

private:
    pid_t pid_ = -1;
    std::string number_;
};

}  // namespace shoal::test

// Skips the test where Xvfb is not installed; in continuous integration (environment CI) that is a failure.
#define SHOAL_NEEDS_SCREEN(screen)                                           \
    if (!(screen).ok()) {                                                    \
        if (getenv("CI")) FAIL() << "Xvfb did not start, expected it in CI"; \
        GTEST_SKIP() << "Xvfb is not installed (scripts/setup test)";        \
    }
