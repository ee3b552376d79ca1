// tests/tools/strata/system_faults/failing_calls.cpp - a library that is loaded before the C library (LD_PRELOAD) and
// makes system calls fail.
//
// Rule     STRATA_FAIL=fsync:2:5 fails the second fsync with errno 5; fsync:2+:5 that one and all further ones. open
//          counts if it may write, write if the file is not a standard stream. STRATA_CALLS=FILE gets one line per
//          counted
//          call with its name. STRATA_MOST_THREADS=2 refuses a third thread besides the first one while two are
//          running.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <class Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void note(const char* name) {
    const char* const log = std::getenv("STRATA_CALLS");
    if (log == nullptr) return;
    const int file = real<int(const char*, int, ...)>("open")(log, O_WRONLY | O_CREAT | O_APPEND, 0600);
    const std::string line = std::string(name) + "\n";
    if (real<ssize_t(int, const void*, std::size_t)>("write")(file, line.data(), line.size()) < 0) std::abort();
    real<int(int)>("close")(file);
}

// The errno with which this call of `name` must fail; 0: it must not fail.
int failure_of(const char* name) {
    static std::atomic<int> count = 0;
    note(name);
    const char* const wanted = std::getenv("STRATA_FAIL");
    if (wanted == nullptr) return 0;
    const std::size_t length = std::strlen(name);
    if (std::strncmp(wanted, name, length) != 0 || wanted[length] != ':') return 0;
    char* end = nullptr;
    const long number = std::strtol(wanted + length + 1, &end, 10);
    const bool and_further = *end == '+';
    if (and_further) ++end;
    const int here = ++count;
    return here == number || (and_further && here > number) ? std::atoi(end + 1) : 0;
}

// A thread that is counted while it runs.
struct Task {
    void* (*start)(void*);
    void* argument;
};
std::atomic<int> alive = 0;

void* run_counted(void* task) {
    const Task own = *static_cast<Task*>(task);
    delete static_cast<Task*>(task);
    void* const result = own.start(own.argument);
    --alive;
    return result;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    std::va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    if ((flags & O_ACCMODE) != O_RDONLY)
        if (const int error = failure_of("open")) return errno = error, -1;
    return real<int(const char*, int, ...)>("open")(path, flags, mode);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
    if (file > STDERR_FILENO)
        if (const int error = failure_of("write")) return errno = error, -1;
    return real<ssize_t(int, const void*, std::size_t)>("write")(file, bytes, size);
}

int fsync(int file) {
    if (const int error = failure_of("fsync")) return errno = error, -1;
    return real<int(int)>("fsync")(file);
}

int rename(const char* from, const char* to) noexcept {
    if (const int error = failure_of("rename")) return errno = error, -1;
    return real<int(const char*, const char*)>("rename")(from, to);
}

// The descriptor is closed in any case, as on Linux.
int close(int file) {
    const int error = failure_of("close");
    const int done = real<int(int)>("close")(file);
    return error != 0 ? (errno = error, -1) : done;
}

// At most STRATA_MOST_THREADS threads at once, not counting the first one.
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) noexcept {
    const char* const most = std::getenv("STRATA_MOST_THREADS");
    if (most != nullptr && alive.load() >= std::atoi(most)) return EAGAIN;
    ++alive;
    auto* const task = new Task{start, argument};
    const int error = real<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create")(
        thread, attributes, run_counted, task);
    if (error == 0) return 0;
    --alive;
    delete task;
    return error;
}

}  // extern "C"
