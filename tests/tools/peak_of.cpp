// Runs a command and prints the peak of its resident set in KiB on standard error. A process that forks counts its own
// size for the child until the child becomes another program; this one is small. Without huge pages, which systems hand
// out as they like: a page of 2 MiB for a few bytes counts whole.
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
