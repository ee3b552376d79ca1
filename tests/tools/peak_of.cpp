// Runs a command and prints the peak of its resident set in KiB on standard error. A process that forks has its own
// size counted for the child until the child executes another program, so this program is small. It disables huge
// pages, which the system assigns unpredictably: a 2 MiB page counts entirely even if only a few bytes are used.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

int main(int count, char** words) {
    if (count < 2) return 126;
    prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
    const pid_t child = fork();
    if (child == 0) {
        execvp(words[1], words + 1);
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child) return 126;
    std::fprintf(stderr, "%ld\n", usage.ru_maxrss);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 125;
}
