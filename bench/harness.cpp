#include "bench/harness.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

extern char** environ;

namespace shoal::bench {

std::string Spread::describe(const char* unit) const {
    char text[120];
    std::snprintf(text, sizeof text, "median of %d, %.4g .. %.4g %s", count, lowest, highest, unit);
    return text;
}

Spread spreadOf(std::vector<double> values) {
    SHOAL_ASSERT(!values.empty());
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    const double median = values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
    return {median, values.front(), values.back(), int(values.size())};
}

Ran runProgram(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment,
               bool quiet) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::vector<std::string> settings;
    for (char** e = environ; *e; ++e) {
        const std::string setting(*e);
        if (!environment.contains(setting.substr(0, setting.find('=')))) settings.push_back(setting);
    }
    for (const auto& [key, value] : environment) settings.push_back(key + "=" + value);
    std::vector<char*> variables;
    for (std::string& setting : settings) variables.push_back(setting.data());
    variables.push_back(nullptr);

    int pipe[2];
    Ran ran;
    if (::pipe2(pipe, O_CLOEXEC) != 0) return ran;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe[1], 1);
    if (quiet) posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const auto start = std::chrono::steady_clock::now();
    const int failed = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), variables.data());
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe[1]);
    if (!failed) {
        char buffer[4096];
        for (ssize_t n; (n = ::read(pipe[0], buffer, sizeof buffer)) > 0;) ran.output.append(buffer, std::size_t(n));
        int status = 0;
        rusage usage{};
        ::wait4(child, &status, 0, &usage);
        ran.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        ran.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        ran.peakMib = double(usage.ru_maxrss) / 1024;
    }
    ::close(pipe[0]);
    return ran;
}

bool haveProgram(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::string folders = path ? path : "";
    for (std::size_t at = 0; at <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', at), folders.size());
        if (::access((folders.substr(at, end - at) + "/" + name).c_str(), X_OK) == 0) return true;
        at = end + 1;
    }
    return false;
}

std::string dataFile(const Settings& settings, const char* row, const std::string& relative) {
    const std::string file = settings.dataDir + "/" + relative;
    if (!settings.dataDir.empty() && std::filesystem::exists(file)) return file;
    note("%s: skipped, %s is not there (name the data folder with --data)", row, relative.c_str());
    return "";
}

void note(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    std::vprintf(format, arguments);
    va_end(arguments);
    std::printf("\n");
    std::fflush(stdout);
}

double timed(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace shoal::bench
