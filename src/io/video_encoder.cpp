#include "fascicle/io/video_encoder.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/io/files.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

extern char** environ;

namespace fascicle {
namespace fs = std::filesystem;

namespace {

/// A write into a pipe that nobody reads ends the program, unless SIGPIPE is held back in this thread.
class WithoutPipeSignal {
public:
    WithoutPipeSignal() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t waiting;
        sigpending(&waiting);
        was_waiting_ = sigismember(&waiting, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~WithoutPipeSignal() {
        const timespec at_once{0, 0};
        if (!was_waiting_)
            while (sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
            }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    WithoutPipeSignal(const WithoutPipeSignal&) = delete;
    WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

private:
    sigset_t pipe_{}, before_{};
    bool was_waiting_ = false;
};

/// The last line of text in a file, without white space at its ends.
std::string last_line(std::FILE* file) {
    std::string text;
    std::rewind(file);
    char buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
        text.append(buffer, n);
        if (text.size() > 65536)
            text.erase(0, text.size() - 32768);
    }
    const auto end = text.find_last_not_of(" \r\n\t");
    if (end == std::string::npos)
        return {};
    const auto line = text.find_last_of("\r\n", end);
    return text.substr(line == std::string::npos ? 0 : line + 1,
                       end - (line == std::string::npos ? 0 : line + 1) + 1);
}

std::vector<std::string> arguments(const fs::path& encoder, const fs::path& file, int width, int height,
                                   double fps) {
    const std::string rate = number_text(fps);
    return {encoder.string(), "-hide_banner", "-loglevel", "error", "-y",
            // What comes in.
            "-f", "rawvideo", "-pix_fmt", "rgba", "-s", std::to_string(width) + "x" + std::to_string(height),
            "-r", rate, "-i", "pipe:0",
            // What goes out. Colours of high definition, said so in the file, else players guess.
            "-an", "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264", "-preset", "medium",
            "-crf", "18", "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709",
            "-color_trc", "bt709", "-movflags", "+faststart", "-f", "mp4", file.string()};
}

} // namespace

fs::path find_video_encoder() {
    const char* folders = std::getenv("PATH");
    if (folders == nullptr)
        return {};
    const std::string all = folders;
    for (std::size_t begin = 0; begin <= all.size();) {
        const std::size_t end = std::min(all.find(':', begin), all.size());
        const fs::path path = fs::path(all.substr(begin, end - begin)) / "ffmpeg";
        std::error_code error;
        if (end > begin && fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0)
            return path;
        begin = end + 1;
    }
    return {};
}

struct VideoEncoder::Impl {
    fs::path file, part;
    std::unique_ptr<MadeFolders> folders;
    std::size_t bytes = 0;
    const std::atomic<bool>* cancel = nullptr;
    pid_t child = -1;
    int input = -1;
    std::FILE* words = nullptr; ///< what the encoder says, a file without a name

    void start(const std::vector<std::string>& command);
    void close_input() {
        if (input >= 0)
            ::close(std::exchange(input, -1));
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw_error(file.string(), what, "another name, or numbered pictures instead");
    }
    /// Waits; the status, or -1 when there was none.
    int wait() {
        int status = -1;
        while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
        }
        child = -1;
        return status;
    }
    /// Told to stop, and after a second made to.
    void stop() {
        close_input();
        if (child <= 0)
            return;
        ::kill(child, SIGTERM);
        for (int i = 0; i < 100; ++i) {
            const pid_t ended = ::waitpid(child, nullptr, WNOHANG);
            if (ended == child || (ended < 0 && errno == ECHILD)) {
                child = -1;
                return;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        ::kill(child, SIGKILL);
        wait();
    }
    [[noreturn]] void fail_in_its_words() {
        close_input();
        const int status = wait();
        const std::string line = last_line(words);
        std::string what = "the film encoder gave up";
        if (!line.empty())
            what += ": " + line;
        else if (WIFEXITED(status))
            what += " with code " + std::to_string(WEXITSTATUS(status));
        fail(what);
    }
    ~Impl() {
        stop();
        if (words != nullptr)
            std::fclose(words);
        std::error_code ignored;
        if (!part.empty())
            fs::remove(part, ignored);
    }
};

void VideoEncoder::Impl::start(const std::vector<std::string>& command) {
    words = std::tmpfile();
    int ends[2] = {-1, -1};
    if (words == nullptr || ::pipe2(ends, O_CLOEXEC) != 0)
        fail(std::string("cannot talk to the film encoder (") + std::strerror(errno) + ")");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ::fileno(words), 2);
    // It ends when its input does; Ctrl-C is for this program alone, which then stops it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, standard;
    sigemptyset(&none);
    sigemptyset(&standard);
    sigaddset(&standard, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &standard);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                                             POSIX_SPAWN_SETPGROUP));
    std::vector<char*> pointers;
    for (const std::string& word : command)
        pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    const int error = ::posix_spawn(&child, pointers[0], &actions, &attributes, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[0]);
    input = ends[1];
    if (error != 0) {
        child = -1;
        fail("cannot start " + command[0] + " (" + std::strerror(error) + ")");
    }
    ::fcntl(input, F_SETFL, O_NONBLOCK);
}

VideoEncoder::VideoEncoder(const fs::path& encoder, fs::path file, int width, int height, double fps,
                           const std::atomic<bool>* cancel)
    : impl_(std::make_unique<Impl>()) {
    FASCICLE_ASSERT(width >= 2 && height >= 2 && width % 2 == 0 && height % 2 == 0 && fps > 0);
    Impl& me = *impl_;
    me.file = std::move(file);
    me.bytes = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    me.cancel = cancel;
    std::error_code error;
    const fs::path folder = fs::absolute(me.file, error).parent_path();
    check_output_name(me.file);
    me.folders = std::make_unique<MadeFolders>(folder);
    // A whole path, so that no name looks like an option of the encoder.
    me.part = temporary_name(folder / me.file.filename());
    me.start(arguments(encoder, me.part, width, height, fps));
}

VideoEncoder::~VideoEncoder() = default;

void VideoEncoder::add(const std::uint8_t* rgba) {
    Impl& me = *impl_;
    const WithoutPipeSignal quiet;
    for (std::size_t done = 0; done < me.bytes;) {
        if (me.cancel != nullptr && me.cancel->load())
            throw Cancelled();
        const ssize_t n = ::write(me.input, rgba + done, me.bytes - done);
        if (n > 0) {
            done += static_cast<std::size_t>(n);
        } else if (n < 0 && (errno == EAGAIN || errno == EINTR)) {
            pollfd wait{me.input, POLLOUT, 0};
            ::poll(&wait, 1, 50);
        } else {
            me.fail_in_its_words();
        }
    }
}

void VideoEncoder::commit() {
    Impl& me = *impl_;
    me.close_input();
    int status = 0;
    for (;;) {
        const pid_t ended = ::waitpid(me.child, &status, WNOHANG);
        if (ended == me.child)
            break;
        if (ended < 0 && errno != EINTR)
            me.fail_in_its_words();
        if (me.cancel != nullptr && me.cancel->load())
            throw Cancelled();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    me.child = -1;
    std::error_code error;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || fs::file_size(me.part, error) == 0 || error) {
        const std::string line = last_line(me.words);
        me.fail("the film encoder gave up: " + (line.empty() ? std::string("it left no film") : line));
    }
    fs::rename(me.part, me.file, error);
    if (error)
        me.fail("cannot write the film (" + error.message() + ")");
    me.part.clear();
    me.folders->keep();
}

} // namespace fascicle
