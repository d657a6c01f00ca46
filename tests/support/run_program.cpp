#include "support/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>

namespace shoal::test {

namespace {

using Clock = std::chrono::steady_clock;

// The child: never returns.
[[noreturn]] void become(const std::vector<std::string>& words, const RunOptions& options, int out, int err) {
    setpgid(0, 0);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, 0), dup2(out, 1), dup2(err, 2);
    if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
    for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> pointers;
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
}

// Reads both pipes until the child closes them or the time is over; whether it did.
bool drain(int out, int err, ProgramRun& run, Clock::time_point end) {
    pollfd pipes[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
    std::string* texts[2] = {&run.out, &run.err};
    int openCount = 2;
    while (openCount > 0) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0) return false;
        if (poll(pipes, 2, int(left)) < 0) continue;
        for (int i = 0; i < 2; ++i) {
            if (pipes[i].fd < 0 || pipes[i].revents == 0) continue;
            char bytes[4096];
            const ssize_t count = read(pipes[i].fd, bytes, sizeof bytes);
            if (count > 0)
                texts[i]->append(bytes, std::size_t(count));
            else
                pipes[i].fd = -1, --openCount;
        }
    }
    return true;
}

}  // namespace

std::string ProgramRun::describe() const {
    return "$ " + command + "\nexit code " + std::to_string(exitCode) + (problem.empty() ? "" : " (" + problem + ")") +
           "\nstdout:\n" + out + "stderr:\n" + err;
}

ProgramRun runProgram(const std::vector<std::string>& words, const RunOptions& options) {
    ProgramRun run;
    for (const auto& [name, value] : options.environment) run.command += name + "=" + value + " ";
    for (const std::string& word : words) run.command += (&word == words.data() ? "" : " ") + word;
    int out[2], err[2];
    if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) {
        run.problem = "no pipe";
        return run;
    }
    const auto start = Clock::now();
    const pid_t child = fork();
    if (child == 0) become(words, options, out[1], err[1]);
    close(out[1]), close(err[1]);
    const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.limitS));
    if (!drain(out[0], err[0], run, start + limit)) {
        run.problem = "longer than " + std::to_string(int(options.limitS)) + " s";
        kill(-child, SIGKILL);
    }
    close(out[0]), close(err[0]);
    int status = 0;
    waitpid(child, &status, 0);
    run.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (WIFEXITED(status))
        run.exitCode = WEXITSTATUS(status);
    else if (run.problem.empty())
        run.problem = "killed by signal " + std::to_string(WTERMSIG(status));
    return run;
}

std::size_t lineCount(const std::string& text) {
    std::size_t count = 0;
    for (const char c : text) count += c == '\n';
    return count + (!text.empty() && text.back() != '\n');
}

std::string readText(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace shoal::test
