// A program of libFuzzer, for a group of targets: fascicle_fuzz_GROUP --target=NAME [libFuzzer's options] [corpus folders];
// --list names the targets, each with its length, dictionary and seeds.

#include "fuzz/target.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace {

const fascicle::fuzz::Target* chosen = nullptr;
constexpr const char* variable = "FASCICLE_FUZZ_TARGET"; // for the processes that libFuzzer starts itself

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
    fascicle::fuzz::run_guarded(*chosen, {reinterpret_cast<const char*>(data), size});
    return 0;
}
