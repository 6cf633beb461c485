/* A failing file layer for tests: loaded in front of a program (LD_PRELOAD), it counts the calls that change files below one
   folder, and lets one of them, or all from one on, fail.

   FAULT_FOLDER  files below it are watched; everything else goes through uncounted
   FAULT_AT      number of the call that fails, from 1; 0 or unset: none, only counted
   FAULT_KIND    ENOSPC: from FAULT_AT on nothing can be made or grow (renaming and removing still work, as on a full disk);
                 EIO, EROFS: that one call; KILL: the program is gone by SIGKILL before it; EINTR: that one call, without effect; SHORT: that one write takes half of its bytes
   FAULT_COUNT   a file that the number of calls is written to at the end
*/
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#define MOST_FILES 4096

static atomic_long calls;
static atomic_char watched[MOST_FILES]; /* by number: open for writing below the folder */

static void* next(const char* name) {
    return dlsym(RTLD_NEXT, name);
}

static int below(const char* path) {
    const char* folder = getenv("FAULT_FOLDER");
    char whole[PATH_MAX];
    if (folder == NULL || path == NULL)
        return 0;
    if (path[0] != '/') {
        if (getcwd(whole, sizeof whole) == NULL || strlen(whole) + strlen(path) + 2 > sizeof whole)
            return 0;
        strcat(whole, "/");
        path = strcat(whole, path);
    }
    return strncmp(path, folder, strlen(folder)) == 0;
}

static int is_kind(const char* name) {
    const char* kind = getenv("FAULT_KIND");
    return kind != NULL && strcmp(kind, name) == 0;
}

enum call { makes_or_grows, moves, closes, opens_or_writes };

/* Counts the call; 0, or the error that it is to end with; -1: a short write. */
static int fault(enum call what) {
    const char* at = getenv("FAULT_AT");
    const long number = atomic_fetch_add(&calls, 1) + 1, wanted = at != NULL ? atol(at) : 0;
    if (wanted <= 0 || number < wanted)
        return 0;
    if (is_kind("ENOSPC"))
        return what == makes_or_grows || what == opens_or_writes ? ENOSPC : 0;
    if (number != wanted)
        return 0;
    if (is_kind("KILL"))
        kill(getpid(), SIGKILL);
    if (is_kind("EINTR"))
        return what == opens_or_writes ? EINTR : 0; /* others never tell it, or have done their work */
    if (is_kind("SHORT"))
        return what == opens_or_writes ? -1 : 0;
    return is_kind("EROFS") && what != closes ? EROFS : EIO;
}

static int failed(int error) {
    errno = error;
    return -1;
}

static int open_at(int folder, const char* path, int flags, mode_t mode) {
    const int changes = (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0;
    int error = 0;
    if (changes && below(path) && (error = fault(opens_or_writes)) > 0)
        return failed(error);
    const int file = (int)syscall(SYS_openat, folder, path, flags, mode);
    if (changes && file >= 0 && file < MOST_FILES && below(path))
        atomic_store(&watched[file], 1);
    return file;
}

#define OPEN_WITH(name, declared, folder)                                                                    \
    int name declared {                                                                                      \
        mode_t mode = 0;                                                                                     \
        if ((flags & (O_CREAT | __O_TMPFILE)) != 0) {                                                        \
            va_list more;                                                                                    \
            va_start(more, flags);                                                                           \
            mode = va_arg(more, mode_t);                                                                     \
            va_end(more);                                                                                    \
        }                                                                                                    \
        return open_at(folder, path, flags, mode);                                                           \
    }
OPEN_WITH(open, (const char* path, int flags, ...), AT_FDCWD)
OPEN_WITH(open64, (const char* path, int flags, ...), AT_FDCWD)
OPEN_WITH(openat, (int folder, const char* path, int flags, ...), folder)
OPEN_WITH(openat64, (int folder, const char* path, int flags, ...), folder)

static FILE* open_stream(const char* function, const char* path, const char* mode) {
    FILE* (*real)(const char*, const char*) = (FILE * (*)(const char*, const char*)) next(function);
    int error = 0;
    const int changes = strpbrk(mode, "wa+") != NULL && below(path);
    if (changes && (error = fault(opens_or_writes)) > 0) {
        errno = error;
        return NULL;
    }
    FILE* stream = real(path, mode);
    if (changes && stream != NULL && fileno(stream) < MOST_FILES)
        atomic_store(&watched[fileno(stream)], 1);
    return stream;
}
FILE* fopen(const char* path, const char* mode) {
    return open_stream("fopen", path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
    return open_stream("fopen64", path, mode);
}

static int is_watched(int file) {
    return file >= 0 && file < MOST_FILES && atomic_load(&watched[file]);
}

ssize_t write(int file, const void* data, size_t size) {
    const int error = is_watched(file) ? fault(opens_or_writes) : 0;
    if (error > 0)
        return failed(error);
    return syscall(SYS_write, file, data, error < 0 && size > 1 ? size / 2 : size);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
    const int error = is_watched(file) ? fault(opens_or_writes) : 0;
    return error > 0 ? failed(error) : syscall(SYS_writev, file, parts, count);
}

int fsync(int file) {
    const int error = is_watched(file) ? fault(opens_or_writes) : 0;
    return error > 0 ? failed(error) : (int)syscall(SYS_fsync, file);
}

int close(int file) {
    int error = 0;
    if (is_watched(file)) {
        atomic_store(&watched[file], 0);
        error = fault(closes);
    }
    const int result = (int)syscall(SYS_close, file);
    return error > 0 ? failed(error) : result;
}

int rename(const char* from, const char* to) {
    const int error = below(from) || below(to) ? fault(moves) : 0;
    return error > 0 ? failed(error) : (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}

int mkdir(const char* path, mode_t mode) {
    const int error = below(path) ? fault(makes_or_grows) : 0;
    return error > 0 ? failed(error) : (int)syscall(SYS_mkdirat, AT_FDCWD, path, mode);
}

__attribute__((destructor)) static void tell(void) {
    const char* path = getenv("FAULT_COUNT");
    char text[32];
    if (path == NULL)
        return;
    const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0) {
        const int size = snprintf(text, sizeof text, "%ld\n", atomic_load(&calls));
        syscall(SYS_write, file, text, (size_t)size);
        syscall(SYS_close, file);
    }
}
