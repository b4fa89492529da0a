// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded: the process dies by SIGKILL at its KILL_AT-th step of writing files, counted from 1. A write to a regular file is two steps, half of it and
// all of it; fsync and rename are a step each, which is then not taken. A process that outlives its steps says how many it took on standard error.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static long steps = 0;

static void step(void) {
    const char* at = getenv("KILL_AT");
    if (++steps == (at == NULL ? 0 : atol(at))) kill(getpid(), SIGKILL);
}

ssize_t write(int file, const void* bytes, size_t count) {
    ssize_t (*const real)(int, const void*, size_t) = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
    struct stat of;
    if (file <= 2 || fstat(file, &of) != 0 || !S_ISREG(of.st_mode)) return real(file, bytes, count);
    const ssize_t half = real(file, bytes, count / 2);
    step();
    if (half < 0) return half;
    const ssize_t rest = real(file, (const char*)bytes + half, count - (size_t)half);
    step();
    return rest < 0 ? half : half + rest;
}

int fsync(int file) {
    int (*const real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
    step();
    return real(file);
}

int rename(const char* from, const char* to) {
    int (*const real)(const char*, const char*) = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
    step();
    return real(from, to);
}

__attribute__((destructor)) static void tell(void) { fprintf(stderr, "steps of writing: %ld\n", steps); }
