// A program of libFuzzer, for a group of targets: fascicle_fuzz_GROUP --target=NAME [libFuzzer's options] [corpus folders];
// --list names the targets, each with its length, dictionary and seeds.

#include "fuzz/check.hpp"
#include "fuzz/memory_guard.hpp"
#include "fuzz/target.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace {

const fascicle::fuzz::Target* chosen = nullptr;
constexpr const char* variable = "FASCICLE_FUZZ_TARGET"; // for the processes that libFuzzer starts itself

/// Live bytes that an input has added.
std::ptrdiff_t growth(std::string_view bytes) {
    const std::size_t before = fascicle::fuzz::live_memory();
    fascicle::fuzz::run_guarded(*chosen, bytes);
    return static_cast<std::ptrdiff_t>(fascicle::fuzz::live_memory() - before);
}

/// What is made once and kept is not made again, and a container that has grown has room: an input that needs more each time leaks.
/// (libFuzzer's own search, -detect_leaks, has a call for each allocation, and none of it is found without malloc_context_size.)
void check_leaks(std::string_view bytes) {
    constexpr int times = 8;
    for (int i = 0; i < times; ++i)
        if (growth(bytes) <= 0)
            return;
    fascicle::fuzz::failed("all memory is given back", __FILE__, __LINE__);
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    using namespace fascicle::fuzz;
    const char* name = std::getenv(variable);
    if (*argc > 1 && std::strcmp((*argv)[1], "--list") == 0) {
        for (const Target& target : targets())
            std::printf("%s\t%zu\t%s\t%s\n", target.name.c_str(), target.max_length,
                        target.dictionary.c_str(), target.seeds.c_str());
        std::fflush(stdout);
        _exit(0); // nothing was done that would have to be cleaned up
    }
    constexpr const char* option = "--target=";
    if (*argc > 1 && std::strncmp((*argv)[1], option, std::strlen(option)) == 0) {
        name = (*argv)[1] + std::strlen(option);
        setenv(variable, name, 1);
        for (int i = 1; i + 1 < *argc; ++i)
            (*argv)[i] = (*argv)[i + 1];
        (*argv)[--*argc] = nullptr;
    }
    chosen = name != nullptr ? find_target(name) : nullptr;
    if (chosen == nullptr) {
        std::fprintf(stderr, "fascicle_fuzz: no target %s; --target=NAME, --list shows them\n",
                     name != nullptr ? name : "was given");
        _exit(2);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (growth(bytes) > 0)
        check_leaks(bytes);
    return 0;
}
