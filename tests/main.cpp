#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <cstdlib>

int main(int argc, char** argv) {
    ::setenv("FASCICLE_USER", "", 1);  // nor keep anything in the user's folder
    ::setenv("FASCICLE_CACHE", "", 1); // tests neither read nor fill the user's cache
    return Catch::Session().run(argc, argv);
}
