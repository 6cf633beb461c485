// run_guarded itself: what it must find ends a child process by an abort, what it must not find lets it end well.

#include "fuzz/target.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using namespace fascicle::fuzz;

namespace {

/// Not to be seen through by the compiler.
char* volatile kept = nullptr;

void leak(std::string_view bytes) {
    kept = new char[16 + bytes.size()];
    kept = nullptr;
}

void keep_once(std::string_view bytes) {
    static std::vector<char> table(1000 + bytes.size());
    kept = table.data();
}

void grow(std::string_view bytes) {
    static std::vector<std::size_t> sizes; // gets room for more now and then
    sizes.push_back(bytes.size());
}

void need(std::string_view bytes) {
    const std::unique_ptr<char[]> much(new char[1000 * bytes.size()]);
    kept = much.get();
}

/// Whether a child ends by an abort.
bool is_found(const Target& target, std::string_view bytes) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        for (int i = 0; i < 100; ++i)
            run_guarded(target, bytes);
        _exit(0);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || (WIFEXITED(status) && WEXITSTATUS(status) != 0)) {
        std::fprintf(stderr, "%s: its process failed otherwise\n", target.name.c_str());
        std::exit(1);
    }
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
}

} // namespace

int main() {
    const std::string bytes(100, 'x');
    const auto target = [](const char* name, void (*run)(std::string_view)) {
        return Target{name, run, 100, "", "", 400, 4 * kB};
    };
    struct Case {
        Target target;
        bool found;
    };
    int wrong = 0;
    for (const Case& c : {Case{target("leak", leak), true}, Case{target("keep_once", keep_once), false},
                          Case{target("grow", grow), false}, Case{target("need", need), true}})
        if (is_found(c.target, bytes) != c.found) {
            std::fprintf(stderr, "%s: %s\n", c.target.name.c_str(),
                         c.found ? "was not found" : "is no finding");
            ++wrong;
        }
    return wrong == 0 ? 0 : 1;
}
