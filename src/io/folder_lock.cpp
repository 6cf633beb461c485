#include "fascicle/base/error.hpp"
#include "fascicle/io/staged_files.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace fascicle {

FolderLock::FolderLock(const std::filesystem::path& folder) {
    file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int failed = 0;
    do
        failed = file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    while (failed == EINTR);
    if (failed != EWOULDBLOCK)
        return; // held, or there are no locks here
    ::close(file_);
    throw_error(shown_path(folder), "another program is writing into this folder",
                "another folder, or the end of that program");
}

FolderLock::~FolderLock() {
    if (file_ >= 0)
        ::close(file_);
}

} // namespace fascicle
